#include "extract/video/overlay.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <span>

#include "extract/video/video.h"
#include "extract/video/video_writer.h"

namespace stride::video {
namespace {

const cv::Scalar kNear(40, 140, 255), kFar(235, 150, 40), kTrunk(245, 245, 245), kEdge(25, 25, 25);
constexpr int kSubpixelBits = 4;

cv::Point fixed_point(const Eigen::Vector2d& p) {
  constexpr double kOne = 1 << kSubpixelBits;
  return {static_cast<int>(std::lround(p.x() * kOne)), static_cast<int>(std::lround(p.y() * kOne))};
}

/// A layer over the image with opacity for each stroke.
class Brush {
 public:
  Brush(cv::Mat& image, double scale) : image_(image), scale_(scale) {}

  void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const cv::Scalar& colour,
            double width, double opacity) {
    mix(opacity, box(a, b, width), [&](cv::Mat& layer) {
      cv::line(layer, fixed_point(a), fixed_point(b), kEdge, thickness(width + 1.6), cv::LINE_AA,
               kSubpixelBits);
      cv::line(layer, fixed_point(a), fixed_point(b), colour, thickness(width), cv::LINE_AA,
               kSubpixelBits);
    });
  }

  /// A limb that nobody sees.
  void dashes(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const cv::Scalar& colour,
              double width, double opacity) {
    constexpr double kDash = 4;  // and as much between two
    const double length = (b - a).norm();
    const Eigen::Vector2d step = kDash * scale_ * (b - a) / std::max(length, 1e-6);
    for (int i = 0; 2 * i * kDash * scale_ < length; ++i)
      line(a + 2 * i * step, a + (2 * i + 1) * step, colour, width, opacity);
  }

  void ring(const Eigen::Vector2d& p, const cv::Scalar& colour, double radius, double opacity) {
    const auto fixed_radius = static_cast<int>(std::lround(radius * scale_ * (1 << kSubpixelBits)));
    mix(opacity, box(p, p, 2 * radius + 2), [&](cv::Mat& layer) {
      for (const auto& [each, width] : {std::pair(kEdge, 2.6), std::pair(colour, 1.3)})
        cv::circle(layer, fixed_point(p), fixed_radius, each, thickness(width), cv::LINE_AA,
                   kSubpixelBits);
    });
  }

  void dot(const Eigen::Vector2d& p, const cv::Scalar& colour, double radius, double opacity) {
    const auto fixed_radius = [&](double r) {
      return static_cast<int>(std::lround(r * scale_ * (1 << kSubpixelBits)));
    };
    mix(opacity, box(p, p, 2 * radius + 2), [&](cv::Mat& layer) {
      cv::circle(layer, fixed_point(p), fixed_radius(radius + 0.9), kEdge, cv::FILLED, cv::LINE_AA,
                 kSubpixelBits);
      cv::circle(layer, fixed_point(p), fixed_radius(radius), colour, cv::FILLED, cv::LINE_AA,
                 kSubpixelBits);
    });
  }

 private:
  int thickness(double width) const {
    return std::max(1, static_cast<int>(std::lround(width * scale_)));
  }

  cv::Rect box(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double width) const {
    const double margin = width * scale_ + 4;
    const Eigen::Vector2d low = a.cwiseMin(b).array() - margin,
                          high = a.cwiseMax(b).array() + margin;
    const cv::Rect rect(static_cast<int>(low.x()), static_cast<int>(low.y()),
                        static_cast<int>(high.x() - low.x()) + 1,
                        static_cast<int>(high.y() - low.y()) + 1);
    return rect & cv::Rect(0, 0, image_.cols, image_.rows);
  }

  template <typename Paint>
  void mix(double opacity, const cv::Rect& area, Paint paint) {
    if (area.empty()) return;
    cv::Mat target = image_(area), before = target.clone();
    paint(image_);
    cv::addWeighted(target, opacity, before, 1 - opacity, 0, target);
  }

