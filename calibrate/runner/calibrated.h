#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "extract/skeleton/body_part.h"

namespace stride {

/// The nine coordinates of the runner, in the order of the model: rad, pelvis_tx and pelvis_ty in
/// m.
inline constexpr std::array<const char*, 9> kCoordinateNames{
    "pelvis_tilt",   "pelvis_tx",     "pelvis_ty",    "hip_flexion_r", "knee_angle_r",
    "ankle_angle_r", "hip_flexion_l", "knee_angle_l", "ankle_angle_l"};

/// The model in one frame. Axes of the ground: x in the running direction, whichever way the video
/// shows, y up.
struct CalibratedSample {
  double time_s = 0;
  /// Of the stride, [0, 1), 0 = right foot strike if known; of a movement that does not repeat from
  /// its beginning, 0, to its end, 1.
  double phase = 0;
  std::array<double, 9> coordinates{};  // kCoordinateNames; pelvis_ty above the ground
  double pelvis_height_sd_m = std::numeric_limits<double>::quiet_NaN();
  /// p_PK of every part of the model: from the model's pelvis origin P (7.1 cm in front of and 6.6
  /// cm above the hips), in axes of the ground, not of the tilting pelvis, m. Knee: origin of
  /// tibia; ankle: of talus; toe: of toes; heel: of calcn, NaN where no heel was seen; hip: of
  /// femur; head: of head. `pelvis` is (0, 0).
  std::array<Eigen::Vector2d, kBodyPartCount> p_m = unknown_points();
  /// One standard deviation of p_m; NaN if unknown.
  std::array<Eigen::Vector2d, kBodyPartCount> sd_m = unknown_points();

  const Eigen::Vector2d& operator[](BodyPart part) const { return p_m[index(part)]; }

  static std::array<Eigen::Vector2d, kBodyPartCount> unknown_points();
};

/// Where no heels were seen a sample has none.
void forget_heels(CalibratedSample& sample);

/// A run on the proportions of the model, from a trajectory (`calibrate/`) or an agent's episode
/// (`train/`).
struct CalibratedTrajectory {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  std::string source, source_sha256;  // the video, or the run folder of an agent
  std::string movement = "run";       // a name of movements.toml
  std::string model;                  // name of the model whose proportions these are
  /// Of the stride, or of a movement that does not repeat from its beginning to its end.
  double period_s = kUnknown, period_sd_s = kUnknown;
  double take_off_s = kUnknown, landing_s = kUnknown;  // of a jump, in the time of the samples
  double speed_m_s = kUnknown;
  double metres_per_pixel = kUnknown, camera_roll_rad = kUnknown;
  double rms_px = kUnknown, rms_m = kUnknown;  // measured points against the fit
  std::string verdict = "ok";                  // "ok", or what is wrong with the clip
  std::vector<CalibratedSample> samples;       // equally spaced in time, at least one stride
};

/// NAME.calibrated.csv: `# stride calibrated 1`, unit m; columns time_s, phase, the coordinates by
/// name, pelvis_ty_sd, and <part>_x, <part>_y, <part>_x_sd, <part>_y_sd (the deviations may be
/// absent; so may the heels). Errors name the file, and the cure if the file is a trajectory in
/// pixels.
CalibratedTrajectory load_calibrated(const std::filesystem::path& file);
void save(const CalibratedTrajectory& trajectory, const std::filesystem::path& file);

}  // namespace stride
