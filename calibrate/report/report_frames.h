#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/calibrate.h"
#include "extract/skeleton/units.h"

namespace stride::report {

inline constexpr int kReportKeyframes = kKeyframesPerStride;

/// The video of a trajectory, if it is in `folder` and has the right hash; else empty.
std::filesystem::path video_in(const std::filesystem::path& folder, const Trajectory& trajectory);

/// Indices into Trajectory::frames of the frames nearest to the keyframes of a stride, near the
/// middle of the clip if there are several; and of equally spaced moments of a movement that does
/// not repeat, from its first frame to its last.
std::vector<int> keyframes_of_stride(const Calibration& calibration);
std::vector<int> keyframes_of_passage(const Trajectory& trajectory);

/// Those kReportKeyframes frames of the trajectory side by side, with the fitted legs (right red,
/// left blue) and the labelled points: bytes of a JPEG file. Throws Error if the video ends too
/// early.
std::string keyframe_strip(const std::filesystem::path& video, const Trajectory& trajectory,
                           const SagittalModel& model, const Calibration& calibration,
                           const std::vector<int>& frames, int width_px, int height_px);

}  // namespace stride::report