  cv::Mat& image_;
  double scale_;
};

double opacity(double confidence) { return 0.3 + 0.7 * std::clamp(confidence, 0.0, 1.0); }

void draw_joint(Brush& brush, const Point& point, const cv::Scalar& colour, double radius) {
  if (!point.seen()) return brush.ring(point.p_px, colour, radius, opacity(point.confidence));
  brush.dot(point.p_px, colour, radius, opacity(point.confidence));
  if (point.source == Source::clicked) brush.dot(point.p_px, kTrunk, 0.4 * radius, 1);
}

struct Leg {
  std::span<const Bone> bones;  // from the hip
  Bone sole;
  BodyPart ankle;
};
constexpr Leg kRightLeg{kLegBones<Side::right>, kSoles[0], BodyPart::ankle_r},
    kLeftLeg{kLegBones<Side::left>, kSoles[1], BodyPart::ankle_l};

void draw_leg(Brush& brush, const TrajectoryFrame& frame, const Leg& leg,
              const cv::Scalar& colour) {
  const BodyPart hip = leg.bones.front().from;
  const auto draw = [&](const Bone& bone) {
    const auto& [from, to] = bone;
    const Point& a = frame[from == hip && !frame[hip].present() ? BodyPart::pelvis : from];
    const Point& b = frame[to];
    if (!a.present() || !b.present()) return;
    const double width = row(to).required ? 3 : 2,
                 sure = opacity(std::min(a.confidence, b.confidence));
    if (b.seen())
      brush.line(a.p_px, b.p_px, colour, width, sure);
    else
      brush.dashes(a.p_px, b.p_px, colour, width, sure);
  };
  for (const Bone& bone : leg.bones) draw(bone);
  draw(leg.sole);
  for (const auto& [from, to] : leg.bones)
    if (frame[to].present()) draw_joint(brush, frame[to], colour, 3.2);
}

/// Positions of a part on the frames of the last seconds, oldest first, moved with the ground to
/// frame `i`. A background that could not be followed counts as at rest.
std::vector<Eigen::Vector2d> displacement_over_ground(const Trajectory& trajectory, std::size_t i,
                                                      BodyPart part, double seconds) {
  std::vector<Eigen::Vector2d> displacement;
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();
  const double now_s = trajectory.frames[i].time_s;
  for (std::size_t k = i;; --k) {
    const TrajectoryFrame& frame = trajectory.frames[k];
    if (!frame[part].present() || frame.time_s < now_s - seconds) break;
    displacement.emplace_back(frame[part].p_px + moved);
    if (k == 0) break;
    if (frame.camera_px.allFinite()) moved += frame.camera_px;
  }
  std::ranges::reverse(displacement);
  return displacement;
}

/// Catmull–Rom interpolation between b and c.
Eigen::Vector2d between(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                        const Eigen::Vector2d& c, const Eigen::Vector2d& d, double t) {
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

/// A trail that fades and narrows with age. It is drawn in a mask first, so that overlapping pieces
/// do not show.
void draw_trail(cv::Mat& image, const std::vector<Eigen::Vector2d>& displacement,
                const cv::Scalar& colour, double scale) {
  constexpr int kPieces = 5;
  const int n = static_cast<int>(displacement.size());
  if (n < 2) return;
  cv::Mat opacity(image.size(), CV_8U, cv::Scalar(0));
  const auto at = [&](int k) {
    return displacement[static_cast<std::size_t>(std::clamp(k, 0, n - 1))];
  };
  for (int k = 0; k + 1 < n; ++k)
    for (int piece = 0; piece < kPieces; ++piece) {
      const auto point = [&](int p) {
        return fixed_point(between(at(k - 1), at(k), at(k + 1), at(k + 2), p / double(kPieces)));
      };
      const double youth = (k + (piece + 1.0) / kPieces) / (n - 1);
      cv::line(opacity, point(piece), point(piece + 1), cv::Scalar(225 * youth),
               std::max(1, static_cast<int>(std::lround(4 * scale * youth))), cv::LINE_AA,
               kSubpixelBits);
    }
  const cv::Rect area = cv::boundingRect(opacity);
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x) {
      const double share = opacity.at<unsigned char>(y, x) / 255.0;
      auto& pixel = image.at<cv::Vec3b>(y, x);
      for (int c = 0; c < 3; ++c)
        pixel[c] = cv::saturate_cast<unsigned char>((1 - share) * pixel[c] + share * colour[c]);
    }
}

}  // namespace

void draw_points(cv::Mat& image, const Trajectory& trajectory, std::size_t i,
                 const OverlayStyle& style) {
  Brush brush(image, style.scale);
  const TrajectoryFrame& frame = trajectory.frames[i];
  const auto& [near, far] =
      style.near_is_right ? std::pair(kRightLeg, kLeftLeg) : std::pair(kLeftLeg, kRightLeg);
  for (const auto& [leg, colour] : {std::pair(far, kFar), std::pair(near, kNear)})
    draw_trail(image, displacement_over_ground(trajectory, i, leg.ankle, style.trail_s), colour,
               style.scale);
  const Point &pelvis = frame[BodyPart::pelvis], &head = frame[BodyPart::head];
  draw_leg(brush, frame, far, kFar);
  if (pelvis.present() && head.present())
    brush.line(pelvis.p_px, head.p_px, kTrunk, 2, opacity(head.confidence));
  draw_leg(brush, frame, near, kNear);
  for (const Point* point : {&pelvis, &head})
    if (point->present()) draw_joint(brush, *point, kTrunk, 3.6);
}

OverlayStyle overlay_style(const Trajectory& trajectory) {
  OverlayStyle style;
  style.near_is_right = trajectory.direction != Facing::left;
  style.scale = std::clamp(trajectory.height_px / 360.0, 0.7, 3.0);
  return style;
}

void write_overlay(const std::filesystem::path& file, const Trajectory& trajectory,
                   const std::filesystem::path& out) {
  Video video(file);
  VideoWriter writer(out, video.info().rate_hz);
  const OverlayStyle style = overlay_style(trajectory);
  VideoFrame frame;
  std::size_t i = 0;
  while (video.read(frame)) {
    while (i < trajectory.frames.size() && trajectory.frames[i].frame < frame.index) ++i;
    if (i < trajectory.frames.size() && trajectory.frames[i].frame == frame.index)
      draw_points(frame.image, trajectory, i, style);
    writer.write(frame.image);
  }
  writer.finish();
}

}  // namespace stride::video
