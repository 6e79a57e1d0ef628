#include "videos/clip.h"

#include <cmath>
#include <numbers>

#include "extract/io/error.h"
#include "extract/io/random.h"

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

/// A camera that shows so many pixels a metre of the runner's plane from that far.
PinholeCamera camera(double pixels_per_metre, double distance_m) {
  PinholeCamera camera;
  camera.distance_m = distance_m;
  camera.focal_px = pixels_per_metre * distance_m;
  return camera;
}

Clip walk_clip() {
  Clip clip;
  clip.name = "walk";
  clip.description = "a man walks past a wall, the camera follows";
  clip.character = "veteran";
  clip.scene = "street";
  clip.seed = 21;
  clip.frames = 152;
  clip.proportions.thigh = 0.415;
  clip.proportions.shank = 0.420;
  clip.gait = standing(walk(), clip.proportions, 0);
  clip.first_phase = 0.2;
  clip.deviation_rad = 0.3 * std::numbers::pi / 180;
  clip.camera = camera(130, 9);
  clip.camera.roll_rad = -0.012;
  return clip;
}

Clip left_clip() {
  Clip clip;
  clip.name = "left";
  clip.description = "a woman runs to the left, the camera follows late";
  clip.character = "woman";
  clip.scene = "street";
  clip.seed = 31;
  clip.proportions.thigh = 0.398;
  clip.proportions.shank = 0.392;
  clip.proportions.trunk = 0.53;
  clip.proportions.toe_forward = 0.185;
  clip.proportions.hip_half_width = 0.09;
  clip.proportions.shoulder_half_width = 0.165;
  clip.proportions.upper_arm = 0.28;
  clip.proportions.forearm = 0.235;
  clip.gait = rajagopal_run();
  clip.first_phase = 0.1;
  clip.deviation_rad = 0.4 * std::numbers::pi / 180;
  clip.to_left = true;
  clip.camera = camera(126, 11);
  clip.camera.roll_rad = 0.015;
  clip.sway_m = 0.22;
  clip.zoom = -0.015;
  return clip;
}

Clip treadmill_clip() {
  Clip clip;
  clip.name = "treadmill";
  clip.description = "a man runs on a treadmill, the camera stands";
  clip.scene = "gym";
  clip.seed = 41;
  clip.rate_hz = 60;
  clip.frames = 180;
  clip.gait = hamner_run();
  clip.first_phase = 0.4;
  clip.deviation_rad = 0.4 * std::numbers::pi / 180;
  clip.treadmill = true;
  clip.camera_follows = false;
  clip.camera = camera(140, 8);
  clip.camera.center_v_px = 175;
  clip.camera.height_m = 1.05;
  return clip;
}

Clip small_clip() {
  Clip clip;
  clip.name = "small";
  clip.description = "a woman jogs on a track, few pixels and 24 frames a second";
  clip.character = "woman";
  clip.seed = 51;
  clip.width_px = 320;
  clip.height_px = 180;
  clip.rate_hz = 24;
  clip.frames = 96;
  clip.proportions.thigh = 0.41;
  clip.proportions.shank = 0.40;
  clip.gait = standing(jog(), clip.proportions, 0.03);
  clip.deviation_rad = 0.4 * std::numbers::pi / 180;
  clip.camera = camera(64, 14);
  clip.camera.center_u_px = 160;
  clip.camera.center_v_px = 82;
  clip.camera.roll_rad = -0.02;
  clip.shutter = 0.5;
  clip.click_sd_px = 0.75;
  return clip;
}

Clip game_clip() {
  Clip clip;
  clip.name = "game";
  clip.description = "an armoured hero of a game runs under a planet";
  clip.character = "game";
  clip.scene = "arena";
  clip.seed = 61;
  clip.proportions.thigh = 0.46;
  clip.proportions.shank = 0.43;
  clip.proportions.trunk = 0.60;
  clip.proportions.neck = 0.155;
  clip.proportions.toe_forward = 0.215;
  clip.proportions.sole_down = 0.10;
  clip.proportions.shoulder_half_width = 0.24;
  clip.gait = standing(game_run(), clip.proportions, 0.09);
  clip.camera = camera(122, 12);
  clip.camera.center_v_px = 160;
  clip.shutter = 0.12;
  clip.noise_grey = 0;
  clip.sway_m = 0.05;
  return clip;
}

Clip cartoon_clip() {
  Clip clip;
  clip.name = "cartoon";
  clip.description = "a drawn boy with a big head runs through a meadow";
  clip.character = "cartoon";
  clip.scene = "meadow";
  clip.seed = 71;
  clip.rate_hz = 24;
  clip.frames = 72;
  clip.proportions.thigh = 0.27;
  clip.proportions.shank = 0.25;
  clip.proportions.trunk = 0.42;
  clip.proportions.neck = 0.25;
  clip.proportions.toe_forward = 0.20;
  clip.proportions.sole_down = 0.085;
  clip.proportions.upper_arm = 0.21;
  clip.proportions.forearm = 0.19;
  clip.proportions.shoulder_half_width = 0.12;
  clip.gait = standing(cartoon_run(), clip.proportions, 0.10);
  clip.camera = camera(165, 14);
  clip.camera.center_v_px = 140;
  clip.shutter = 0;
  clip.noise_grey = 0;
  clip.vignette = 0;
  clip.sway_m = 0.04;
  return clip;
}

