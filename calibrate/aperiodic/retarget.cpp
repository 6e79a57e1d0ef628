#include "calibrate/aperiodic/retarget.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "extract/skeleton/units.h"

namespace stride::aperiodic {
namespace {

using Eigen::Vector2d;

/// The model's coordinates at a time, pelvis_tx and pelvis_ty 0.
CalibratedSample pose_at(const Angles& angles, double roll_rad, const SagittalModel& model) {
  CalibratedSample sample;
  sample.coordinates[0] = angles[tilt] - roll_rad;
  for (std::size_t i = 0; i < 6; ++i) sample.coordinates[3 + i] = angles[1 + i];
  place_parts(model, sample);
  forget_heels(sample);
  return sample;
}

/// The lowest contact point of either foot from the pelvis origin.
double lowest(const CalibratedSample& sample, const SagittalModel& model) {
  double least = 0;
  for (const std::size_t leg : {3, 6})
    least = std::min(
        least,
        lowest_point(model, place_leg(model, sample.coordinates[0], sample.coordinates[leg],
                                      sample.coordinates[leg + 1], sample.coordinates[leg + 2])));
  return least;
}

/// The centre of mass of the model from the pelvis origin, with the segments of people.
Vector2d com(const CalibratedSample& sample) {
  const auto along = [](const Segment& s, const Vector2d& a, const Vector2d& b) -> Vector2d {
    return s.mass * (a + s.along * (b - a));
  };
  const Vector2d hips = 0.5 * (sample[BodyPart::hip_r] + sample[BodyPart::hip_l]);
  Vector2d sum = along({kUpper.mass, kUpper.along * kShoulders}, hips, sample[BodyPart::head]);
  for (const auto& [knee, ankle, toe] :
       {std::array{BodyPart::knee_r, BodyPart::ankle_r, BodyPart::toe_r},
        std::array{BodyPart::knee_l, BodyPart::ankle_l, BodyPart::toe_l}})
    sum += along(kThigh, hips, sample[knee]) + along(kShank, sample[knee], sample[ankle]) +
           along(kFoot, sample[ankle], sample[toe]);
  return sum;
}

/// Standard deviations of every part at a time, from the covariance of limbs and control points.
void add_deviations(const PassageFit& fit, const GroundPath& path, double u_s,
                    const SagittalModel& model, CalibratedSample& sample) {
  const SplinePlace at = fit.passage.place(u_s);
  const Angles angles = fit.passage.angles(u_s);
  constexpr double kStep_rad = 1e-4;
  constexpr int kPlaced = static_cast<int>(kAskedParts.size());
  Eigen::Matrix<double, 2 * kPlaced, kAngles> by_angle;
  for (int a = 0; a < kAngles; ++a) {
    Angles moved = angles;
    moved[static_cast<std::size_t>(a)] += kStep_rad;
    const CalibratedSample there = pose_at(moved, path.roll_rad, model);
    for (int part = 0; part < kPlaced; ++part)
      by_angle.block<2, 1>(2 * part, a) =
          (there.p_m[static_cast<std::size_t>(part)] - sample.p_m[static_cast<std::size_t>(part)]) /
          kStep_rad;
  }
  // Of the angles at this time: four control points with their weights.
  Eigen::Matrix<double, kAngles, kAngles> covariance =
      Eigen::Matrix<double, kAngles, kAngles>::Zero();
  for (int j = 0; j < 4; ++j)
    for (int k = 0; k < 4; ++k)
      covariance += at.weight[static_cast<std::size_t>(j)] *
                    at.weight[static_cast<std::size_t>(k)] *
                    fit.covariance.block<kAngles, kAngles>(limb::size + kAngles * (at.first + j),
                                                           limb::size + kAngles * (at.first + k));
  covariance(tilt, tilt) += path.roll_sd_rad * path.roll_sd_rad;
  const Eigen::VectorXd sd =
      (by_angle * covariance * by_angle.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
  for (int part = 0; part < kPlaced; ++part)
    sample.sd_m[static_cast<std::size_t>(part)] = sd.segment<2>(2 * part);
  sample.pelvis_height_sd_m = sample.sd_m[static_cast<std::size_t>(index(BodyPart::ankle_r))].y();
}

/// Linear between the frames.
Vector2d between_frames(const std::vector<Vector2d>& points, const std::vector<double>& u_s,
                        double at_s) {
  const auto after = std::ranges::lower_bound(u_s, at_s);
  if (after == u_s.begin()) return points.front();
  if (after == u_s.end()) return points.back();
  const auto i = static_cast<std::size_t>(after - u_s.begin());
  const double share = (at_s - u_s[i - 1]) / (u_s[i] - u_s[i - 1]);
  return (1 - share) * points[i - 1] + share * points[i];
}

}  // namespace

Scale scale_of(const PassageFit& fit, const Flight& flight, const fit::FitOptions& options) {
  const auto& line = options.measured_scale;
  const double by_size =
      line ? 1 / line->metres_per_pixel : fit.passage.leg_px() / options.leg_m.mean;
  const double sd = line ? line->relative_sd : options.leg_m.sd;
  Scale scale;
  if (options.metres_per_pixel) {
    scale.px_per_m = 1 / *options.metres_per_pixel;
    scale.relative_sd = 1e-4;
  } else {
    const double a = 1 / std::pow(flight.relative_sd, 2), b = 1 / std::pow(sd, 2);
    scale.px_per_m = std::exp((a * std::log(flight.px_per_m) + b * std::log(by_size)) / (a + b));
    scale.relative_sd = 1 / std::sqrt(a + b);
  }
  scale.leg_m = fit.passage.leg_px() / scale.px_per_m;
  scale.fall_factor = flight.px_per_m / by_size;
  scale.disagreement = std::log(scale.fall_factor) / std::hypot(flight.relative_sd, sd);
  return scale;
}

CalibratedTrajectory retarget(const PassageFit& fit, const GroundPath& path, const Flight& flight,
                              const Scale& scale, const SagittalModel& model,
                              const fit::Marks& observations) {
  constexpr double kStep_s = 0.01;
  const double to_model = (model.thigh_m() + model.shank_m()) / fit.passage.leg_px();
  CalibratedTrajectory run;
  run.model = model.name;
  run.period_s = observations.duration_s;
  run.metres_per_pixel = 1 / scale.px_per_m;
  run.camera_roll_rad = observations.to_left ? -path.roll_rad : path.roll_rad;
  run.rms_px = fit.rms_px;
  run.rms_m = fit.rms_px / scale.px_per_m;
  run.take_off_s = observations.middle_s + flight.take_off_s;
  run.landing_s = observations.middle_s + flight.landing_s;
  run.speed_m_s =
      (path.pelvis_px.back() - path.pelvis_px.front()).x() / scale.px_per_m / run.period_s;
  const auto pose = [&](double u_s) {
    return pose_at(fit.passage.angles(u_s), path.roll_rad, model);
  };
  // In flight the centre of mass moves on a parabola between its heights on the ground.
  const auto com_height = [&](double u_s) {
    const CalibratedSample at = pose(u_s);
    return com(at).y() - lowest(at, model);
  };
  const double flight_s = flight.landing_s - flight.take_off_s;
  const double left_m = com_height(flight.take_off_s), landed_m = com_height(flight.landing_s);
  const double first_u_s = observations.u_s.front();
  const Vector2d first_px = path.pelvis_px.front();
  for (int i = 0; i * kStep_s <= run.period_s + 0.5 * kStep_s; ++i) {
    const double u_s = first_u_s + i * kStep_s;
    CalibratedSample sample = pose(u_s);
    sample.time_s = observations.middle_s + u_s;
    sample.phase = std::min(1.0, i * kStep_s / run.period_s);
    sample.coordinates[1] =
        to_model * (between_frames(path.pelvis_px, path.u_s, u_s) - first_px).x();
    sample.coordinates[2] = -lowest(sample, model);
    const double t = u_s - flight.take_off_s;
    if (t > 0 && t < flight_s)
      sample.coordinates[2] = std::lerp(left_m, landed_m, t / flight_s) +
                              0.5 * kGravity_m_s2 * t * (flight_s - t) - com(sample).y();
    add_deviations(fit, path, u_s, model, sample);
    run.samples.push_back(sample);
  }
  return run;
}

}  // namespace stride::aperiodic
