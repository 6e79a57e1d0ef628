#include "train/simulation/planar_integrator.h"

#include "train/simulation/integrator.h"

namespace stride {

AdvanceReport PlanarIntegrator::advance(PlanarDynamics& dynamics, PlanarDynamics::State& y,
                                        PlanarDynamics::Fibers& activation,
                                        const PlanarDynamics::Fibers& excitation,
                                        double duration_s) {
  MersonIntegrator<64> merson;
  std::array<double, 64> all{};
  const auto unpack = [](const std::array<double, 64>& from, PlanarDynamics::State& to,
                         PlanarDynamics::Fibers& a) {
    for (int i = 0; i < 11; ++i)
      for (int j = 0; j < 4; ++j) to.y[i][j] = from[4 * i + j];
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 4; ++j) a[i][j] = from[44 + 4 * i + j];
  };
  const auto pack = [](const PlanarDynamics::State& from, const PlanarDynamics::Fibers& a,
                       std::array<double, 64>& to) {
    for (int i = 0; i < 11; ++i)
      for (int j = 0; j < 4; ++j) to[4 * i + j] = from.y[i][j];
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 4; ++j) to[44 + 4 * i + j] = a[i][j];
  };
  pack(y, activation, all);
  const auto report = merson.advance(
      all, duration_s, options_,
      [&](const std::array<double, 64>& at, std::array<double, 64>& rate) {
        PlanarDynamics::State s, r;
        PlanarDynamics::Fibers a;
        unpack(at, s, a);
        dynamics.set_modes(dynamics.modes_at(s));
        dynamics.evaluate(s, a, r);
        pack(r, dynamics.activation_rate(a, excitation), rate);
      },
      [](const std::array<double, 64>& e) {
        double worst = 0;
        for (int i = 0; i < 64; ++i)
          worst = std::max(worst, std::abs(e[i]) * (i < 24 || i >= 44 ? 1 : 10));
        return worst;
      });
  unpack(all, y, activation);
  return report;
}

}  // namespace stride
