#include "videos/scenery.h"

#include <algorithm>
#include <cmath>

namespace stride::videos {
namespace {

constexpr double kBeyond_m = 30;

double darkness(const std::vector<ShadowBlob>& shadow, double x_m, double z_m) {
  double sum = 0;
  for (const ShadowBlob& blob : shadow) {
    const double dx = x_m - blob.x_m, dz = z_m - blob.z_m;
    const double r2 = (dx * dx + dz * dz) / (blob.radius_m * blob.radius_m);
    if (r2 < 9) sum += blob.strength * std::exp(-r2);
  }
  return 0.52 * (1 - std::exp(-sum));
}

}  // namespace

std::vector<ShadowBlob> cast_shadow(const Skeleton& k) {
  // Sunlight moves forward and away from the camera as it falls.
  constexpr double kForward = 0.28, kAway = -0.22;
  std::vector<ShadowBlob> blobs;
  const auto limb = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                        double strength) {
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d p = from + (to - from) * (i + 0.5) / 4;
      const double blur = 0.03 + 0.05 * p.y();
      const double size = radius + blur;
      blobs.push_back({p.x() + kForward * p.y(), p.z() + kAway * p.y(), size,
                       strength * radius * radius / (size * size) * (size / radius)});
    }
  };
  for (int side : {0, 1}) {
    limb(k.hip[side], k.knee[side], 0.09, 0.9);
    limb(k.knee[side], k.ankle[side], 0.07, 0.9);
    limb(k.ankle[side], k.toe[side], 0.07, 1.3);
    limb(k.shoulder[side], k.elbow[side], 0.05, 0.6);
    limb(k.elbow[side], k.wrist[side], 0.05, 0.6);
  }
  limb(k.pelvis, k.shoulders, 0.15, 1.2);
  limb(k.head, k.head + Eigen::Vector3d(0, 0.1, 0), 0.11, 0.4);
  return blobs;
}

void Scenery::paint(const PinholeCamera& camera, double du, double dv,
                    const std::vector<ShadowBlob>& shadow, double belt_m, cv::Mat& image) const {
  double left = 1e9, right = -1e9;
  for (const ShadowBlob& blob : shadow) {
    left = std::min(left, blob.x_m - 3 * blob.radius_m);
    right = std::max(right, blob.x_m + 3 * blob.radius_m);
  }
  const double wall_depth = camera.distance_m - wall_z_m();
  for (int v = 0; v < image.rows; ++v) {
    auto* row = image.ptr<Colour>(v);
    for (int u = 0; u < image.cols; ++u) {
      const Eigen::Vector2d uv = camera.upright(u + du, v + dv) / camera.focal_px;
      const double depth = uv.y() > 0 ? camera.height_m / uv.y() : 1e9;
      if (depth < wall_depth) {
        const double x = camera.x_m + camera.direction() * uv.x() * depth;
        const double z = camera.distance_m - depth;
        row[u] = ground(x, z, belt_m);
        if (x > left && x < right)
          row[u] *= static_cast<float>(1 - darkness(shadow, x, camera.direction() * z));
        continue;
      }
      const double y = camera.height_m - uv.y() * wall_depth;
      if (y < wall_height_m())
        row[u] = wall(camera.x_m + camera.direction() * uv.x() * wall_depth, y);
      else
        row[u] =
            beyond(camera.x_m + camera.direction() * uv.x() * (wall_depth + kBeyond_m), -uv.y());
    }
  }
}

}  // namespace stride::videos
