#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <utility>
#include <vector>

#include "extract/skeleton/trajectory.h"
#include "extract/video/video.h"

namespace stride::tracking {

/// Pairs of neighbouring frames of a video, small and grey.
struct Glimpse {
  int frame = 0;  // of the first
  cv::Mat first, second;
  double scale = 1;  // of their pixels to those of the video
};

/// Collects the glimpses that some points can be compared with, while a video is decoded front to
/// back: a dozen, spread over the frames that have points.
class Glimpses {
 public:
  explicit Glimpses(const Trajectory& points);
  /// Of these frames and those after them, in growing order.
  explicit Glimpses(std::vector<int> first_frames) : wanted_(std::move(first_frames)) {}
  void add(const video::VideoFrame& frame);
  const std::vector<Glimpse>& all() const { return glimpses_; }

 private:
  std::vector<int> wanted_;  // first frames of the pairs
  std::vector<Glimpse> glimpses_;
};

/// Whether points move as the picture does where they are.
struct PictureCheck {
  int compared = 0;    // points that move and were followed by optical flow
  double follow = 0;   // share of them that go where the flow goes
  std::string remedy;  // what makes far more of them follow; empty: nothing that is known
};

/// Points of another size, turned, upside down, cropped, or of other frames lie beside the limbs
/// that they name. `info` is the video's.
PictureCheck check_with_picture(const Trajectory& points, const std::vector<Glimpse>& glimpses,
                                const video::VideoInfo& info);

/// The same if the points are of the frames this many later than their numbers; without a remedy.
PictureCheck follow_frames_later(const Trajectory& points, const std::vector<Glimpse>& glimpses,
                                 int frames_later);

/// Whether enough was compared, and so little of it follows that the points cannot be the
/// picture's.
bool is_beside_the_picture(const PictureCheck& check);

}  // namespace stride::tracking
