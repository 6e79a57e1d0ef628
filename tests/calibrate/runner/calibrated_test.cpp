#include "calibrate/runner/calibrated.h"

#include <gtest/gtest.h>

#include <cmath>

#include "extract/io/file.h"
#include "extract/skeleton/trajectory.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

CalibratedTrajectory two_samples() {
  CalibratedTrajectory run;
  run.source = "a.mp4";
  run.source_sha256 = "00";
  run.model = "gait9dof18musc";
  run.period_s = 0.7;
  run.verdict = "walking: duty factor 0.62";
  run.samples.resize(2);
  for (CalibratedSample& sample : run.samples) sample.p_m.fill({0.1, -0.2});
  run.samples[1].time_s = 0.01;
  run.samples[1].phase = 1.0 / 70;
  run.samples[1].coordinates[4] = -1.0 / 3;
  run.samples[1].sd_m[index(BodyPart::knee_l)] = {0.01, 0.02};
  return run;
}

TEST(Calibrated, ReadsBackWhatWasSaved) {
  const TemporaryFolder folder;
  save(two_samples(), folder / "a.calibrated.csv");
  const CalibratedTrajectory loaded = load_calibrated(folder / "a.calibrated.csv");
  EXPECT_EQ(loaded.source, "a.mp4");
  EXPECT_EQ(loaded.verdict, "walking: duty factor 0.62");
  EXPECT_EQ(loaded.period_s, 0.7);
  EXPECT_TRUE(std::isnan(loaded.rms_px));
  ASSERT_EQ(loaded.samples.size(), 2u);
  EXPECT_EQ(loaded.samples[1].coordinates[4], -1.0 / 3);
  EXPECT_EQ(loaded.samples[1][BodyPart::toe_l], Eigen::Vector2d(0.1, -0.2));
  EXPECT_EQ(loaded.samples[1].sd_m[index(BodyPart::knee_l)], Eigen::Vector2d(0.01, 0.02));
  EXPECT_TRUE(std::isnan(loaded.samples[0].sd_m[index(BodyPart::knee_l)].x()));
}

TEST(Calibrated, ReadsBackEveryPart) {
  const TemporaryFolder folder;
  CalibratedTrajectory run = two_samples();
  for (const BodyPart part : kBodyParts) {
    run.samples[1].p_m[index(part)] = {0.1 * index(part), -0.5};
    run.samples[1].sd_m[index(part)] = {0.01, 0.02 + index(part)};
  }
  save(run, folder / "a.calibrated.csv");
  const CalibratedTrajectory loaded = load_calibrated(folder / "a.calibrated.csv");
  for (const BodyPart part : kBodyParts) {
    EXPECT_EQ(loaded.samples[1][part], run.samples[1][part]) << name(part);
    EXPECT_EQ(loaded.samples[1].sd_m[index(part)], run.samples[1].sd_m[index(part)]) << name(part);
  }
}

TEST(Calibrated, SaysHowToCureATrajectoryInPixels) {
  const TemporaryFolder folder;
  Trajectory pixels;
  pixels.rate_hz = 30;
  save(pixels, folder / "a.trajectory.csv");
  EXPECT_ERROR(load_calibrated(folder / "a.trajectory.csv"),
               "is a trajectory in pixels, a calibrated one in metres is needed; run `stride "
               "calibrate ");
}

TEST(Calibrated, NamesRowColumnAndValueOfABadCell) {
  const TemporaryFolder folder;
  CalibratedTrajectory run = two_samples();
  run.samples[1].coordinates[2] = std::nan("");
  save(run, folder / "a.csv");
  EXPECT_ERROR(load_calibrated(folder / "a.csv"), "row 2: pelvis_ty = nan: must be a finite");
  run = two_samples();
  run.samples[1].time_s = 0;
  save(run, folder / "a.csv");
  EXPECT_ERROR(load_calibrated(folder / "a.csv"), "row 2: time_s = 0: must grow");
  run = two_samples();
  run.period_s = -1;
  save(run, folder / "a.csv");
  EXPECT_ERROR(load_calibrated(folder / "a.csv"), "period_s = -1: must be positive");
  run = two_samples();
  run.samples[0].coordinates[3] = 19.6;  // degrees
  save(run, folder / "a.csv");
  EXPECT_ERROR(load_calibrated(folder / "a.csv"),
               "row 1: hip_flexion_r = 19.6: must be in rad, within a turn");
  run = two_samples();
  run.samples[1].coordinates[2] = 951;  // mm
  save(run, folder / "a.csv");
  EXPECT_ERROR(load_calibrated(folder / "a.csv"), "row 2: pelvis_ty = 951: must be the pelvis'");
  write_file_atomically(folder / "b.csv", "garbage\n");
  EXPECT_ERROR(load_calibrated(folder / "b.csv"), "b.csv: not a file of ours");
}

}  // namespace
}  // namespace stride
