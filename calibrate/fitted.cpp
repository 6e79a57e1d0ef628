#include "calibrate/fitted.h"

#include <cmath>

namespace stride {
namespace {

constexpr int kPhases = 24;

/// Standard deviation of a part relative to the pelvis, over both coordinates, at equal steps of
/// phase from the middle of the clip.
std::array<double, kPhases> sd_px(const fit::StrideFit& fit, const Directions& directions,
                                  BodyPart part) {
  const double period_s = fit.runner.cadence[cadence::period_s];
  const Eigen::VectorXd sd = fit::propagated_sd(fit, [&](const fit::StrideFit& moved) {
    Eigen::VectorXd places(2 * kPhases);
    for (int i = 0; i < kPhases; ++i)
      places.segment<2>(2 * i) =
          fit::about_pelvis_px(moved, directions, part, period_s * i / kPhases);
    return places;
  });
  std::array<double, kPhases> result;
  for (int i = 0; i < kPhases; ++i) result[i] = std::sqrt(sd.segment<2>(2 * i).squaredNorm() / 2);
  return result;
}

}  // namespace

Trajectory fitted_points(const Trajectory& trajectory, const SagittalModel& model,
                         const Calibration& c) {
  const Directions directions(model);
  Trajectory fitted = trajectory;
  if (c.aperiodic) {
    for (std::size_t i = 0; i < fitted.frames.size(); ++i)
      for (const BodyPart part : kBodyParts)
        fitted.frames[i][part] = {
            fit::image_px(trajectory, c.observations.to_left,
                          aperiodic::predicted_px(c.aperiodic->fit.passage, directions, part,
                                                  static_cast<int>(i), c.observations.u_s[i])),
            Source::predicted, 1};
    return fitted;
  }
  for (std::size_t i = 0; i < fitted.frames.size(); ++i)
    for (const BodyPart part : kBodyParts) {
      const bool toe = part == BodyPart::toe_r || part == BodyPart::toe_l;
      const bool known = toe ? c.fit.toes_seen : part != BodyPart::head || c.fit.head_seen;
      const Eigen::Vector2d z =
          fit::predicted_px(c.fit, directions, part, static_cast<int>(i), c.observations.u_s[i]);
      fitted.frames[i][part] =
          known ? Point{fit::image_px(trajectory, c.observations.to_left, z), Source::predicted, 1}
                : Point{};
    }
  return fitted;
}

Trajectory fitted_px(const Trajectory& trajectory, const SagittalModel& model,
                     const Calibration& result) {
  const fit::StrideFit& fit = result.fit;
  const fit::Marks& marks = result.observations;
  const Directions directions(model);
  Trajectory fitted = fitted_points(trajectory, model, result);
  for (const BodyPart part : kBodyParts) {
    const bool seen = marks.count[index(part)] > 0;
    const std::array<double, kPhases> sd = sd_px(fit, directions, part);
    for (std::size_t i = 0; i < fitted.frames.size(); ++i) {
      Point& point = fitted.frames[i][part];
      if (!seen) point = {};
      if (!point.present()) continue;
      const double phase = phase_at(fit.runner.cadence.data(), marks.u_s[i]);
      const auto nearest = std::lround(kPhases * (phase - std::floor(phase))) % kPhases;
      const double relative = 30 * sd[static_cast<std::size_t>(nearest)] / leg_px(fit.runner);
      point.confidence = kPredictedConfidence / (1 + relative * relative);
    }
  }
  return fitted;
}

}  // namespace stride
