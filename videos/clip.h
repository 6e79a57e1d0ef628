#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "videos/jump_motion.h"
#include "videos/pinhole_camera.h"
#include "videos/skeleton.h"

namespace stride::videos {

/// The definition of a clip. The same definition gives the same frames.
struct Clip {
  std::string name, description;
  std::string character = "man";  // man, woman, veteran, game, cartoon; markers: for tests
  std::string scene = "track";    // track, street, gym, arena, meadow; dark: for tests
  std::uint64_t seed = 1;
  int width_px = 640, height_px = 360;
  double rate_hz = 30;
  int frames = 96;
  double slow_motion = 1;  // seconds of video per second of the runner

  GaitCurves gait;
  std::optional<JumpMotion> jump;  // instead of that gait
  double stands_first_s = 0;       // before the jump
  Proportions proportions;
  double first_phase = 0;
  double deviation_rad = 0;  // rms of every joint from the mean stride, slow and random
  bool to_left = false;
  bool treadmill = false;  // the runner stays in place, the belt moves

  PinholeCamera camera;  // at the start; x_m relative to the runner if it follows
  bool camera_follows = true;
  double sway_m = 0.10;  // amplitude of the camera's lag
  double zoom = 0;       // growth of the focal length over the clip
  double tilt_px = 0;    // by which the picture sinks over the clip: the camera tilts

  double shutter = 0.35;     // open part of the time between frames
  int samples = 14;          // per pixel, over the exposure and the pixel's area
  double noise_grey = 2.4;   // of the sensor, of 255
  double click_sd_px = 1.5;  // of a person's hand
  std::uint64_t click_seed = 0;
  double vignette = 0.09;  // darkening toward the corners

  /// Time of the runner, as everywhere here.
  double time_s(double frame) const { return frame / (rate_hz * slow_motion); }
  double duration_s() const { return time_s(frames); }
};

/// The motion of a clip.
class Motion {
 public:
  explicit Motion(const Clip& clip);

  const Clip& clip() const { return clip_; }
  double speed_m_s() const { return grounding_.speed_m_s; }  // of a jump the mean
  Skeleton skeleton(double time_s) const;
  double belt_m(double time_s) const;  // how far the belt of the treadmill has run
  PinholeCamera camera(double time_s) const;

 private:
  struct Wave {
    double cycles_per_s = 0, phase = 0;
  };
  double slow(const std::vector<Wave>& waves, double time_s) const;
  std::vector<Wave> waves(std::uint64_t salt) const;

  Clip clip_;
  Grounding grounding_;
  std::vector<std::vector<Wave>> joints_;
  std::vector<Wave> sway_x_, sway_y_;
};

std::vector<Clip> clips();  // of gaits
std::vector<Clip> jumps();
/// One of either. Throws Error with the list of names.
Clip clip(std::string_view name);

}  // namespace stride::videos
