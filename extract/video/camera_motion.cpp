#include "extract/video/camera_motion.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "extract/io/statistics.h"

namespace stride::video {
namespace {

constexpr double kRoundTrip_px = 0.7;
constexpr int kRenewal_frames = 8, kLevels = 3;
const cv::Size kWindow(15, 15);

std::vector<cv::Point2f> background_corners(const cv::Mat& gray, const cv::Rect& runner, int most) {
  cv::Mat mask(gray.size(), CV_8U, cv::Scalar(255));
  mask(runner & cv::Rect(0, 0, gray.cols, gray.rows)).setTo(0);
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(gray, corners, most, 0.01, std::max(5.0, gray.cols / 50.0), mask);
  return corners;
}

/// Corners outside the runner that pass the forward–backward check, in both images.
struct Matches {
  std::vector<cv::Point2f> from, to;
};
Matches matched(const std::vector<cv::Mat>& from, const std::vector<cv::Mat>& to,
                const std::vector<cv::Point2f>& corners, const cv::Rect& runner) {
  Matches matches;
  if (corners.empty()) return matches;
  std::vector<cv::Point2f> there, back;
  std::vector<unsigned char> found, found_back;
  const cv::TermCriteria stop(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 10, 0.03);
  cv::calcOpticalFlowPyrLK(from, to, corners, there, found, cv::noArray(), kWindow, kLevels, stop);
  cv::calcOpticalFlowPyrLK(to, from, there, back, found_back, cv::noArray(), kWindow, kLevels,
                           stop);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (!found[i] || !found_back[i] || cv::norm(back[i] - corners[i]) > kRoundTrip_px) continue;
    if (runner.contains(cv::Point(there[i]))) continue;
    matches.from.push_back(corners[i]);
    matches.to.push_back(there[i]);
  }
  return matches;
}

CameraStep step_of(const Matches& matches, cv::Size size, double agreement_px) {
  if (matches.from.size() < 8) return {};
  std::vector<unsigned char> agrees;
  const cv::Mat a = cv::estimateAffinePartial2D(matches.from, matches.to, agrees, cv::RANSAC,
                                                agreement_px, 500, 0.99);
  if (a.empty()) return {};
  const Eigen::Matrix2d linear{{a.at<double>(0, 0), a.at<double>(0, 1)},
                               {a.at<double>(1, 0), a.at<double>(1, 1)}};
  const Eigen::Vector2d offset(a.at<double>(0, 2), a.at<double>(1, 2));
  const Eigen::Vector2d centre((size.width - 1) / 2.0, (size.height - 1) / 2.0);
  std::vector<double> residuals;
  for (std::size_t i = 0; i < agrees.size(); ++i) {
    if (!agrees[i]) continue;
    const Eigen::Vector2d p(matches.from[i].x, matches.from[i].y),
        q(matches.to[i].x, matches.to[i].y);
    residuals.push_back((linear * p + offset - q).norm());
  }
  CameraStep step;
  step.features = static_cast<int>(residuals.size());
  if (!step.known()) return {};
  step.residual_px = median(std::move(residuals));
  step.displacement_px = linear * centre + offset - centre;
  step.scale = linear.col(0).norm();
  step.roll_rad = std::atan2(linear(1, 0), linear(0, 0));
  return step;
}

}  // namespace

CameraTracker::CameraTracker(CameraOptions options) : options_(options) {}

CameraStep CameraTracker::add(const cv::Mat& bgr, const cv::Rect& runner) {
  cv::Mat gray;
  cv::cvtColor(bgr, gray, cv::COLOR_BGR2GRAY);
  const double shrink = std::min(1.0, static_cast<double>(options_.width_px) / gray.cols);
  if (shrink < 1) cv::resize(gray, gray, {}, shrink, shrink, cv::INTER_AREA);
  const cv::Rect box(static_cast<int>(runner.x * shrink), static_cast<int>(runner.y * shrink),
                     static_cast<int>(runner.width * shrink) + 1,
                     static_cast<int>(runner.height * shrink) + 1);
  std::vector<cv::Mat> pyramid;
  cv::buildOpticalFlowPyramid(gray, pyramid, kWindow, kLevels);
  CameraStep step;
  if (!before_.empty()) {
    const Matches matches = matched(before_, pyramid, corners_, box);
    step = step_of(matches, gray.size(), options_.agreement_px);
    step.displacement_px /= shrink;
    step.residual_px /= shrink;
    corners_ = matches.to;
  }
  if (++age_ >= kRenewal_frames ||
      corners_.size() < static_cast<std::size_t>(options_.most_features) / 2) {
    corners_ = background_corners(gray, box, options_.most_features);
    age_ = 0;
  }
  before_ = std::move(pyramid);
  return step;
}

}  // namespace stride::video
