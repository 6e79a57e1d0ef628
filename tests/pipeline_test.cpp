// The shipped clip through the left half of the pipeline, compared with its truth.
#include <gtest/gtest.h>

#include <cmath>

#include "calibrate/runner/sagittal_model.h"
#include "extract/io/table.h"
#include "shaping/pipeline/convert.h"
#include "shaping/potential.h"
#include "tests/support/temporary_folder.h"

namespace stride {
namespace {

const std::filesystem::path kVideos = std::filesystem::path(STRIDE_SOURCE_DIR) / "videos";

/// Rms distance of a part of the runner relative to the pelvis, from true angles put on the model.
double rms_m(const CalibratedTrajectory& run, const Table& truth, const SagittalModel& model,
             BodyPart part) {
  const std::size_t time = truth.column("time_s");
  double sum = 0;
  int n = 0;
  for (const CalibratedSample& sample : run.samples) {
    std::size_t i = 1;
    while (i < truth.rows.size() && truth.rows[i][time] < sample.time_s) ++i;
    if (i == truth.rows.size() || truth.rows[0][time] > sample.time_s) continue;
    const auto &before = truth.rows[i - 1], &after = truth.rows[i];
    const double w = (sample.time_s - before[time]) / (after[time] - before[time]);
    CalibratedSample true_sample;
    for (std::size_t c = 0; c < kCoordinateNames.size(); ++c) {
      const std::size_t column = truth.column(kCoordinateNames[c]);
      true_sample.coordinates[c] = (1 - w) * before[column] + w * after[column];
    }
    place_parts(model, true_sample);
    sum += (sample[part] - true_sample[part]).squaredNorm();
    ++n;
  }
  EXPECT_GT(n, 200);
  return std::sqrt(sum / n);
}

double rms_px(const Trajectory& tracked, const Trajectory& truth, BodyPart part) {
  double sum = 0;
  int n = 0;
  for (const TrajectoryFrame& frame : tracked.frames) {
    sum += (frame[part].p_px - truth.frames.at(static_cast<std::size_t>(frame.frame))[part].p_px)
               .squaredNorm();
    ++n;
  }
  return std::sqrt(sum / n);
}

TEST(Pipeline, MakesThePotentialOfTheRunnerFromHisVideo) {
  const TemporaryFolder folder;
  pipeline::ConvertOptions options;
  options.out = folder.path();
  options.pictures = false;
  const auto results = pipeline::convert({kVideos / "human.mp4"}, options);
  ASSERT_EQ(results.size(), 1u);
  ASSERT_FALSE(results[0].failed) << results[0].verdict;

  const Trajectory tracked = load_trajectory(folder / "human.trajectory.csv");
  const Trajectory truth_px = load_trajectory(kVideos / "human.truth.csv");
  for (const BodyPart part : kRequiredParts)
    EXPECT_LT(rms_px(tracked, truth_px, part), 3) << name(part);

  const Table truth = load_table(kVideos / "human.truth_m.csv", "truth", 1);
  const CalibratedTrajectory run = load_calibrated(folder / "human.calibrated.csv");
  EXPECT_NEAR(run.metres_per_pixel / truth.meta_number("metres_per_pixel"), 1, 0.02);
  EXPECT_NEAR(run.period_s / truth.meta_number("period_s"), 1, 0.005);
  EXPECT_NEAR(run.speed_m_s / truth.meta_number("speed_m_s"), 1, 0.03);
  const SagittalModel model = sagittal_model(osim::load_osim(osim::default_model_file()));
  for (const BodyPart part :
       {BodyPart::knee_r, BodyPart::ankle_r, BodyPart::knee_l, BodyPart::ankle_l})
    EXPECT_LT(rms_m(run, truth, model, part), 0.018) << name(part);

  // A potential is highest where the runner of the video is, whatever the phase.
  const Potential potential = load_potential(folder / "human.potential.json");
  ASSERT_EQ(potential.keyframes.size(), 8u);
  for (const Keyframe& keyframe : potential.keyframes)
    for (const Keyframe& other : potential.keyframes)
      EXPECT_GE(potential(keyframe.pose, keyframe.phase), potential(keyframe.pose, other.phase));
}

}  // namespace
}  // namespace stride
