#pragma once

#include <filesystem>
#include <vector>

#include "extract/skeleton/trajectory.h"

namespace stride::tracking {

/// Frames on which a file has no points and which its numbers do not count: points from `frame`
/// (by the file's number) on are of the picture this many frames later.
struct LeftOutFrames {
  int frame = 0;
  int count = 0;
};

/// Frames at which most of the joints leap: their paths before and after do not meet between it and
/// the frame before. Exchanged legs are no leap.
std::vector<int> leaps_of(const Trajectory& points);

/// What was left out of the numbers, by the picture: after a leap the points go where the picture
/// of some later frames goes, and not where that of their own frames goes. `frames` is how many the
/// video has. Decodes the video if there are leaps and frames without points at the end.
std::vector<LeftOutFrames> left_out_frames(const Trajectory& points,
                                           const std::filesystem::path& video, int frames);

}  // namespace stride::tracking
