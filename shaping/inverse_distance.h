#pragma once

#include <Eigen/Core>
#include <cmath>

#include "extract/io/names.h"

namespace stride {

/// The paper's three functions of the distance d of one part (Sec. "Potential function"), bounded
/// at d = 0 by ε, and pf4 = exp(−d²/s²) − 1, s² = ε² + the part's own variance over the stride: a
/// squared exponential (Jeon et al. 2023) with the length scale of the demonstration, shifted so
/// that it is nowhere positive. Another one is an enumerator, its name and its formula, all of them
/// here; the compiler refuses what is forgotten.
enum class InverseDistance { pf1, pf2, pf3, pf4 };

/// Their names in files and options.
inline constexpr Names<InverseDistance> kInverseDistances({{InverseDistance::pf1, "pf1"},
                                                           {InverseDistance::pf2, "pf2"},
                                                           {InverseDistance::pf3, "pf3"},
                                                           {InverseDistance::pf4, "pf4"}});

/// `d`: of the place, m, and perhaps of the velocity, in metres as well. `variance`: mean square of
/// the same distance from its mean over the stride, m².
template <int kNumbers>
double inverse_distance(InverseDistance function, const Eigen::Matrix<double, kNumbers, 1>& d,
                        double epsilon, double variance) {
  switch (function) {
    case InverseDistance::pf1:
      return 1 / (d.template lpNorm<1>() + epsilon);
    case InverseDistance::pf2:
      return 1 / std::sqrt(d.squaredNorm() + epsilon * epsilon);
    case InverseDistance::pf3:
      return 1 / (d.squaredNorm() + epsilon * epsilon);
    case InverseDistance::pf4:
      return std::expm1(-d.squaredNorm() / (epsilon * epsilon + variance));
  }
  return 0;
}

}  // namespace stride
