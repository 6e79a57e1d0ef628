#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "extract/skeleton/trajectory.h"

namespace stride::film {

/// One stride of the source video, repeated in phase with the runner; or all of a movement that
/// does not repeat.
struct SourceStride {
  std::vector<double> phase;  // ascending, [0, 1)
  std::vector<cv::Mat> frames;
  bool repeats = true;

  /// The frame nearest to a phase (any real number, modulo 1 where it repeats).
  const cv::Mat& at(double phase) const;
};

/// The frames of a stride that begins at `start_s` (the runner's time) and lasts `period_s`. If
/// `trajectory` is given, each is cut to a window of `aspect` (width over height) around the
/// pelvis; a run to the left is mirrored, so that both run to the right. Throws Error if the video
/// does not show the whole stride.
SourceStride read_source_stride(const std::filesystem::path& video, double start_s, double period_s,
                                double slow_motion = 1, const Trajectory* trajectory = nullptr,
                                double aspect = 1);

/// Both pictures at the height of the right one, side by side, with a line between; the width is
/// even, as H.264 wants it.
cv::Mat side_by_side(const cv::Mat& left, const cv::Mat& right);

}  // namespace stride::film
