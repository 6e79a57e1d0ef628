#include "extract/import/export.h"

#include <gtest/gtest.h>

#include <random>

#include "extract/import/import.h"
#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

/// A jittering figure with some points absent.
Trajectory random_trajectory(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Trajectory trajectory;
  trajectory.video = "run.mp4";
  trajectory.width_px = 640;
  trajectory.height_px = 360;
  trajectory.rate_hz = 29.97;
  std::array<Eigen::Vector2d, kBodyPartCount> shape;
  for (Eigen::Vector2d& p : shape) p = {600 * unit(random), 300 * unit(random)};
  for (int f = 3; f < 20; ++f) {
    TrajectoryFrame& frame = trajectory.frames.emplace_back();
    frame.frame = f;
    frame.time_s = f / trajectory.rate_hz;
    for (int i = 0; i < kBodyPartCount; ++i)
      if (i == 0 || unit(random) < 0.8)
        frame.points[i] = {shape[i] + Eigen::Vector2d(9 * unit(random), 9 * unit(random)),
                           Source::detected, 0.01 + 0.99 * unit(random)};
  }
  return trajectory;
}

TEST(Export, EveryFormatReadsBackAsTheSamePoints) {
  for (const std::string& format : imports::export_formats()) {
    SCOPED_TRACE(format);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const TemporaryFolder folder;
      const Trajectory trajectory = random_trajectory(seed);
      imports::export_points(trajectory, folder / "out", format);
      imports::ImportOptions options;
      options.min_confidence = 0;
      const imports::Detections back = imports::import_points(folder / "out", options);
      EXPECT_EQ(back.format, format);
      ASSERT_EQ(back.frames.size(), trajectory.frames.size());
      for (std::size_t i = 0; i < back.frames.size(); ++i) {
        EXPECT_EQ(back.frames[i].frame, trajectory.frames[i].frame);
        for (const BodyPart part : kBodyParts) {
          const Point &written = trajectory.frames[i][part], &read = back.frames[i][part];
          ASSERT_EQ(read.present(), written.present())
              << name(part) << " of frame " << back.frames[i].frame << ": "
              << written.p_px.transpose();
          if (!written.present()) continue;
          EXPECT_EQ(read.p_px, written.p_px) << name(part);
          EXPECT_EQ(read.confidence, format == "trc" ? 1 : written.confidence) << name(part);
        }
      }
    }
  }
}

TEST(Export, TellsTheFormatFromTheName) {
  const TemporaryFolder folder;
  const Trajectory trajectory = random_trajectory(1);
  imports::export_points(trajectory, folder / "o.csv");
  EXPECT_TRUE(read_file(folder / "o.csv").starts_with("frame,time_s,pelvis_x,pelvis_y,pelvis_con"));
  imports::export_points(trajectory, folder / "o.trc");
  EXPECT_TRUE(read_file(folder / "o.trc").starts_with("PathFileType\t4"));
  imports::export_points(trajectory, folder / "o");
  EXPECT_TRUE(std::filesystem::exists(folder / "o" / "run_000000000003_keypoints.json"));
  EXPECT_ERROR(imports::export_points(trajectory, folder / "o.xyz"),
               "format 'xyz' cannot be written; use one of csv, json, trc");
}

TEST(Export, OurOwnTrajectoryFileImportsToo) {
  const TemporaryFolder folder;
  const Trajectory trajectory = random_trajectory(2);
  save(trajectory, folder / "t.trajectory.csv");
  const imports::Detections back = imports::import_points(folder / "t.trajectory.csv");
  EXPECT_EQ(back.format, "csv");
  EXPECT_EQ(back.frames.front()[BodyPart::pelvis].p_px,
            trajectory.frames.front()[BodyPart::pelvis].p_px);
}

}  // namespace
}  // namespace stride
