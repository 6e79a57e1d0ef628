#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "extract/skeleton/trajectory.h"
#include "extract/video/decoded_clip.h"

namespace stride::tracking {

struct FlowOptions {
  int window_px = 21;  // side of the tracked window
  int pyramid_levels = 3;
  double round_trip_px = 1;       // largest forward–backward error of an inlier
  double step_px = 8;             // largest distance of an inlier from the prior's displacement
  int longest_gap_frames = 48;    // between two clicks; longer gaps are not followed
  double least_confidence = 0.6;  // points of at least this confidence are followed
};

/// A part followed from one frame to the next.
struct FlowStep {
  Eigen::Vector2d displacement_px = Eigen::Vector2d::Zero();  // forward in time
  bool inlier = false;       // else the displacement is the prior's
  double round_trip_px = 0;  // forward–backward error
};

/// The flow of a part between two labelled points: forward from the first, backward from the
/// second.
struct FlowStretch {
  BodyPart part = BodyPart::pelvis;
  int first = 0, last = 0;                  // the marked frames
  std::vector<FlowStep> forward, backward;  // from first to first + 1, …, from last − 1 to last
  Eigen::Vector2d forward_miss_px = Eigen::Vector2d::Zero();  // arrival minus labelled point
  Eigen::Vector2d backward_miss_px = Eigen::Vector2d::Zero();
};

/// The prior's position of a part on a frame.
using ExpectedPlace = std::function<Eigen::Vector2d(BodyPart, int frame)>;

/// Follows parts by pyramidal Lucas–Kanade, starting from the prior, between consecutive labelled
/// points in both directions. `crops` has one for each frame from the first labelled one to the
/// last.
std::vector<FlowStretch> follow(const Trajectory& marks,
                                const std::vector<video::RunnerCrop>& crops,
                                const ExpectedPlace& expected, const FlowOptions& options = {});

}  // namespace stride::tracking
