#include "shaping/keyframes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>

#include "extract/io/error.h"
#include "extract/skeleton/fourier_series.h"
#include "extract/skeleton/least_squares.h"
#include "extract/skeleton/movement.h"

namespace stride {
namespace {

Pose to_pose(const Eigen::RowVectorXd& row) {
  Pose pose;
  std::ranges::copy(row, pose.m.begin());
  return pose;
}

/// Of phases, by the shorter way round where they repeat.
double distance(double a, double b, bool repeats) {
  return std::abs(a - b - (repeats ? std::round(a - b) : 0));
}

Pose deviations(const CalibratedSample& sample, std::string_view foot) {
  CalibratedSample sd = sample;
  sd.p_m = sample.sd_m;
  sd.coordinates[2] = sample.pelvis_height_sd_m;
  return pose_of(sd, foot);
}

void require_whole_stride(const CalibratedTrajectory& run, const std::string& origin) {
  std::vector<double> phases;
  for (const CalibratedSample& sample : run.samples) phases.push_back(sample.phase);
  std::ranges::sort(phases);
  double gap = 1 - phases.back() + phases.front();
  for (std::size_t i = 1; i < phases.size(); ++i) gap = std::max(gap, phases[i] - phases[i - 1]);
  require(gap < 0.13, "{}: no sample for {:.0f} % of the stride: a whole stride is needed", origin,
          100 * gap);
}

/// A motion by phase.
using Motion = std::function<Pose(double phase)>;

/// The mean stride.
Motion stride_of(const CalibratedTrajectory& run, const std::string& foot) {
  const auto n = static_cast<Eigen::Index>(run.samples.size());
  const int harmonics = static_cast<int>(std::clamp<Eigen::Index>(n / 4, 1, 8));
  Eigen::MatrixXd rows(n, 2 * harmonics + 1);
  Eigen::MatrixXd values(n, kPoseNumbers);
  for (Eigen::Index i = 0; i < n; ++i) {
    const CalibratedSample& sample = run.samples[static_cast<std::size_t>(i)];
    rows.row(i) = fourier_basis(sample.phase, harmonics).transpose();
    values.row(i) = pose_of(sample, foot).row();
  }
  const Eigen::MatrixXd curves = least_squares(rows, values);
  return [curves, harmonics](double phase) {
    return to_pose(fourier_basis(phase, harmonics).transpose() * curves);
  };
}

/// What does not repeat, linear between its samples.
Motion passage_of(const CalibratedTrajectory& run, const std::string& foot) {
  return [&samples = run.samples, foot](double phase) {
    const auto after = std::ranges::lower_bound(samples, phase, {}, &CalibratedSample::phase);
    if (after == samples.begin()) return pose_of(samples.front(), foot);
    if (after == samples.end()) return pose_of(samples.back(), foot);
    const CalibratedSample& before = *std::prev(after);
    const double share = (phase - before.phase) / (after->phase - before.phase);
    return to_pose((1 - share) * pose_of(before, foot).row() + share * pose_of(*after, foot).row());
  };
}

void require_beginning_and_end(const CalibratedTrajectory& run, const std::string& origin) {
  constexpr double kEnds = 0.02;
  const double first = run.samples.front().phase, last = run.samples.back().phase;
  require(first < kEnds && last > 1 - kEnds,
          "{}: phases {:.2f} to {:.2f}: a {} is needed from its beginning, 0, to its end, 1",
          origin, first, last, run.movement);
  for (std::size_t i = 1; i < run.samples.size(); ++i)
    require(run.samples[i].phase > run.samples[i - 1].phase,
            "{}: row {}: phase = {}: must grow from row to row in a {}", origin, i + 1,
            run.samples[i].phase, run.movement);
}

}  // namespace

Pose pose_of(const CalibratedSample& sample, std::string_view foot) {
  Pose pose;
  for (const ComparedPart& each : kPoseParts)
    if (each.numbers == 2) pose[each.part] = sample[foot == "toe" ? each.toe : each.ankle];
  pose.pelvis_height_m() = sample.coordinates[2];
  return pose;
}

Potential make_potential(const CalibratedTrajectory& run, const KeyframeOptions& options,
                         const std::string& origin) {
  require(options.count >= 4 && options.count % 2 == 0,
          "keyframes = {}: must be even and at least 4, as a stride has two half steps",
          options.count);
  Potential potential;
  set_movement(potential, run.movement, origin + ": movement");
  const Movement& known = movement(run.movement);
  if (known.repeats)
    require_whole_stride(run, origin);
  else
    require_beginning_and_end(run, origin);
  const Motion target =
      known.repeats ? stride_of(run, options.foot) : passage_of(run, options.foot);
  const int count = known.repeats ? options.count : 2 * options.count;
  potential.source = run.source;
  potential.source_sha256 = run.source_sha256;
  potential.model = run.model;
  potential.foot = options.foot;
  potential.period_s = run.period_s;
  potential.period_sd_s = run.period_sd_s;
  potential.speed_m_s = run.speed_m_s;
  potential.rms_px = run.rms_px;
  potential.rms_m = run.rms_m;
  potential.verdict = run.verdict;
  potential.function = options.function;
  potential.index = options.index;
  potential.epsilon_m = options.epsilon_m;
  potential.weight = options.weight;
  for (int k = 0; k < count; ++k) {
    const double phase = static_cast<double>(k) / (known.repeats ? count : count - 1);
    Pose mean = target(phase);
    if (options.symmetric && known.legs != Legs::free)
      mean =
          to_pose(0.5 * (mean.row() + target(phase + potential.mirrored_after).mirrored().row()));
    const auto nearest = std::ranges::min_element(run.samples, {}, [&](const auto& sample) {
      return distance(sample.phase, phase, known.repeats);
    });
    potential.keyframes.push_back(
        {.phase = phase, .pose = mean, .sd = deviations(*nearest, options.foot)});
  }
  check(potential, origin);
  return potential;
}

}  // namespace stride
