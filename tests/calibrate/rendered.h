#pragma once

#include <array>
#include <string>

#include "calibrate/calibrate.h"
#include "videos/clip.h"

namespace stride {

/// How the points of a rendered clip are made without pictures.
struct Marking {
  bool every_frame = false;  // else the eight clicked frames a stride
  double noise_px = 1.5;
  unsigned seed = 1;  // of the noise
};

/// The truth of a clip with noise, and the displacement of the background as `stride track`
/// measures it.
Trajectory observed(const videos::Clip& clip, const Marking& how);

/// Another runner before another camera: lengths, roll, distance, place in the stride, and seed.
videos::Clip varied(videos::Clip clip, unsigned seed);

/// The same runner before a camera that tilts, zooms, or both, by `seed` % 3.
videos::Clip turned_camera(videos::Clip clip, unsigned seed);

/// The length of the runner's leg, with the stated error.
fit::Prior known_leg(const videos::Clip& clip, unsigned seed);

/// A fit against the truth of its clip.
struct Accuracy {
  static constexpr std::array<BodyPart, 4> kParts{BodyPart::knee_r, BodyPart::knee_l,
                                                  BodyPart::ankle_r, BodyPart::ankle_l};
  double period = 0, scale = 0, speed = 0;  // relative errors
  double roll_rad = 0;                      // error
  std::array<double, 4> rms_m{};            // of kParts, against the true angles on the model
  std::array<double, 2> toes_rms_m{}, feet_rms_rad{};  // right, left: likewise; the feet's angles
  int inside = 0, coordinates = 0;   // of knees, ankles and pelvis height, in their 95 % band
  double period_z = 0, scale_z = 0;  // errors in standard deviations

  double worst_rms_m() const;
};

Accuracy accuracy(const Calibration& found, const videos::Clip& clip, const SagittalModel& model);

}  // namespace stride