/// A jump after standing, and standing after it.
Clip jump_clip() {
  Clip clip;
  clip.name = "jump";
  clip.description = "a man jumps from standing, the camera stands";
  clip.seed = 81;
  clip.frames = 69;
  clip.proportions.thigh = 0.4215;
  clip.proportions.shank = 0.4099;
  clip.jump = JumpMotion(clip.proportions);
  clip.stands_first_s = 0.2;
  clip.camera = camera(140, 9);
  clip.camera.x_m = 0.55;
  clip.camera.center_v_px = 160;
  clip.camera.roll_rad = 0.01;
  clip.camera_follows = false;
  return clip;
}

Clip jump_left_clip() {
  Clip clip = jump_clip();
  clip.name = "jump_left";
  clip.description = "a woman jumps to the left, the camera follows late";
  clip.character = "woman";
  clip.scene = "street";
  clip.seed = 91;
  clip.to_left = true;
  clip.proportions.trunk = 0.53;
  clip.proportions.hip_half_width = 0.09;
  clip.proportions.shoulder_half_width = 0.165;
  clip.jump = JumpMotion(clip.proportions);
  clip.camera = camera(128, 11);
  clip.camera.center_v_px = 165;
  clip.camera.roll_rad = -0.014;
  clip.camera_follows = true;
  return clip;
}

Grounding grounding_of(const Clip& clip) {
  if (!clip.jump) return ground(clip.gait, clip.proportions);
  return {.mean_height_m = 0, .speed_m_s = clip.jump->length_m() / clip.duration_s()};
}

}  // namespace

Motion::Motion(const Clip& clip) : clip_(clip), grounding_(grounding_of(clip)) {
  for (std::uint64_t joint = 0; joint < 6; ++joint) joints_.push_back(waves(joint));
  sway_x_ = waves(100);
  sway_y_ = waves(101);
}

std::vector<Motion::Wave> Motion::waves(std::uint64_t salt) const {
  Random engine(clip_.seed * 1000 + salt);
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
  if (clip_.jump) return clip_.jump->skeleton(time_s - clip_.stands_first_s);
  const double phase = clip_.first_phase + time_s / clip_.gait.period_s;
  Deviation deviation;
  for (int side : {0, 1}) {
    deviation.hip[side] = clip_.deviation_rad * slow(joints_[3 * side], time_s);
    deviation.knee[side] = clip_.deviation_rad * slow(joints_[3 * side + 1], time_s);
    deviation.ankle[side] = clip_.deviation_rad * slow(joints_[3 * side + 2], time_s);
  }
  const double height = grounding_.mean_height_m + clip_.gait.pelvis_height_m(phase) -
                        clip_.gait.pelvis_height_m.mean;
  // On a belt nobody keeps the place to the centimetre.
  const double x = clip_.treadmill ? 0.05 * slow(sway_x_, time_s) : grounding_.speed_m_s * time_s;
  return pose(clip_.gait, clip_.proportions, phase, x, height, deviation);
}

double Motion::belt_m(double time_s) const {
  return clip_.treadmill ? grounding_.speed_m_s * time_s : 0;
}

PinholeCamera Motion::camera(double time_s) const {
  PinholeCamera camera = clip_.camera;
  camera.width_px = clip_.width_px;
  camera.height_px = clip_.height_px;
  camera.from_left = clip_.to_left;
  if (clip_.camera_follows)
    camera.x_m += grounding_.speed_m_s * time_s + clip_.sway_m * slow(sway_x_, time_s);
  camera.focal_px *= 1 + clip_.zoom * (time_s / clip_.duration_s() - 0.5);
  camera.center_v_px += clip_.tilt_px * (time_s / clip_.duration_s() - 0.5);
  if (clip_.camera_follows)
    camera.center_v_px += 0.15 * clip_.sway_m / camera.metres_per_pixel() * slow(sway_y_, time_s);
  return camera;
}

std::vector<Clip> clips() {
  return {human(),          game_clip(), cartoon_clip(), walk_clip(),
          treadmill_clip(), left_clip(), small_clip()};
}

std::vector<Clip> jumps() { return {jump_clip(), jump_left_clip()}; }

Clip clip(std::string_view name) {
  std::string names;
  std::vector<Clip> all = clips();
  for (const Clip& jump : jumps()) all.push_back(jump);
  for (const Clip& clip : all) {
    if (clip.name == name) return clip;
    names += (names.empty() ? "" : ", ") + clip.name;
  }
  throw Error(fmt::format("clip '{}': is none of ours; there are {}", name, names));
}

}  // namespace stride::videos
