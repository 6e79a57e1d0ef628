#include "calibrate/fitted.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "calibrate/commands.h"
#include "extract/io/file.h"
#include "tests/calibrate/rendered.h"
#include "tests/support/temporary_folder.h"
#include "videos/truth.h"

namespace stride {
namespace {

Trajectory clicked(const char* clip) {
  return observed(videos::clip(clip), {.every_frame = false, .noise_px = 1.5, .seed = 3});
}

TEST(Fitted, PutsTheRunnerNearTheTruthInEveryFrame) {
  for (const char* name : {"human", "left"}) {
    const Trajectory truth = videos::truth_px(videos::clip(name)), marks = clicked(name);
    const SagittalModel model = sagittal_model(osim::load_osim(osim::default_model_file()));
    const Trajectory fitted = fitted_px(marks, model, calibrate(marks, model));
    ASSERT_EQ(fitted.frames.size(), truth.frames.size());
    double squared = 0;
    int points = 0;
    for (std::size_t i = 0; i < fitted.frames.size(); ++i) {
      if (!marks.frames[i][BodyPart::pelvis].present()) continue;  // its place is one mark's
      for (const BodyPart part :
           {BodyPart::knee_r, BodyPart::ankle_r, BodyPart::knee_l, BodyPart::ankle_l}) {
        squared += (fitted.frames[i][part].p_px - truth.frames[i][part].p_px).squaredNorm();
        ++points;
      }
      EXPECT_FALSE(fitted.frames[i][BodyPart::head].present());
    }
    EXPECT_LT(std::sqrt(squared / points), 2.0) << name;
  }
}

TEST(Fitted, PutsAJumperNearTheTruthInEveryFrame) {
  const videos::Clip clip = videos::clip("jump");
  const Trajectory truth = videos::truth_px(clip), marks = clicked("jump");
  const SagittalModel model = sagittal_model(osim::load_osim(osim::default_model_file()));
  const Calibration found = calibrate(marks, model);
  ASSERT_TRUE(found.ok()) << found.verdict.text();
  const Trajectory fitted = fitted_px(marks, model, found);
  double squared = 0;
  int points = 0;
  for (std::size_t i = 0; i < fitted.frames.size(); ++i) {
    if (!marks.frames[i][BodyPart::pelvis].present()) continue;
    for (const BodyPart part :
         {BodyPart::knee_r, BodyPart::ankle_r, BodyPart::knee_l, BodyPart::ankle_l}) {
      const Point& point = fitted.frames[i][part];
      squared += (point.p_px - truth.frames[i][part].p_px).squaredNorm();
      ++points;
      EXPECT_GT(point.confidence, 0.02);
      EXPECT_LE(point.confidence, 0.3);
    }
  }
  EXPECT_LT(std::sqrt(squared / points), 3.0);
}

TEST(Fitted, IsTheLessConfidentTheLessIsKnown) {
  const SagittalModel model = sagittal_model(osim::load_osim(osim::default_model_file()));
  const Trajectory marks = clicked("human");
  Trajectory few = marks;
  few.frames.resize(marks.frames.size() / 3);
  const auto mean = [&](const Trajectory& seen) {
    double sum = 0;
    const Trajectory fitted = fitted_px(seen, model, calibrate(seen, model));
    for (const TrajectoryFrame& frame : fitted.frames) {
      const double confidence = frame[BodyPart::ankle_l].confidence;
      EXPECT_GT(confidence, 0);
      EXPECT_LE(confidence, 0.3);
      sum += confidence;
    }
    return sum / static_cast<double>(fitted.frames.size());
  };
  EXPECT_LT(mean(few), 0.9 * mean(marks));
}

TEST(Fitted, IsWrittenForTheTracker) {
  const TemporaryFolder folder;
  save(clicked("human"), folder / "run.trajectory.csv");
  CLI::App app;
  add_calibrate_commands(app);
  app.parse(fmt::format("calibrate {0}/run.trajectory.csv --no-picture --fitted {0}/fitted.csv",
                        folder.path().string()));
  const Trajectory fitted = load_trajectory(folder / "fitted.csv");
  EXPECT_EQ(fitted.frames.size(), videos::truth_px(videos::clip("human")).frames.size());
}

TEST(Fitted, OfAJumpIsWrittenWithItsPicture) {
  const TemporaryFolder folder;
  const std::filesystem::path video = std::filesystem::path(STRIDE_SOURCE_DIR) / "videos/jump.mp4";
  Trajectory jump =
      observed(videos::clip("jump"), {.every_frame = true, .noise_px = 1.5, .seed = 3});
  jump.video_sha256 = sha256_of_file(video);
  save(jump, folder / "jump.trajectory.csv");
  CLI::App app;
  add_calibrate_commands(app);
  app.parse(
      fmt::format("calibrate {0}/jump.trajectory.csv --movement jump --fitted {0}/fitted.csv "
                  "--video {1}",
                  folder.path().string(), video.string()));
  EXPECT_EQ(load_trajectory(folder / "fitted.csv").frames.size(),
            videos::truth_px(videos::clip("jump")).frames.size());
  const std::string svg = read_file(folder / "jump.report.svg");
  for (const char* part : {"knee forward, m", "ankle angle, deg", "free fall", "data:image/jpeg"})
    EXPECT_NE(svg.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace stride
