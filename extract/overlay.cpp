#include "extract/overlay.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "extract/video.h"
#include "extract/video_writer.h"

namespace stride {
namespace {

const cv::Scalar kNear(40, 140, 255), kFar(235, 150, 40), kTrunk(245, 245, 245), kEdge(25, 25, 25);
constexpr int kSubpixelBits = 4;

cv::Point fixed_point(const Eigen::Vector2d& p) {
  constexpr double kOne = 1 << kSubpixelBits;
  return {static_cast<int>(std::lround(p.x() * kOne)), static_cast<int>(std::lround(p.y() * kOne))};
}

/// A canvas over the image on which strokes are mixed in with an opacity.
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

struct Leg {
  BodyPart hip, knee, ankle, toe;
};
constexpr Leg kRightLeg{BodyPart::hip_r, BodyPart::knee_r, BodyPart::ankle_r, BodyPart::toe_r};
constexpr Leg kLeftLeg{BodyPart::hip_l, BodyPart::knee_l, BodyPart::ankle_l, BodyPart::toe_l};

void draw_leg(Brush& brush, const TrajectoryFrame& frame, const Leg& leg,
              const cv::Scalar& colour) {
  const BodyPart top = frame[leg.hip].present() ? leg.hip : BodyPart::pelvis;
  const std::array chain{top, leg.knee, leg.ankle, leg.toe};
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
    const Point &a = frame[chain[i]], &b = frame[chain[i + 1]];
    if (a.present() && b.present())
      brush.line(a.p_px, b.p_px, colour, i < 2 ? 3 : 2,
                 opacity(std::min(a.confidence, b.confidence)));
  }
  for (const BodyPart part : {leg.knee, leg.ankle, leg.toe})
    if (frame[part].present())
      brush.dot(frame[part].p_px, colour, 3.2, opacity(frame[part].confidence));
}

}  // namespace

void draw_points(cv::Mat& image, const Trajectory& trajectory, std::size_t i,
                 const OverlayStyle& style) {
  Brush brush(image, style.scale);
  const TrajectoryFrame& frame = trajectory.frames[i];
  const auto& [near, far] =
      style.near_is_right ? std::pair(kRightLeg, kLeftLeg) : std::pair(kLeftLeg, kRightLeg);
  for (int back = std::min<int>(style.trail_frames, static_cast<int>(i)); back > 0; --back)
    for (const auto& [leg, colour] : {std::pair(far, kFar), std::pair(near, kNear)}) {
      const auto at = [&](int frames_ago) -> const Point& {
        return trajectory.frames[i - static_cast<std::size_t>(frames_ago)][leg.ankle];
      };
      if (at(back).present() && at(back - 1).present())
        brush.line(at(back).p_px, at(back - 1).p_px, colour, 1,
                   0.5 * (1 - static_cast<double>(back) / (style.trail_frames + 1)));
    }
  const Point &pelvis = frame[BodyPart::pelvis], &head = frame[BodyPart::head];
  draw_leg(brush, frame, far, kFar);
  if (pelvis.present() && head.present())
    brush.line(pelvis.p_px, head.p_px, kTrunk, 2, opacity(head.confidence));
  draw_leg(brush, frame, near, kNear);
  for (const Point* point : {&pelvis, &head})
    if (point->present()) brush.dot(point->p_px, kTrunk, 3.6, opacity(point->confidence));
}

OverlayStyle overlay_style(const Trajectory& trajectory) {
  OverlayStyle style;
  style.near_is_right = trajectory.direction != "left";
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

}  // namespace stride
