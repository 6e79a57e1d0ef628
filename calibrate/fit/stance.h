#pragma once

#include <vector>

#include "calibrate/fit/stride_fit.h"

namespace stride::fit {

/// When a foot of the fitted runner stands: its toe (or ankle) is low and goes back.
struct Stance {
  std::vector<double> phases;  // equally spaced, of the fit
  double speed_m_s = 0;        // of the part backwards from the pelvis; 0 if nothing stands
};

Stance find_stance(const StrideFit& fit, const Directions& directions, BodyPart part);

}  // namespace stride::fit
