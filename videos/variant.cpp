#include "videos/variant.h"

#include <cmath>

namespace stride::videos {

Clip resized(Clip clip, double factor) {
  clip.width_px = static_cast<int>(std::lround(clip.width_px * factor));
  clip.height_px = static_cast<int>(std::lround(clip.height_px * factor));
  clip.camera.focal_px *= factor;
  // Pixel 0 is the middle of the first one.
  clip.camera.center_u_px = (clip.camera.center_u_px + 0.5) * factor - 0.5;
  clip.camera.center_v_px = (clip.camera.center_v_px + 0.5) * factor - 0.5;
  return clip;
}

Clip at_rate(Clip clip, double rate_hz) {
  clip.frames = static_cast<int>(std::lround(clip.frames * rate_hz / clip.rate_hz));
  clip.rate_hz = rate_hz;
  return clip;
}

Clip in_slow_motion(Clip clip, double factor) {
  clip.frames = static_cast<int>(std::lround(clip.frames * factor));
  clip.slow_motion *= factor;
  return clip;
}

Clip from_other_side(Clip clip) {
  clip.to_left = !clip.to_left;
  return clip;
}

Clip from_one_place(Clip clip) {
  const double run_m = Motion(clip).speed_m_s() * clip.duration_s();
  constexpr double kMargin_m = 1.6;  // an arm and a leg at both ends
  clip.camera_follows = false;
  clip.zoom = 0;
  clip.camera.x_m += run_m / 2;
  clip.camera.focal_px = clip.camera.distance_m * clip.width_px / (run_m + kMargin_m);
  return clip;
}

}  // namespace stride::videos
