#include "videos/clip.h"

#include <cmath>
#include <numbers>
#include <random>

#include "extract/error.h"
#include "videos/noise.h"

namespace stride::videos {
namespace {

Clip human() {
  Clip clip;
  clip.name = "human";
  clip.description = "a man runs on a track, the camera follows";
  clip.seed = 11;
  clip.gait = rajagopal_run();
  clip.first_phase = 0.62;
  clip.deviation_rad = 0.4 * std::numbers::pi / 180;
  clip.camera.roll_rad = 0.022;
  clip.zoom = 0.02;
  return clip;
}

}  // namespace

Motion::Motion(const Clip& clip) : clip_(clip), grounding_(ground(clip.gait, clip.proportions)) {
  for (std::uint64_t joint = 0; joint < 6; ++joint) joints_.push_back(waves(joint));
  sway_x_ = waves(100);
  sway_y_ = waves(101);
}

std::vector<Motion::Wave> Motion::waves(std::uint64_t salt) const {
  std::mt19937_64 engine(clip_.seed * 1000 + salt);
  std::vector<Wave> waves(3);
  for (std::size_t i = 0; i < waves.size(); ++i)
    waves[i] = {(0.15 + 0.35 * static_cast<double>(i) + 0.2 * uniform(engine)),
                2 * std::numbers::pi * uniform(engine)};
  return waves;
}

double Motion::slow(const std::vector<Wave>& waves, double time_s) const {
  double sum = 0;
  for (const Wave& wave : waves)
    sum += std::sin(2 * std::numbers::pi * wave.cycles_per_s * time_s + wave.phase);
  return sum * std::sqrt(2.0 / static_cast<double>(waves.size()));
}

Skeleton Motion::skeleton(double time_s) const {
  const double phase = clip_.first_phase + time_s / clip_.gait.period_s;
  Deviation deviation;
  for (int side : {0, 1}) {
    deviation.hip[side] = clip_.deviation_rad * slow(joints_[3 * side], time_s);
    deviation.knee[side] = clip_.deviation_rad * slow(joints_[3 * side + 1], time_s);
    deviation.ankle[side] = clip_.deviation_rad * slow(joints_[3 * side + 2], time_s);
  }
  const double height = grounding_.mean_height_m + clip_.gait.pelvis_height_m(phase) -
                        clip_.gait.pelvis_height_m.mean;
  return pose(clip_.gait, clip_.proportions, phase, grounding_.speed_m_s * time_s, height,
              deviation);
}

Camera Motion::camera(double time_s) const {
  Camera camera = clip_.camera;
  camera.width_px = clip_.width_px;
  camera.height_px = clip_.height_px;
  camera.from_left = clip_.to_left;
  if (clip_.camera_follows)
    camera.x_m += grounding_.speed_m_s * time_s + clip_.sway_m * slow(sway_x_, time_s);
  const double duration_s = clip_.frames / clip_.rate_hz;
  camera.focal_px *= 1 + clip_.zoom * (time_s / duration_s - 0.5);
  camera.center_v_px += 0.15 * clip_.sway_m / camera.metres_per_pixel() * slow(sway_y_, time_s);
  return camera;
}

std::vector<Clip> clips() { return {human()}; }

Clip clip(std::string_view name) {
  std::string names;
  for (const Clip& clip : clips()) {
    if (clip.name == name) return clip;
    names += (names.empty() ? "" : ", ") + clip.name;
  }
  throw Error(fmt::format("clip '{}': is none of ours; there are {}", name, names));
}

}  // namespace stride::videos
