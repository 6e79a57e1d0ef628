#include "extract/flow.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "extract/error.h"

namespace stride {

using Eigen::Vector2d;

struct FlowTracker::Image {
  int frame = 0;
  std::vector<cv::Mat> pyramid;
};

namespace {

cv::Point2f cv_point(const Vector2d& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y())};
}
Vector2d eigen_point(const cv::Point2f& p) { return {p.x, p.y}; }

/// Lucas–Kanade from one image to another, started at `guess`.
std::vector<unsigned char> lucas_kanade(const std::vector<cv::Mat>& from,
                                        const std::vector<cv::Mat>& to,
                                        const std::vector<cv::Point2f>& points,
                                        std::vector<cv::Point2f>& guess,
                                        const FlowOptions& options) {
  std::vector<unsigned char> found;
  cv::calcOpticalFlowPyrLK(
      from, to, points, guess, found, cv::noArray(), {options.window_px, options.window_px},
      options.pyramid_levels,
      cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.02),
      cv::OPTFLOW_USE_INITIAL_FLOW, 1e-4);
  return found;
}

}  // namespace

FlowTracker::FlowTracker(FlowOptions options, Prior prior)
    : options_(options), prior_(std::move(prior)) {}
FlowTracker::~FlowTracker() = default;

void FlowTracker::add(int frame, const cv::Mat& bgr, const Places& marks) {
  require(images_.empty() || frame == images_.back().frame + 1,
          "frame {}: follows frame {}; frames must come one by one", frame,
          images_.empty() ? 0 : images_.back().frame);
  cv::Mat gray;
  cv::cvtColor(bgr, gray, cv::COLOR_BGR2GRAY);
  Image& image = images_.emplace_back();
  image.frame = frame;
  cv::buildOpticalFlowPyramid(gray, image.pyramid, {options_.window_px, options_.window_px},
                              options_.pyramid_levels);
  marks_[frame] = marks;

  // Parts that were last marked on the same frame are followed together.
  std::map<int, std::vector<BodyPart>> arrived;
  for (const BodyPart part : kBodyParts) {
    std::optional<int>& last = last_mark_[index(part)];
    if (last && frame - *last > options_.longest_gap_frames) last.reset();
    if (!marks[index(part)]) continue;
    if (last && frame - *last > 1) arrived[*last].push_back(part);
    last = frame;
  }
  for (const auto& [first, parts] : arrived) {
    std::vector<FlowStretch> stretches(parts.size());
    follow(first, frame, parts, marks_.at(first), stretches, false);
    follow(first, frame, parts, marks, stretches, true);
    stretches_.insert(stretches_.end(), stretches.begin(), stretches.end());
  }

  int needed = frame;
  for (const auto& last : last_mark_)
    if (last) needed = std::min(needed, *last);
  std::erase_if(images_, [&](const Image& i) { return i.frame < needed; });
  std::erase_if(marks_, [&](const auto& entry) { return entry.first < needed; });
}

void FlowTracker::follow(int first, int last, const std::vector<BodyPart>& parts,
                         const Places& from, std::vector<FlowStretch>& out, bool backward) const {
  const auto image = [&](int frame) -> const std::vector<cv::Mat>& {
    return images_[static_cast<std::size_t>(frame - images_.front().frame)].pyramid;
  };
  const std::size_t n = parts.size();
  std::vector<Vector2d> points(n);
  for (std::size_t i = 0; i < n; ++i) {
    points[i] = *from[index(parts[i])];
    out[i].part = parts[i];
    out[i].first = first;
    out[i].last = last;
  }
  const int direction = backward ? -1 : 1;
  for (int frame = backward ? last : first; frame != (backward ? first : last);
       frame += direction) {
    const int next = frame + direction;
    std::vector<cv::Point2f> here(n), there(n), back(n);
    std::vector<Vector2d> expected(n);
    for (std::size_t i = 0; i < n; ++i) {
      expected[i] = points[i] + prior_(parts[i], next) - prior_(parts[i], frame);
      here[i] = back[i] = cv_point(points[i]);
      there[i] = cv_point(expected[i]);
    }
    const auto found = lucas_kanade(image(frame), image(next), here, there, options_);
    const auto found_back = lucas_kanade(image(next), image(frame), there, back, options_);
    for (std::size_t i = 0; i < n; ++i) {
      const double round_trip = cv::norm(back[i] - here[i]);
      const Vector2d arrived = eigen_point(there[i]);
      FlowStep& step = (backward ? out[i].backward : out[i].forward).emplace_back();
      step.round_trip_px = round_trip;
      step.believed = found[i] && found_back[i] && round_trip < options_.round_trip_px &&
                      (arrived - expected[i]).norm() < options_.step_px;
      const Vector2d next_point = step.believed ? arrived : expected[i];
      step.way_px = direction * (next_point - points[i]);
      points[i] = next_point;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    FlowStretch& stretch = out[i];
    if (backward) {
      std::ranges::reverse(stretch.backward);
      stretch.backward_miss_px = points[i] - *marks_.at(first)[index(parts[i])];
    } else {
      stretch.forward_miss_px = points[i] - *marks_.at(last)[index(parts[i])];
    }
  }
}

}  // namespace stride
