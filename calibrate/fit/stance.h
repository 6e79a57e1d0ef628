#pragma once

#include <vector>

#include "calibrate/fit/solver/stride_fit.h"

namespace stride::fit {

/// Stance of the fitted runner: the toe (or ankle) is low and moves backwards.
struct Stance {
  std::vector<double> phases;  // equally spaced, of the fit
  double speed_m_s = 0;        // of the part backwards relative to the pelvis; 0 without stance
};

Stance find_stance(const StrideFit& fit, const Directions& directions, BodyPart part);

}  // namespace stride::fit
