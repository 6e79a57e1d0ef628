#include "calibrate/fit/solver/stride_fit.h"

#include <algorithm>
#include <cmath>

namespace stride::fit {
namespace {

/// Index in `flattened` of an entry of a block.
template <auto kBlock>
constexpr int index_of(int entry) {
  const Runner runner;
  int offset = 0, found = -1;
  for_each_block(runner, [&](const auto& block) {
    if (static_cast<const void*>(&block) == static_cast<const void*>(&(runner.*kBlock)))
      found = offset;
    offset += static_cast<int>(block.size());
  });
  return found + entry;
}

}  // namespace

Eigen::Vector2d about_pelvis_px(const StrideFit& fit, const Directions& directions, BodyPart part,
                                double u_s) {
  const Runner& r = fit.runner;
  const double phase = phase_at(r.cadence.data(), u_s);
  const auto leg = leg_angles(r.hip.data(), r.knee.data(), r.ankle.data(), r.asymmetry.data(),
                              fit.harmonics, side_of(part) < 0 ? -1 : 1, phase);
  const double tilt = evaluate_series(r.tilt.data(), kTiltHarmonics, phase);
  const Eigen::Vector2d q =
      is_heel(part) ? place_part(part, directions, r.body.data(), r.sides.data(), tilt, leg, phase,
                                 fit.heel.data())
                    : place_part(part, directions, r.body.data(), r.sides.data(), tilt, leg, phase);
  const double scale =
      std::exp(r.camera[camera::log_px_per_m] + r.camera[camera::drift_per_s] * u_s);
  return scale * turned(r.camera[camera::roll], q);
}

Eigen::Vector2d predicted_px(const StrideFit& fit, const Directions& directions, BodyPart part,
                             int frame, double u_s) {
  return fit.pelvis_px[frame] + about_pelvis_px(fit, directions, part, u_s);
}

Eigen::VectorXd propagated_sd(const StrideFit& fit,
                              const std::function<Eigen::VectorXd(const StrideFit&)>& values) {
  const Eigen::VectorXd at = flattened(fit.runner);
  StrideFit moved;
  moved.harmonics = fit.harmonics;
  moved.vertical_oscillation = fit.vertical_oscillation;
  moved.heel = fit.heel;
  Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(values(fit).size(), at.size());
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    const double sd = std::sqrt(fit.covariance(k, k));
    if (!(sd > 0)) continue;
    const double h = 1e-3 * std::min(sd, 1.0);  // central differences within a thousandth of sd
    const auto value = [&](double displacement) {
      Eigen::VectorXd there = at;
      there[k] += displacement * h;
      moved.runner = unflattened(there);
      return values(moved);
    };
    jacobian.col(k) = (value(1) - value(-1)) / (2 * h);
  }
  return (jacobian * fit.covariance * jacobian.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
}

Eigen::VectorXd flattened(const Runner& r) {
  Eigen::VectorXd all(static_cast<Eigen::Index>(kRunnerParameters));
  double* to = all.data();
  for_each_block(r, [&](const auto& block) { to = std::ranges::copy(block, to).out; });
  return all;
}

Runner unflattened(const Eigen::VectorXd& values) {
  Runner r;
  const double* from = values.data();
  for_each_block(r, [&](auto& block) {
    std::copy_n(from, block.size(), block.begin());
    from += block.size();
  });
  return r;
}

double StrideFit::period_sd_s() const {
  constexpr int i = index_of<&Runner::cadence>(cadence::period_s);
  return std::sqrt(covariance(i, i));
}

double StrideFit::scale_relative_sd() const {
  constexpr int i = index_of<&Runner::camera>(camera::log_px_per_m);
  return std::sqrt(covariance(i, i));
}

double StrideFit::roll_sd_rad() const {
  constexpr int i = index_of<&Runner::camera>(camera::roll);
  return std::sqrt(covariance(i, i));
}

}  // namespace stride::fit
