#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stride {

/// The quantities that the potential compares: positions of knees and feet relative to the pelvis
/// origin, and the height of the pelvis. x forward, y up, axes of the ground, metres. A foot is the
/// ankle (origin of talus) unless the file says "toe".
struct Pose {
  double pelvis_height_m = 0;
  Eigen::Vector2d knee_r = Eigen::Vector2d::Zero(), foot_r = Eigen::Vector2d::Zero();
  Eigen::Vector2d knee_l = Eigen::Vector2d::Zero(), foot_l = Eigen::Vector2d::Zero();

  Pose mirrored() const;  // right ↔ left
};

/// The paper's three functions of the distance of one part (Sec. "Potential function"), bounded at
/// d = 0 by ε: pf1 1/(|dx| + |dy| + ε), pf2 1/√(dx² + dy² + ε²), pf3 1/(dx² + dy² + ε²).
enum class InverseDistance { pf1, pf2, pf3 };

/// The keyframe that a pose is compared with: the one at the current phase, Φ(s, phase), or the
/// nearest one, Φ(s) = max over them.
enum class PotentialIndex { time, nearest };

struct Keyframe {
  double phase = 0;  // [0, 1)
  Pose pose;
  Pose sd;  // one standard deviation of each coordinate; NaN where it is not known
};

/// NAME.potential.json, format "stride-potential" version 1.
struct Potential {
  std::string source, source_sha256, model;
  std::string foot = "ankle";            // "ankle" or "toe": which part is the foot of the paper
  double period_s = 0, period_sd_s = 0;  // of the stride
  double speed_m_s = 0;                  // of the video's runner; NaN: not known
  double rms_px = 0, rms_m = 0;          // quality of the fit behind it; NaN: not known
  std::string verdict = "ok";
  std::vector<Keyframe> keyframes;  // phase k/n; eight a stride at the paper's rate

  InverseDistance function = InverseDistance::pf3;
  PotentialIndex index = PotentialIndex::time;
  double epsilon_m = 0.05;
  double weight = 1;

  /// Φ(s, phase) ≥ 0: weight · the sum over pelvis height, two knees, two feet. Between keyframes
  /// the target moves on a periodic cubic spline. `phase` (any real number, modulo 1) is ignored by
  /// the index `nearest`.
  double operator()(const Pose& pose, double phase) const;

  /// Phase after `time_s` from phase 0, at the video's cadence.
  double phase_at(double time_s) const;

  /// The pose of the runner in the video at that phase.
  Pose target(double phase) const;
};

/// F(s, s′) = γ Φ(s′) − Φ(s) (Ng, Harada, Russell 1999), with Φ(s′) = 0 at a true end of the
/// episode (Grześ 2017); a time limit is not an end. γ is the agent's own, per decision.
double shaping_reward(double phi, double phi_next, double gamma, bool terminated);

std::string_view name(InverseDistance function);  // "pf1" …
InverseDistance inverse_distance(std::string_view name);
std::string_view name(PotentialIndex index);  // "time", "nearest"
PotentialIndex potential_index(std::string_view name);

/// Throws Error naming `origin` (a file), key, value and rule if a value is invalid.
void check(const Potential& potential, const std::string& origin);

/// NAME.potential.json (shaping/README.md has its keys). Errors name file, key, value and rule;
/// other versions and NaN are refused.
Potential load_potential(const std::filesystem::path& file);
void save(const Potential& potential, const std::filesystem::path& file);

}  // namespace stride
