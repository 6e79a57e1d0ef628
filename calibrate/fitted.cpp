#include "calibrate/fitted.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stride {
namespace {

constexpr int kPhases = 24;

/// Whether the points told the fit where a part is.
bool is_known(const fit::StrideFit& fit, BodyPart part) {
  switch (part) {
    case BodyPart::pelvis:
    case BodyPart::hip_r:
    case BodyPart::hip_l:
    case BodyPart::knee_r:
    case BodyPart::knee_l:
    case BodyPart::ankle_r:
    case BodyPart::ankle_l:
      return true;
    case BodyPart::toe_r:
    case BodyPart::toe_l:
      return fit.toes_seen;
    case BodyPart::heel_r:
    case BodyPart::heel_l:
      return fit.heels_seen;
    case BodyPart::head:
      return fit.head_seen;
  }
  return false;
}

/// The confidence of a fitted part whose deviation from the pelvis is known.
double confidence(double sd_px, double leg_px) {
  const double relative = 30 * sd_px / leg_px;
  return kPredictedConfidence / (1 + relative * relative);
}

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

/// The same of a passage in one frame, from the covariance of limbs and control points.
double sd_px(const aperiodic::PassageFit& fit, const Directions& directions, BodyPart part,
             double u_s) {
  constexpr double kStep = 1e-4;  // rad
  const aperiodic::Passage& p = fit.passage;
  const aperiodic::SplinePlace at = p.place(u_s);
  const aperiodic::Angles angles = p.angles(u_s);
  const Eigen::Vector2d here = aperiodic::about_pelvis(part, directions, p.limbs.data(), angles);
  Eigen::MatrixXd by = Eigen::MatrixXd::Zero(2, fit.covariance.rows());
  for (int i = 0; i < aperiodic::limb::size; ++i) {
    auto moved = p.limbs;
    const double step = kStep * p.leg_px();
    moved[static_cast<std::size_t>(i)] += step;
    by.col(i) = (aperiodic::about_pelvis(part, directions, moved.data(), angles) - here) / step;
  }
  for (int a = 0; a < aperiodic::kAngles; ++a) {
    aperiodic::Angles moved = angles;
    moved[static_cast<std::size_t>(a)] += kStep;
    const Eigen::Vector2d slope =
        (aperiodic::about_pelvis(part, directions, p.limbs.data(), moved) - here) / kStep;
    for (int j = 0; j < 4; ++j)
      by.col(aperiodic::limb::size + aperiodic::kAngles * (at.first + j) + a) +=
          at.weight[static_cast<std::size_t>(j)] * slope;
  }
  return std::sqrt(std::max(0.0, (by * fit.covariance * by.transpose()).trace() / 2));
}

Trajectory fitted_passage_px(Trajectory fitted, const Directions& directions,
                             const Calibration& result) {
  const aperiodic::PassageFit& fit = result.aperiodic->fit;
  for (const BodyPart part : kAskedParts) {
    const bool seen = result.observations.count[index(part)] > 0;
    for (std::size_t i = 0; i < fitted.frames.size(); ++i) {
      Point& point = fitted.frames[i][part];
      if (!seen) point = {};
      if (point.present())
        point.confidence = confidence(sd_px(fit, directions, part, result.observations.u_s[i]),
                                      fit.passage.leg_px());
    }
  }
  return fitted;
}

}  // namespace

Trajectory fitted_points(const Trajectory& trajectory, const SagittalModel& model,
                         const Calibration& c) {
  const Directions directions(model);
  Trajectory fitted = trajectory;
  if (c.aperiodic) {
    for (std::size_t i = 0; i < fitted.frames.size(); ++i) {
      fitted.frames[i].points = {};
      for (const BodyPart part : kAskedParts)
        fitted.frames[i][part] = {
            fit::image_px(trajectory, c.observations.to_left,
                          aperiodic::predicted_px(c.aperiodic->fit.passage, directions, part,
                                                  static_cast<int>(i), c.observations.u_s[i])),
            Source::predicted, 1};
    }
    return fitted;
  }
  for (std::size_t i = 0; i < fitted.frames.size(); ++i)
    for (const BodyPart part : kBodyParts) {
      const Eigen::Vector2d z =
          fit::predicted_px(c.fit, directions, part, static_cast<int>(i), c.observations.u_s[i]);
      fitted.frames[i][part] =
          is_known(c.fit, part)
              ? Point{fit::image_px(trajectory, c.observations.to_left, z), Source::predicted, 1}
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
  if (result.aperiodic) return fitted_passage_px(std::move(fitted), directions, result);
  for (const BodyPart part : kBodyParts) {
    const bool seen = marks.count[index(part)] > 0;
    const std::array<double, kPhases> sd = sd_px(fit, directions, part);
    for (std::size_t i = 0; i < fitted.frames.size(); ++i) {
      Point& point = fitted.frames[i][part];
      if (!seen) point = {};
      if (!point.present()) continue;
      const double phase = phase_at(fit.runner.cadence.data(), marks.u_s[i]);
      const auto nearest = std::lround(kPhases * (phase - std::floor(phase))) % kPhases;
      point.confidence = confidence(sd[static_cast<std::size_t>(nearest)], leg_px(fit.runner));
    }
  }
  return fitted;
}

}  // namespace stride
