#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/fit/fit.h"
#include "calibrate/gait/gait.h"
#include "extract/skeleton/trajectory.h"

namespace stride::gait {

/// Whether a clip can be explained as one runner in side view, and what is unusual about it.
struct ClipVerdict {
  bool refused = false;
  std::vector<std::string> reasons;  // each with what to do about it
  int alarms = 0;                    // reasons that are unlike a runner

  void refuse(std::string reason);
  void note(std::string reason) { reasons.push_back(std::move(reason)); }
  void alarm(std::string reason) {
    note(std::move(reason));
    ++alarms;
  }
  /// "ok", "ok, but …; …", or "refused: …".
  std::string text() const;
};

/// Checks before the fit: missing parts, a clip upside down, somebody who stands or runs towards
/// the camera.
ClipVerdict judge_marks(const Trajectory& trajectory);

/// Checks of any fit: the robust sd of its marks in legs, and whether its knees bend the wrong way.
/// Adds to `verdict`.
void judge_misses(double relative, bool backward, ClipVerdict& verdict);

/// Compares a calibration line with the runner: the leg that it makes, from `leg_px` at its moment,
/// against `leg_m` with its relative sd, which is what `whose` ("usual", "given") says. Adds to
/// `verdict`.
void judge_line(const CalibrationLine& line, double leg_px, const fit::Prior& leg_m,
                std::string_view whose, ClipVerdict& verdict);

/// Checks of the fit; adds to `verdict`.
void judge_fit(const Trajectory& trajectory, const fit::Marks& observations,
               const fit::StrideFit& fit, const Gait& gait, ClipVerdict& verdict);

}  // namespace stride::gait
