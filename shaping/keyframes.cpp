#include "shaping/keyframes.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "extract/io/error.h"

namespace stride {
namespace {

constexpr int kNumbers = 9;  // of a pose
using Numbers = Eigen::Matrix<double, 1, kNumbers>;

Numbers numbers(const Pose& pose) {
  Numbers row;
  row << pose.pelvis_height_m, pose.knee_r.transpose(), pose.foot_r.transpose(),
      pose.knee_l.transpose(), pose.foot_l.transpose();
  return row;
}

Pose pose(const Numbers& row) {
  return {.pelvis_height_m = row[0],
          .knee_r = row.segment<2>(1).transpose(),
          .foot_r = row.segment<2>(3).transpose(),
          .knee_l = row.segment<2>(5).transpose(),
          .foot_l = row.segment<2>(7).transpose()};
}

Eigen::RowVectorXd basis(double phase, int harmonics) {
  Eigen::RowVectorXd row(2 * harmonics + 1);
  row[0] = 1;
  for (int h = 1; h <= harmonics; ++h) {
    row[2 * h - 1] = std::cos(2 * std::numbers::pi * h * phase);
    row[2 * h] = std::sin(2 * std::numbers::pi * h * phase);
  }
  return row;
}

double distance(double a, double b) { return std::abs(a - b - std::round(a - b)); }

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

}  // namespace

Pose pose_of(const CalibratedSample& sample, std::string_view foot) {
  const bool toe = foot == "toe";
  return {.pelvis_height_m = sample.coordinates[2],
          .knee_r = sample[BodyPart::knee_r],
          .foot_r = sample[toe ? BodyPart::toe_r : BodyPart::ankle_r],
          .knee_l = sample[BodyPart::knee_l],
          .foot_l = sample[toe ? BodyPart::toe_l : BodyPart::ankle_l]};
}

Potential make_potential(const CalibratedTrajectory& run, const KeyframeOptions& options,
                         const std::string& origin) {
  require(options.count >= 4 && options.count % 2 == 0,
          "keyframes = {}: must be even and at least 4, as a stride has two half steps",
          options.count);
  require_whole_stride(run, origin);
  const auto n = static_cast<Eigen::Index>(run.samples.size());
  const int harmonics = static_cast<int>(std::clamp<Eigen::Index>(n / 4, 1, 8));
  Eigen::MatrixXd rows(n, 2 * harmonics + 1);
  Eigen::Matrix<double, Eigen::Dynamic, kNumbers> values(n, kNumbers);
  for (Eigen::Index i = 0; i < n; ++i) {
    const CalibratedSample& sample = run.samples[static_cast<std::size_t>(i)];
    rows.row(i) = basis(sample.phase, harmonics);
    values.row(i) = numbers(pose_of(sample, options.foot));
  }
  const Eigen::MatrixXd curves = rows.completeOrthogonalDecomposition().solve(values);

  Potential potential;
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
  for (int k = 0; k < options.count; ++k) {
    const double phase = static_cast<double>(k) / options.count;
    const auto target = [&](double at) { return pose(basis(at, harmonics) * curves); };
    Pose mean = target(phase);
    if (options.symmetric)
      mean = pose(0.5 * (numbers(mean) + numbers(target(phase + 0.5).mirrored())));
    const auto nearest = std::ranges::min_element(
        run.samples, {}, [&](const auto& sample) { return distance(sample.phase, phase); });
    potential.keyframes.push_back(
        {.phase = phase, .pose = mean, .sd = deviations(*nearest, options.foot)});
  }
  check(potential, origin);
  return potential;
}

}  // namespace stride
