#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/fit.h"
#include "calibrate/gait/gait.h"
#include "extract/skeleton/trajectory.h"

namespace stride::gait {

/// Whether a clip can be explained as one runner in side view, and what is unusual about it.
struct Verdict {
  bool refused = false;
  std::vector<std::string> reasons;  // each with its cure

  void refuse(std::string reason);
  void note(std::string reason) { reasons.push_back(std::move(reason)); }
  /// "ok", "ok, but …; …", or "refused: …".
  std::string text() const;
};

/// Checks before the fit: missing parts, a clip upside down, somebody who stands or runs towards
/// the camera.
Verdict judge_marks(const Trajectory& trajectory);

/// Checks of the fit; adds to `verdict`.
void judge_fit(const Trajectory& trajectory, const fit::Marks& observations,
               const fit::StrideFit& fit, const Gait& gait, Verdict& verdict);

}  // namespace stride::gait
