#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "extract/io/names.h"
#include "shaping/inverse_distance.h"
#include "shaping/pose.h"

namespace stride {

/// The keyframe that a pose is compared with: the one at the current phase, Φ(s, phase), or the
/// nearest one, Φ(s) = max over them.
enum class PotentialIndex { time, nearest };
inline constexpr Names<PotentialIndex> kPotentialIndices({{PotentialIndex::time, "time"},
                                                          {PotentialIndex::nearest, "nearest"}});

struct Keyframe {
  double phase = 0;  // [0, 1), of a movement that does not repeat [0, 1]
  Pose pose;
  Pose sd;  // one standard deviation of each coordinate; NaN where it is not known
};

/// NAME.potential.json, format "stride-potential" version 1.
struct Potential {
  std::string source, source_sha256, model;
  std::string movement = "run";  // a name of movements.toml
  bool repeats = true;           // that movement; false: before 0 and after 1 it stands still
  double mirrored_after = 0.5;   // of it: the mirrored pose belongs to so much later a phase
  std::string foot = "ankle";    // "ankle" or "toe": which part is the foot of the paper
  double period_s = 0, period_sd_s = 0;  // of the stride, or of all that does not repeat
  double speed_m_s = 0;                  // of the video's runner; NaN: not known
  double rms_px = 0, rms_m = 0;          // quality of the fit behind it; NaN: not known
  std::string verdict = "ok";
  std::vector<Keyframe> keyframes;  // n of phase k/n, of what does not repeat k/(n − 1)

  InverseDistance function = InverseDistance::pf3;
  PotentialIndex index = PotentialIndex::time;
  double epsilon_m = 0.05;
  double velocity_s = 0;  // > 0: velocities are compared as well, 1 m/s as so many metres
  double angle_m = 0;     // > 0: the angles of the legs as well, 1 rad as so many metres
  double weight = 1;

  /// Φ(s, phase), ≥ 0 or of pf4 ≤ 0: weight · the sum over pelvis height, two knees, two feet.
  /// Between keyframes the target moves on a cubic spline, periodic or at rest at both ends.
  /// `phase` (any real number, modulo 1 or held at the ends) is ignored by the index `nearest`.
  /// Where velocities are compared, the motion is needed; a pose alone is refused.
  double operator()(const Pose& pose, double phase) const;
  double operator()(const MovingPose& motion, double phase) const;

  /// Phase after `time_s` from phase 0, at the video's cadence; of what does not repeat at most 1.
  double phase_at(double time_s) const;

  /// By how much the demonstrated motion in its own time is higher than the same motion at any
  /// other, in the mean: what there is to gain, whatever function, index, ε and clip are.
  double contrast() const;

  /// The pose of the runner in the video at that phase.
  Pose target(double phase) const;

  /// Its velocity, m/s.
  Pose target_velocity(double phase) const;
};

/// Sets movement, repeats and mirrored_after. Throws Error, beginning with `what`.
void set_movement(Potential& potential, std::string_view movement, std::string_view what);

/// The function or index of that name. Throws Error with the list of names.
InverseDistance inverse_distance(std::string_view name);
PotentialIndex potential_index(std::string_view name);

/// Throws Error naming `origin` (a file), key, value and rule if a value is invalid.
void check(const Potential& potential, const std::string& origin);

/// Throws Error naming `origin` and the value for what no person does: a clip that was refused, a
/// period, speed or height out of people's range, knees and feet where no leg reaches.
void require_human(const Potential& potential, const std::string& origin);

/// NAME.potential.json (shaping/README.md has its keys). Errors name file, key, value and rule;
/// other versions and NaN are refused.
Potential load_potential(const std::filesystem::path& file);
void save(const Potential& potential, const std::filesystem::path& file);

/// What save() writes.
std::string to_json_text(const Potential& potential);

}  // namespace stride
