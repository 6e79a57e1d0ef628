#pragma once

#include "calibrate/aperiodic/retarget.h"
#include "calibrate/gait/verdict.h"

namespace stride::aperiodic {

/// Checks of the fit of a jump; adds to `verdict`.
void judge_passage(const Trajectory& trajectory, const fit::Marks& observations,
                   const PassageFit& fit, const GroundPath& path, const Flight& flight,
                   const Scale& scale, gait::ClipVerdict& verdict);

}  // namespace stride::aperiodic
