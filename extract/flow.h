#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "extract/body_part.h"

namespace stride {

struct FlowOptions {
  int window_px = 21;  // side of the square that is followed
  int pyramid_levels = 3;
  double round_trip_px = 1;     // a step that does not lead back this closely is not believed
  double step_px = 8;           // nor one that is this far from the step of the prior
  int longest_gap_frames = 48;  // between two clicks; over a longer one nothing is followed
};

/// Places of the marked parts on one frame.
using Places = std::array<std::optional<Eigen::Vector2d>, kBodyPartCount>;

/// A part followed from one frame to the next.
struct FlowStep {
  Eigen::Vector2d way_px = Eigen::Vector2d::Zero();  // forward in time
  bool believed = false;                             // else the way is the prior's
  double round_trip_px = 0;                          // distance after there and back
};

/// A part between two marks: followed forward from the first and backward from the second.
struct FlowStretch {
  BodyPart part = BodyPart::pelvis;
  int first = 0, last = 0;                  // the marked frames
  std::vector<FlowStep> forward, backward;  // from first to first + 1, …, from last − 1 to last
  Eigen::Vector2d forward_miss_px = Eigen::Vector2d::Zero();  // arrival minus mark
  Eigen::Vector2d backward_miss_px = Eigen::Vector2d::Zero();
};

/// Follows marked parts by pyramidal Lucas–Kanade started from a prior, while frames come front to
/// back; keeps only the frames since the last mark.
class FlowTracker {
 public:
  /// `prior(part, frame)`: where the part is expected.
  using Prior = std::function<Eigen::Vector2d(BodyPart, int)>;
  FlowTracker(FlowOptions options, Prior prior);
  ~FlowTracker();

  /// The next frame (its number grows by one) and the marks on it.
  void add(int frame, const cv::Mat& bgr, const Places& marks);

  const std::vector<FlowStretch>& stretches() const { return stretches_; }

 private:
  struct Image;
  void follow(int first, int last, const std::vector<BodyPart>& parts, const Places& from,
              std::vector<FlowStretch>& out, bool backward) const;

  FlowOptions options_;
  Prior prior_;
  std::vector<Image> images_;
  std::array<std::optional<int>, kBodyPartCount> last_mark_;
  std::map<int, Places> marks_;
  std::vector<FlowStretch> stretches_;
};

}  // namespace stride
