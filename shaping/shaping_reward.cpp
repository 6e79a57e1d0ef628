#include "shaping/shaping_reward.h"

#include <cmath>

namespace stride {

double shaping_reward(double phi, double phi_next, double gamma, bool terminated) {
  // fma: one rounding, however a compiler arranges the lines around the call.
  return std::fma(gamma, terminated ? 0 : phi_next, -phi);
}

}  // namespace stride
