#include "calibrate/fit/stride_fit.h"

#include <cmath>

namespace stride::fit {

Eigen::Vector2d about_pelvis_px(const StrideFit& fit, const Directions& directions, BodyPart part,
                                double u_s) {
  const Runner& r = fit.runner;
  const double phase = phase_at(r.cadence.data(), u_s);
  const auto leg = leg_angles(r.hip.data(), r.knee.data(), r.ankle.data(), r.asymmetry.data(),
                              fit.harmonics, side_of(part) < 0 ? -1 : 1, phase);
  const Eigen::Vector2d q = place_part(part, directions, r.body.data(), r.sides.data(),
                                       evaluate_series(r.tilt.data(), 2, phase), leg, phase);
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
  std::vector<double> all;
  const auto append = [&](const auto& block) { all.insert(all.end(), block.begin(), block.end()); };
  append(r.camera), append(r.cadence), append(r.body), append(r.sides), append(r.tilt);
  append(r.hip), append(r.knee), append(r.ankle), append(r.asymmetry);
  return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

Runner unflattened(const Eigen::VectorXd& values) {
  Runner r;
  const double* from = values.data();
  const auto take = [&](auto& block) {
    std::copy_n(from, block.size(), block.begin());
    from += block.size();
  };
  take(r.camera), take(r.cadence), take(r.body), take(r.sides), take(r.tilt);
  take(r.hip), take(r.knee), take(r.ankle), take(r.asymmetry);
  return r;
}

double StrideFit::period_sd_s() const {
  constexpr int i = 3 + cadence::period_s;
  return std::sqrt(covariance(i, i));
}

double StrideFit::scale_relative_sd() const {
  return std::sqrt(covariance(camera::log_px_per_m, camera::log_px_per_m));
}

double StrideFit::roll_sd_rad() const { return std::sqrt(covariance(camera::roll, camera::roll)); }

}  // namespace stride::fit
