#include "videos/patch.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stride::videos {
namespace {

using Eigen::Vector2d;

/// The widths of a patch at equal steps along its axis, smooth through the stations.
class Profile {
 public:
  explicit Profile(const Patch& patch, double widened_m) : widened_(widened_m) {
    const auto& stations = patch.stations;
    start_ = stations.front().s;
    end_ = stations.back().s;
    std::size_t i = 0;
    for (int k = 0; k < kSamples; ++k) {
      const double s = start_ + (end_ - start_) * k / (kSamples - 1);
      while (i + 2 < stations.size() && s > stations[i + 1].s) ++i;
      front_[k] = between(stations, i, s, &Station::front);
      back_[k] = between(stations, i, s, &Station::back);
    }
    if (patch.round_start) cap_start_ = 0.5 * (front_[0] + back_[0]);
    if (patch.round_end) cap_end_ = 0.5 * (front_[kSamples - 1] + back_[kSamples - 1]);
    for (int k = 0; k < kSamples; ++k) widest_ = std::max({widest_, front_[k], back_[k]});
  }

  double start() const { return start_ - cap_start_ - widened_; }
  double end() const { return end_ + cap_end_ + widened_; }
  double widest() const { return widest_ + widened_; }

  struct Cross {
    double middle = 0, half = 0;  // of the width, m
    double along = 0;             // slope of a rounded end, -1 … 1
  };
  Cross at(double s) const {
    const double k = std::clamp((s - start_) / (end_ - start_), 0.0, 1.0) * (kSamples - 1);
    const int i = std::min(static_cast<int>(k), kSamples - 2);
    const double w = k - i;
    const double front = front_[i] * (1 - w) + front_[i + 1] * w,
                 back = back_[i] * (1 - w) + back_[i + 1] * w;
    Cross cross{0.5 * (front - back), 0.5 * (front + back) + widened_, 0};
    double beyond = 0;
    if (s < start_) beyond = (s - start_) / (cap_start_ + widened_);
    if (s > end_) beyond = (s - end_) / (cap_end_ + widened_);
    cross.along = std::clamp(beyond, -1.0, 1.0);
    cross.half *= std::sqrt(1 - cross.along * cross.along);
    return cross;
  }

 private:
  static constexpr int kSamples = 48;

  static double between(const std::vector<Station>& p, std::size_t i, double s,
                        double Station::*y) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 2, p.size() - 1);
    const double h = p[i + 1].s - p[i].s, w = (s - p[i].s) / h;
    const double m0 = h * (p[i + 1].*y - p[before].*y) / (p[i + 1].s - p[before].s);
    const double m1 = h * (p[after].*y - p[i].*y) / (p[after].s - p[i].s);
    const double w2 = w * w, w3 = w2 * w;
    return (2 * w3 - 3 * w2 + 1) * (p[i].*y) + (w3 - 2 * w2 + w) * m0 +
           (3 * w2 - 2 * w3) * (p[i + 1].*y) + (w3 - w2) * m1;
  }

  double start_, end_, cap_start_ = 0, cap_end_ = 0, widened_, widest_ = 0;
  std::array<double, kSamples> front_{}, back_{};
};

/// Light from above, a little from the front of the runner and from the camera.
Colour shaded(const Patch& patch, const Colour& colour, double across, double along) {
  const double side = patch.roundness * across, end = patch.end_roundness * along;
  const double toward = std::sqrt(std::max(0.0, 1 - side * side - end * end));
  const Vector2d normal = side * patch.front + end * patch.axis;
  const double diffuse = 0.30 * normal.x() + 0.62 * normal.y() + 0.72 * toward;
  const double brightness = patch.light * (0.42 + 0.62 * std::max(0.0, diffuse));
  Colour result = colour * static_cast<float>(brightness);
  if (patch.gloss > 0) {
    const double mirror = std::max(0.0, 0.22 * normal.x() + 0.5 * normal.y() + 0.84 * toward);
    const auto highlight = static_cast<float>(patch.light * patch.gloss * std::pow(mirror, 24));
    result += Colour(highlight, highlight, highlight);
  }
  return result;
}

/// Rows and columns of the image that the patch can reach.
cv::Rect reach(const Patch& patch, const Profile& profile, const PinholeCamera& camera,
               const cv::Mat& image) {
  Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const double s : {profile.start(), profile.end()})
    for (const double t : {-profile.widest(), profile.widest()}) {
      const Vector2d p = patch.origin + s * patch.axis + t * patch.front;
      const Vector2d corner = camera.project({p.x(), p.y(), patch.z_m});
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  const cv::Rect box(cv::Point(static_cast<int>(std::floor(low.x())) - 1,
                               static_cast<int>(std::floor(low.y())) - 1),
                     cv::Point(static_cast<int>(std::ceil(high.x())) + 2,
                               static_cast<int>(std::ceil(high.y())) + 2));
  return box & cv::Rect(0, 0, image.cols, image.rows);
}

const Colour kOutline(0.10F, 0.08F, 0.09F);

/// `widened_m` > 0: the outline alone.
void paint_one(const Patch& patch, const PinholeCamera& camera, double du, double dv,
               cv::Mat& image, double widened_m) {
  const Profile profile(patch, widened_m);
  const cv::Rect box = reach(patch, profile, camera, image);
  // (s, t) is affine in (u, v): three points give it.
  const auto local = [&](double u, double v) {
    const Vector2d p = camera.on_plane(u + du, v + dv, patch.z_m) - patch.origin;
    return Vector2d(p.dot(patch.axis), p.dot(patch.front));
  };
  const Vector2d at_origin = local(0, 0), per_u = local(1, 0) - at_origin,
                 per_v = local(0, 1) - at_origin;
  for (int v = box.y; v < box.y + box.height; ++v) {
    auto* row = image.ptr<Colour>(v);
    for (int u = box.x; u < box.x + box.width; ++u) {
      const Vector2d st = at_origin + u * per_u + v * per_v;
      if (st.x() <= profile.start() || st.x() >= profile.end()) continue;
      const auto cross = profile.at(st.x());
      const double across = (st.y() - cross.middle) / cross.half;
      if (!(std::abs(across) < 1)) continue;
      row[u] = widened_m > 0 ? kOutline
                             : shaded(patch, patch.colour(st.x(), across), across, cross.along);
    }
  }
}

}  // namespace

void paint(const std::vector<Patch>& patches, const PinholeCamera& camera, double du, double dv,
           cv::Mat& image) {
  for (std::size_t i = 0; i < patches.size();) {
    std::size_t end = i;
    for (; end < patches.size() && patches[end].group == patches[i].group; ++end)
      if (patches[end].outline_m > 0)
        paint_one(patches[end], camera, du, dv, image, patches[end].outline_m);
    for (; i < end; ++i) paint_one(patches[i], camera, du, dv, image, 0);
  }
}

}  // namespace stride::videos
