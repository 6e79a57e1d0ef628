#pragma once

#include <Eigen/Core>
#include <cmath>

#include "extract/io/names.h"

namespace stride {

/// The paper's three functions of the distance d of one part (Sec. "Potential function"), bounded
/// at d = 0 by ε. Another one is an enumerator, its name and its formula, all of them here; the
/// compiler refuses what is forgotten.
enum class InverseDistance { pf1, pf2, pf3 };

/// Their names in files and options.
inline constexpr Names<InverseDistance> kInverseDistances({{InverseDistance::pf1, "pf1"},
                                                           {InverseDistance::pf2, "pf2"},
                                                           {InverseDistance::pf3, "pf3"}});

inline double inverse_distance(InverseDistance function, const Eigen::Vector2d& d, double epsilon) {
  switch (function) {
    case InverseDistance::pf1:
      return 1 / (std::abs(d.x()) + std::abs(d.y()) + epsilon);
    case InverseDistance::pf2:
      return 1 / std::sqrt(d.squaredNorm() + epsilon * epsilon);
    case InverseDistance::pf3:
      return 1 / (d.squaredNorm() + epsilon * epsilon);
  }
  return 0;
}

}  // namespace stride
