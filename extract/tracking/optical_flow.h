#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "extract/skeleton/trajectory.h"
#include "extract/video/decoded_clip.h"

namespace stride::tracking {

struct FlowOptions {
  int window_px = 21;  // side of the square that is followed
  int pyramid_levels = 3;
  double round_trip_px = 1;       // a step that does not lead back this closely is not believed
  double step_px = 8;             // nor one that is this far from the step of the prior
  int longest_gap_frames = 48;    // between two clicks; over a longer one nothing is followed
  double least_confidence = 0.6;  // marks of at least this confidence are followed
};

/// A part followed from one frame to the next.
struct FlowStep {
  Eigen::Vector2d displacement_px = Eigen::Vector2d::Zero();  // forward in time
  bool inlier = false;                                        // else the way is the prior's
  double round_trip_px = 0;                                   // distance after there and back
};

/// A part between two marks: followed forward from the first and backward from the second.
struct FlowStretch {
  BodyPart part = BodyPart::pelvis;
  int first = 0, last = 0;                  // the marked frames
  std::vector<FlowStep> forward, backward;  // from first to first + 1, …, from last − 1 to last
  Eigen::Vector2d forward_miss_px = Eigen::Vector2d::Zero();  // arrival minus mark
  Eigen::Vector2d backward_miss_px = Eigen::Vector2d::Zero();
};

/// Where a part is expected on a frame.
using ExpectedPlace = std::function<Eigen::Vector2d(BodyPart, int frame)>;

/// Follows marked parts by pyramidal Lucas–Kanade started from what is expected, from mark to mark
/// in both directions. `sights` has one for each frame from the first mark to the last.
std::vector<FlowStretch> follow(const Trajectory& marks, const std::vector<video::Crop>& crops,
                                const ExpectedPlace& expected, const FlowOptions& options = {});

}  // namespace stride::tracking
