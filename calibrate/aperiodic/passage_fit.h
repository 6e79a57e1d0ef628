#pragma once

#include "calibrate/aperiodic/passage.h"
#include "extract/skeleton/movement.h"

namespace stride::aperiodic {

/// Fits limbs and angles to the marks of a movement that does not repeat: one Ceres problem for
/// each spacing of control points, of which Akaike's criterion chooses. The scale is left to the
/// flight. Never throws because of a clip's content.
PassageFit fit_passage(const fit::Marks& observations, const SagittalModel& model, Legs legs,
                       double mark_sd = fit::FitOptions().mark_sd);

}  // namespace stride::aperiodic
