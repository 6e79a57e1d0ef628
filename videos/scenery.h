#pragma once

#include <Eigen/Core>
#include <memory>
#include <string_view>
#include <vector>

#include "videos/patch.h"
#include "videos/pinhole_camera.h"
#include "videos/skeleton.h"
#include "videos/texture.h"

namespace stride::videos {

/// A soft shadow on the ground.
struct ShadowBlob {
  double x_m = 0, z_m = 0, radius_m = 0, strength = 0;
};

/// The runner's shadow under a high sun in front and to the side.
std::vector<ShadowBlob> cast_shadow(const Skeleton& skeleton);

/// The scene of a clip. `z` grows towards the camera; the runner runs at z = 0.
class Scenery {
 public:
  virtual ~Scenery() = default;
  /// Paints every pixel of a float image, with one sample at (u + du, v + dv). `belt_m`: distance
  /// that a treadmill's belt has moved.
  void paint(const PinholeCamera& camera, double du, double dv,
             const std::vector<ShadowBlob>& shadow, double belt_m, cv::Mat& image) const;

  /// Objects behind and in front of the runner, as seen by the camera.
  virtual std::vector<Patch> behind(bool) const { return {}; }
  virtual std::vector<Patch> before(bool) const { return {}; }

 protected:
  virtual Colour ground(double x_m, double z_m, double belt_m) const = 0;
  /// Position of the wall; it is wall_height_m high.
  virtual double wall_z_m() const = 0;
  virtual double wall_height_m() const = 0;
  virtual Colour wall(double x_m, double y_m) const = 0;
  /// Behind the wall: `x` along the track at 30 m behind it, `elevation` as tangent above the
  /// horizon.
  virtual Colour beyond(double x_m, double elevation) const = 0;
};

/// A running track with boards and trees behind it.
std::unique_ptr<Scenery> track_scene(std::uint64_t seed);

/// A pavement along a wall of bricks.
std::unique_ptr<Scenery> street_scene(std::uint64_t seed);
/// A treadmill in a gym, at x = 0.
std::unique_ptr<Scenery> gym_scene(std::uint64_t seed);
/// Plates of metal under a planet.
std::unique_ptr<Scenery> arena_scene(std::uint64_t seed);
/// Drawn hills.
std::unique_ptr<Scenery> meadow_scene();
/// Nothing but black.
std::unique_ptr<Scenery> dark_scene();

}  // namespace stride::videos
