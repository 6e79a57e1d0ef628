#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "extract/pose/blazepose.h"

namespace stride::pose {

/// What looks at pictures: the two networks, or a test's stand-ins. Used by one thread at a time.
struct Viewer {
  std::function<std::vector<Candidate>(const cv::Mat& bgr, const Crop& region)> find;
  std::function<PoseLandmarks(const cv::Mat& bgr, const Crop& crop)> look;
};

/// The frames of a clip, in any order, from two threads.
struct Frames {
  int count = 0;
  std::function<cv::Mat(int frame)> image;
};

struct FollowOptions {
  int sampled_frames = 12;                         // on which people are looked for
  int most_people = 3;                             // that are followed
  std::function<void(int done, int of)> progress;  // frames looked at; from two threads, in turn
};

struct FollowedPerson {
  std::vector<std::optional<PoseLandmarks>>
      frames;        // of each frame of the clip; nothing where lost
  int seen = 0;      // frames
  int striding = 0;  // frames of the longest time in which steps followed one another regularly
};

/// Follows everybody who is seen on some of the sampled frames, from where he is seen best, both
/// ways at once. The crop of a frame comes from the last one's body. Somebody lost is looked for
/// near the last place by the detector; who leaves the picture is not looked for again, so that no
/// bystander takes over. First in the list: who moves in strides for longest.
std::vector<FollowedPerson> follow_people(const Frames& frames, Viewer& forward, Viewer& backward,
                                          const FollowOptions& options = {});

}  // namespace stride::pose
