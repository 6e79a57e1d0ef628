#include "calibrate/fitted.h"

#include <cmath>

namespace stride {
namespace {

constexpr int kPhases = 24;

/// Standard deviation of a part about the pelvis, over both coordinates, at equal steps of phase
/// from that of the middle of the clip.
std::array<double, kPhases> sd_px(const StrideFit& fit, const Directions& directions,
                                  BodyPart part) {
  const double period_s = fit.runner.cadence[cadence::period_s];
  const Eigen::VectorXd sd = propagated_sd(fit, [&](const StrideFit& moved) {
    Eigen::VectorXd places(2 * kPhases);
    for (int i = 0; i < kPhases; ++i)
      places.segment<2>(2 * i) = about_pelvis_px(moved, directions, part, period_s * i / kPhases);
    return places;
  });
  std::array<double, kPhases> result;
  for (int i = 0; i < kPhases; ++i) result[i] = std::sqrt(sd.segment<2>(2 * i).squaredNorm() / 2);
  return result;
}

double leg_px(const Runner& r) {
  return (r.body[body::thigh] + r.body[body::shank]) * std::exp(r.camera[camera::log_px_per_m]);
}

}  // namespace

Trajectory fitted_px(const Trajectory& trajectory, const SagittalModel& model,
                     const Calibration& result) {
  const StrideFit& fit = result.fit;
  const Marks& marks = result.observations;
  const Directions directions(model);
  Trajectory fitted = trajectory;
  for (const BodyPart part : kBodyParts) {
    const bool seen = marks.count[index(part)] > 0;
    const std::array<double, kPhases> sd = sd_px(fit, directions, part);
    for (std::size_t i = 0; i < fitted.frames.size(); ++i) {
      Point& point = fitted.frames[i][part];
      point = {};
      if (!seen) continue;
      const double u_s = marks.u_s[i], phase = phase_at(fit.runner.cadence.data(), u_s);
      point.p_px = image_px(trajectory, marks.to_left,
                            predicted_px(fit, directions, part, static_cast<int>(i), u_s));
      const auto nearest = std::lround(kPhases * (phase - std::floor(phase))) % kPhases;
      const double relative = 30 * sd[static_cast<std::size_t>(nearest)] / leg_px(fit.runner);
      point.confidence = 0.3 / (1 + relative * relative);
    }
  }
  return fitted;
}

}  // namespace stride
