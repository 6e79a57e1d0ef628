#include "calibrate/gait/gait.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibrate/fit/stance.h"
#include "calibrate/gait/human_running.h"

namespace stride::gait {
namespace {

constexpr int kPhases = 200;

double fraction(double phase) { return phase - std::floor(phase); }

/// Pelvis height of the runner on the model's legs.
double to_model(const fit::StrideFit& fit, const SagittalModel& model) {
  return (model.thigh_m() + model.shank_m()) /
         (fit.runner.body[body::thigh] + fit.runner.body[body::shank]);
}

/// Mean of right and left leg at a phase of their own cycle.
LegAngles<double> mean_leg(const fit::StrideFit& fit, double phase) {
  const Runner& r = fit.runner;
  return {evaluate_series(r.hip.data(), fit.harmonics, phase),
          evaluate_series(r.knee.data(), fit.harmonics, phase),
          evaluate_series(r.ankle.data(), fit.harmonics, phase)};
}

/// The shift at which hip and knee correlate best with those of measured runners.
void find_foot_strike(const fit::StrideFit& fit, const HumanRunning& human, Gait& gait) {
  const auto moments = [](const std::vector<double>& values) {
    double mean = 0, square = 0;
    for (const double v : values) mean += v / static_cast<double>(values.size());
    for (const double v : values) square += (v - mean) * (v - mean);
    return std::pair(mean, std::sqrt(square));
  };
  std::vector<double> hip, knee, human_hip, human_knee;
  for (int i = 0; i < kPhases; ++i) {
    const double phase = static_cast<double>(i) / kPhases;
    hip.push_back(mean_leg(fit, phase).hip);
    knee.push_back(mean_leg(fit, phase).knee);
    human_hip.push_back(human.at(human.hip.mean, phase));
    human_knee.push_back(human.at(human.knee.mean, phase));
  }
  const auto [hip_mean, hip_size] = moments(hip);
  const auto [knee_mean, knee_size] = moments(knee);
  const auto [human_hip_mean, human_hip_size] = moments(human_hip);
  const auto [human_knee_mean, human_knee_size] = moments(human_knee);
  gait.correlation = -1;
  for (int shift = 0; shift < kPhases; ++shift) {
    double at_hip = 0, at_knee = 0;
    for (int i = 0; i < kPhases; ++i) {
      const int j = (i + shift) % kPhases;
      at_hip += (hip[j] - hip_mean) * (human_hip[i] - human_hip_mean);
      at_knee += (knee[j] - knee_mean) * (human_knee[i] - human_knee_mean);
    }
    const double correlation = 0.5 * (at_hip / std::max(hip_size * human_hip_size, 1e-12) +
                                      at_knee / std::max(knee_size * human_knee_size, 1e-12));
    if (correlation > gait.correlation) {
      gait.correlation = correlation;
      gait.foot_strike = static_cast<double>(shift) / kPhases;
    }
  }
}

/// Height of the model's foot by phase after its own strike.
struct FootPath {
  std::vector<double> height_m;            // of the lowest point, above the lowest of the stride
  std::vector<double> toe_x_m, ankle_x_m;  // before the hips
  double lowest_m = 0;                     // below the mean height of the pelvis, negative
};

FootPath foot_path(const fit::StrideFit& fit, const SagittalModel& model, double foot_strike) {
  FootPath path;
  for (int i = 0; i < kPhases; ++i) {
    const double phase = foot_strike + static_cast<double>(i) / kPhases;
    const auto angles = mean_leg(fit, phase);
    const double tilt = evaluate_series(fit.runner.tilt.data(), kTiltHarmonics, phase);
    const auto leg = place_leg(model, tilt, angles.hip, angles.knee, angles.ankle);
    path.height_m.push_back(lowest_point(model, leg) +
                            to_model(fit, model) * fit.vertical_oscillation(phase));
    path.toe_x_m.push_back(leg.toe.x() - leg.hip.x());
    path.ankle_x_m.push_back(leg.ankle.x() - leg.hip.x());
  }
  path.lowest_m = *std::ranges::min_element(path.height_m);
  for (double& height : path.height_m) height -= path.lowest_m;
  return path;
}

/// The time in which the foot moves back under the runner, from its foremost to its rearmost
/// position.
struct Sweep {
  double begin = 0, length = 0;  // phase after the strike; part of the stride
};

Sweep sweep(const FootPath& path) {
  const auto at = [](auto it, const std::vector<double>& x_m) {
    return static_cast<double>(it - x_m.begin()) / kPhases;
  };
  const double begin = at(std::ranges::max_element(path.ankle_x_m), path.ankle_x_m);
  return {begin, fraction(at(std::ranges::min_element(path.toe_x_m), path.toe_x_m) - begin)};
}

/// Walking: the pelvis is highest over the stance foot, as on a stilt. Running: it is lowest there,
/// as on a spring. This holds for any size and frame rate.
bool walks(const fit::StrideFit& fit, const FootPath& path, double foot_strike) {
  const Sweep foot = sweep(path);
  const Eigen::Vector4d w =
      fit::VerticalOscillation::weights(foot_strike + foot.begin + foot.length / 2);
  return w.head<2>().dot(fit.vertical_oscillation.c.head<2>()) > 0;
}

/// Duty factor. A runner's stance ends when the foot is 3 cm above its height in stance. A walker
/// swings the foot lower; there stance lasts while the foot moves back.
double duty(const FootPath& path, bool walks) {
  constexpr double kLifted = 0.03;
  if (walks) return sweep(path).length;
  bool stood = false;
  for (int i = 0; i < kPhases * 9 / 10; ++i) {
    if (path.height_m[i] < 0.5 * kLifted) stood = true;
    if (stood && path.height_m[i] > kLifted) return static_cast<double>(i) / kPhases;
  }
  return 0.9;
}

/// Standard deviations of a sample's points and height, from the covariance of the fit.
void add_deviations(const fit::StrideFit& fit, const SagittalModel& model, double phase,
                    CalibratedSample& sample) {
  const int placed =
      fit.heels_seen ? kBodyPartCount : static_cast<int>(kAskedParts.size());  // of the parts
  const Eigen::VectorXd sd =
      fit::propagated_sd(fit, [&](const fit::StrideFit& moved) -> Eigen::VectorXd {
        const CalibratedSample at = pose_at(moved, model, phase);
        return Eigen::Map<const Eigen::VectorXd>(at.p_m.front().data(), 2 * placed);
      });
  for (int part = 0; part < placed; ++part) sample.sd_m[part] = sd.segment<2>(2 * part);
  const Eigen::Vector4d w = fit::VerticalOscillation::weights(phase);
  // The mean height follows from the lowest foot, so it is as uncertain as an ankle's height.
  const double height_variance = w.dot(fit.vertical_oscillation.covariance * w) +
                                 std::pow(sample.sd_m[index(BodyPart::ankle_r)].y(), 2);
  sample.pelvis_height_sd_m = std::sqrt(height_variance);
}

}  // namespace

CalibratedSample pose_at(const fit::StrideFit& fit, const SagittalModel& model, double phase) {
  const Runner& r = fit.runner;
  CalibratedSample sample;
  sample.coordinates[0] = evaluate_series(r.tilt.data(), kTiltHarmonics, phase);
  sample.coordinates[2] = to_model(fit, model) * fit.vertical_oscillation(phase);
  for (const int side : {1, -1}) {
    const auto leg = leg_angles(r.hip.data(), r.knee.data(), r.ankle.data(), r.asymmetry.data(),
                                fit.harmonics, side, phase);
    const int first = side > 0 ? 3 : 6;
    sample.coordinates[first] = leg.hip;
    sample.coordinates[first + 1] = leg.knee;
    sample.coordinates[first + 2] = leg.ankle;
  }
  place_parts(model, sample);
  if (!fit.heels_seen) forget_heels(sample);
  return sample;
}

void fill_unseen_ankles(fit::StrideFit& fit) {
  if (fit.toes_seen) return;
  const HumanRunning human = load_human_running();
  Gait gait;
  find_foot_strike(fit, human, gait);
  fit.runner.ankle = {};
  for (int i = 0; i < kPhases; ++i) {
    const double phase = static_cast<double>(i) / kPhases;
    const double value = human.at(human.ankle.mean, phase - gait.foot_strike);
    fit.runner.ankle[0] += value / kPhases;
    for (int h = 1; h <= fit.harmonics; ++h) {
      const double angle = 2 * std::numbers::pi * h * phase;
      fit.runner.ankle[2 * h - 1] += 2 * value * std::cos(angle) / kPhases;
      fit.runner.ankle[2 * h] += 2 * value * std::sin(angle) / kPhases;
    }
  }
}

Gait analyse_gait(const fit::StrideFit& fit, const SagittalModel& model) {
  Gait gait;
  find_foot_strike(fit, load_human_running(), gait);
  const FootPath path = foot_path(fit, model, gait.foot_strike);
  gait.walks = walks(fit, path, gait.foot_strike);
  gait.duty = duty(path, gait.walks);
  gait.pelvis_height_m = -path.lowest_m;
  gait.vertical_oscillation_m = to_model(fit, model) * fit.vertical_oscillation.peak_to_peak_m();
  // Heel strike and push-off rotate the toe in opposite directions, so the mean over stance is
  // better than any single phase.
  for (const BodyPart toe : {BodyPart::toe_r, BodyPart::toe_l})
    gait.speed_m_s += 0.5 * fit::find_stance(fit, Directions(model), toe).speed_m_s;
  return gait;
}

CalibratedTrajectory retarget(const fit::StrideFit& fit, const Gait& gait,
                              const SagittalModel& model, const fit::Marks& observations) {
  constexpr double kStep = 0.01;
  const Runner& r = fit.runner;
  CalibratedTrajectory run;
  run.model = model.name;
  run.period_s = r.cadence[cadence::period_s];
  run.period_sd_s = fit.period_sd_s();
  run.speed_m_s = gait.speed_m_s;
  run.metres_per_pixel = std::exp(-r.camera[camera::log_px_per_m]);
  run.camera_roll_rad = observations.to_left ? -r.camera[camera::roll] : r.camera[camera::roll];
  run.rms_px = fit.rms_px;
  run.rms_m = fit.rms_px * run.metres_per_pixel;
  const double first_s = observations.middle_s + observations.u_s.front();
  const double span = std::max(observations.duration_s, run.period_s);
  for (int i = 0; i * kStep <= span + 0.5 * kStep; ++i) {
    const double u = observations.u_s.front() + i * kStep;
    const double phase = phase_at(r.cadence.data(), u);
    CalibratedSample sample = pose_at(fit, model, phase);
    sample.time_s = first_s + i * kStep;
    sample.phase = fraction(phase - gait.foot_strike);
    sample.coordinates[1] = gait.speed_m_s * i * kStep;
    sample.coordinates[2] += gait.pelvis_height_m;
    add_deviations(fit, model, phase, sample);
    run.samples.push_back(sample);
  }
  return run;
}

}  // namespace stride::gait
