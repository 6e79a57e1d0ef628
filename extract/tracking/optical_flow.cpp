#include "extract/tracking/optical_flow.h"

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <optional>

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

/// Image pyramids of the crops, built on demand.
class Pyramids {
 public:
  Pyramids(const std::vector<video::RunnerCrop>& crops, const FlowOptions& options)
      : crops_(crops), options_(options), pyramids_(crops.size()) {}

  const std::vector<cv::Mat>& at(std::size_t i) {
    if (pyramids_[i].empty())
      cv::buildOpticalFlowPyramid(crops_[i].image(), pyramids_[i],
                                  {options_.window_px, options_.window_px},
                                  options_.pyramid_levels);
    return pyramids_[i];
  }
  void forget_before(std::size_t i) {
    for (; forgotten_ < i; ++forgotten_) pyramids_[forgotten_] = {};
  }

 private:
  const std::vector<video::RunnerCrop>& crops_;
  const FlowOptions& options_;
  std::vector<std::vector<cv::Mat>> pyramids_;
  std::size_t forgotten_ = 0;
};

/// Parts that are labelled on the same two frames and on none between.
struct Pass {
  int first, last;
  std::vector<BodyPart> parts;
  std::vector<Vector2d> from_px, to_px;
};

/// Sorted by their last frames.
std::vector<Pass> passes(const Trajectory& marks, const FlowOptions& options) {
  std::vector<Pass> result;
  std::array<const TrajectoryFrame*, kBodyPartCount> before{};
  for (const TrajectoryFrame& mark : marks.frames) {
    std::map<int, Pass> arrived;
    for (const BodyPart part : kBodyParts) {
      if (!mark[part].present() || mark[part].confidence < options.least_confidence) continue;
      const TrajectoryFrame* from = std::exchange(before[index(part)], &mark);
      if (from == nullptr || mark.frame - from->frame < 2 ||
          mark.frame - from->frame > options.longest_gap_frames)
        continue;
      Pass& pass =
          arrived.try_emplace(from->frame, Pass{from->frame, mark.frame, {}, {}, {}}).first->second;
      pass.parts.push_back(part);
      pass.from_px.push_back((*from)[part].p_px);
      pass.to_px.push_back(mark[part].p_px);
    }
    for (auto& [first, pass] : arrived) result.push_back(std::move(pass));
  }
  return result;
}

class Follower {
 public:
  Follower(int first_frame, const std::vector<video::RunnerCrop>& crops,
           const ExpectedPlace& expected, const FlowOptions& options)
      : first_frame_(first_frame),
        crops_(crops),
        expected_(expected),
        options_(options),
        pyramids_(crops, options) {}

  void follow(const Pass& pass, std::vector<FlowStretch>& stretches) {
    const std::size_t begin = stretches.size();
    for (const BodyPart part : pass.parts) {
      FlowStretch& stretch = stretches.emplace_back();
      stretch.part = part;
      stretch.first = pass.first;
      stretch.last = pass.last;
      stretch.forward.resize(static_cast<std::size_t>(pass.last - pass.first));
      stretch.backward.resize(stretch.forward.size());
    }
    std::vector<Vector2d> points_px = pass.from_px;
    for (int frame = pass.first; frame < pass.last; ++frame) {
      const auto steps = step(pass.parts, points_px, frame, frame + 1);
      for (std::size_t i = 0; i < steps.size(); ++i)
        stretches[begin + i].forward[static_cast<std::size_t>(frame - pass.first)] = steps[i];
    }
    for (std::size_t i = 0; i < points_px.size(); ++i)
      stretches[begin + i].forward_miss_px = points_px[i] - pass.to_px[i];

    points_px = pass.to_px;
    for (int frame = pass.last; frame > pass.first; --frame) {
      const auto steps = step(pass.parts, points_px, frame, frame - 1);
      for (std::size_t i = 0; i < steps.size(); ++i)
        stretches[begin + i].backward[static_cast<std::size_t>(frame - 1 - pass.first)] = steps[i];
    }
    for (std::size_t i = 0; i < points_px.size(); ++i)
      stretches[begin + i].backward_miss_px = points_px[i] - pass.from_px[i];
  }

  void forget_before(int frame) { pyramids_.forget_before(at(std::max(frame, first_frame_))); }

 private:
  std::size_t at(int frame) const { return static_cast<std::size_t>(frame - first_frame_); }

  cv::Point2f in_view(const Vector2d& p_px, int frame) const {
    const cv::Point origin = crops_[at(frame)].origin;
    return {static_cast<float>(p_px.x() - origin.x), static_cast<float>(p_px.y() - origin.y)};
  }
  Vector2d in_frame(const cv::Point2f& p, int frame) const {
    const cv::Point origin = crops_[at(frame)].origin;
    return {static_cast<double>(p.x) + origin.x, static_cast<double>(p.y) + origin.y};
  }

  /// Lucas–Kanade from one frame to another, starting at `guess`.
  std::vector<unsigned char> lucas_kanade(int from, int to, const std::vector<cv::Point2f>& points,
                                          std::vector<cv::Point2f>& guess) {
    std::vector<unsigned char> found;
    cv::calcOpticalFlowPyrLK(
        pyramids_.at(at(from)), pyramids_.at(at(to)), points, guess, found, cv::noArray(),
        {options_.window_px, options_.window_px}, options_.pyramid_levels,
        cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.02),
        cv::OPTFLOW_USE_INITIAL_FLOW, 1e-4);
    return found;
  }

  /// Moves the points on to the next frame, one before or after this one.
  std::vector<FlowStep> step(const std::vector<BodyPart>& parts, std::vector<Vector2d>& points_px,
                             int frame, int next) {
    const std::size_t n = parts.size();
    std::vector<cv::Point2f> here(n), there(n), back(n);
    std::vector<Vector2d> expected_px(n);
    for (std::size_t i = 0; i < n; ++i) {
      expected_px[i] = points_px[i] + expected_(parts[i], next) - expected_(parts[i], frame);
      here[i] = back[i] = in_view(points_px[i], frame);
      there[i] = in_view(expected_px[i], next);
    }
    const auto found = lucas_kanade(frame, next, here, there);
    const auto found_back = lucas_kanade(next, frame, there, back);
    std::vector<FlowStep> steps(n);
    for (std::size_t i = 0; i < n; ++i) {
      FlowStep& step = steps[i];
      const Vector2d arrived_px = in_frame(there[i], next);
      step.round_trip_px = cv::norm(back[i] - here[i]);
      step.inlier = found[i] && found_back[i] && step.round_trip_px < options_.round_trip_px &&
                    (arrived_px - expected_px[i]).norm() < options_.step_px;
      const Vector2d next_px = step.inlier ? arrived_px : expected_px[i];
      step.displacement_px = (next - frame) * (next_px - points_px[i]);
      points_px[i] = next_px;
    }
    return steps;
  }

  int first_frame_;
  const std::vector<video::RunnerCrop>& crops_;
  const ExpectedPlace& expected_;
  const FlowOptions& options_;
  Pyramids pyramids_;
};

}  // namespace

std::vector<FlowStretch> follow(const Trajectory& marks,
                                const std::vector<video::RunnerCrop>& crops,
                                const ExpectedPlace& expected, const FlowOptions& options) {
  std::vector<FlowStretch> stretches;
  if (marks.frames.empty()) return stretches;
  Follower follower(marks.frames.front().frame, crops, expected, options);
  for (const Pass& pass : passes(marks, options)) {
    follower.follow(pass, stretches);
    follower.forget_before(pass.last - options.longest_gap_frames);
  }
  return stretches;
}

}  // namespace stride::tracking
