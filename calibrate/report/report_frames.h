#pragma once

#include <filesystem>
#include <string>

#include "calibrate/calibrate.h"

namespace stride::report {

inline constexpr int kReportKeyframes = 8;  // of a stride, as the paper's

/// The video of a trajectory, if it is in `folder` and has the right hash; else empty.
std::filesystem::path video_in(const std::filesystem::path& folder, const Trajectory& trajectory);

/// The frames nearest to the keyframes of a stride, side by side, with the fitted legs (right red,
/// left blue) and the labelled points: bytes of a JPEG file. Throws Error if the video ends too
/// early.
std::string keyframe_strip(const std::filesystem::path& video, const Trajectory& trajectory,
                           const SagittalModel& model, const Calibration& calibration, int width_px,
                           int height_px);

}  // namespace stride::report
