#include "extract/skeleton/trajectory.h"

#include <gtest/gtest.h>

#include "extract/io/file.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

TEST(Trajectory, ReadsBackWhatWasSaved) {
  const TemporaryFolder folder;
  Trajectory trajectory;
  trajectory.video = "a.mp4";
  trajectory.video_sha256 = "00";
  trajectory.width_px = 640;
  trajectory.height_px = 360;
  trajectory.rate_hz = 29.97;
  trajectory.direction = Facing::left;
  trajectory.frames.resize(2);
  trajectory.frames[0][BodyPart::knee_r] = {{1.25, 2.5}, Source::tracked, 0.75};
  trajectory.frames[1].frame = 1;
  trajectory.frames[1].time_s = 1 / 29.97;
  save(trajectory, folder / "t.csv");
  const Trajectory loaded = load_trajectory(folder / "t.csv");
  EXPECT_EQ(loaded.direction, Facing::left);
  EXPECT_EQ(loaded.frames[0][BodyPart::knee_r].p_px, Eigen::Vector2d(1.25, 2.5));
  EXPECT_EQ(loaded.frames[0][BodyPart::knee_r].confidence, 0.75);
  EXPECT_FALSE(loaded.frames[0][BodyPart::knee_l].present());
  EXPECT_EQ(loaded.frames[1].time_s, 1 / 29.97);
}

TEST(Trajectory, ReadsBackEveryPart) {
  for (const BodyPart part : kBodyParts) {
    const TemporaryFolder folder;
    Trajectory trajectory;
    trajectory.rate_hz = 30;
    trajectory.frames.resize(1);
    trajectory.frames[0][part] = {{1.25, 2.5}, Source::tracked, 0.75};
    save(trajectory, folder / "t.csv");
    const Trajectory loaded = load_trajectory(folder / "t.csv");
    for (const BodyPart other : kBodyParts)
      EXPECT_EQ(loaded.frames[0][other].present(), other == part) << name(other);
    EXPECT_EQ(loaded.frames[0][part].p_px, Eigen::Vector2d(1.25, 2.5)) << name(part);
  }
}

TEST(Trajectory, RefusesSizesAndFramesThatAreNoWholeNumbers) {
  const TemporaryFolder folder;
  const auto load = [&](const char* width, const char* row) {
    write_file_atomically(
        folder / "t.csv",
        fmt::format("# stride trajectory 1\n# unit: px\n# video: a\n# video_sha256: 0\n# width_px: "
                    "{}\n# height_px: 9\n# rate_hz: 30\n# direction: \nframe,time_s\n{}\n",
                    width, row));
    return load_trajectory(folder / "t.csv");
  };
  EXPECT_EQ(load("640", "3,0.1").frames[0].frame, 3);
  EXPECT_ERROR(load("", "3,0.1"), "t.csv: width_px = nan: must be a whole number");
  EXPECT_ERROR(load("640", ",0.1"), "t.csv: frame = nan: must be a whole number");
  EXPECT_ERROR(load("640", "3,inf"), "frame 3: time_s = inf: must grow");
}

TEST(Trajectory, RefusesWhatNoVideoHas) {
  const TemporaryFolder folder;
  const auto load = [&](const std::string& direction, const std::string& rows) {
    write_file_atomically(folder / "t.csv",
                          "# stride trajectory 1\n# unit: px\n# video: a\n# video_sha256: 0\n"
                          "# width_px: 9\n# height_px: 9\n# rate_hz: 30\n# direction: " +
                              direction + "\nframe,time_s,knee_r_x,knee_r_y,knee_r_confidence\n" +
                              rows);
    return load_trajectory(folder / "t.csv");
  };
  EXPECT_EQ(load("left", "0,0,1,2,1\n1,0.03,1,2,0\n").frames.size(), 2u);
  EXPECT_ERROR(load("Left", "0,0,1,2,1\n"), "direction = Left: must be right or left");
  EXPECT_ERROR(load("\n# treadmill: maybe", "0,0,1,2,1\n"), "treadmill = maybe: must be true or");
  EXPECT_ERROR(load("", ""), "t.csv: has no frames");
  EXPECT_ERROR(load("", "0,0,1,2,1\n1,33.3,1,2,1\n"), "time_s grows by 33.3 from frame to frame");
  EXPECT_ERROR(load("", "0,0,1,2,1\n1,1e-5,1,2,1\n"), "times must be in s");
  EXPECT_ERROR(load("", "0,0,1,2e9,1\n"), "frame 0: knee_r = (1, 2e+09): lies in no picture");
  EXPECT_ERROR(load("", "0,0,1,2,7\n"), "knee_r_confidence = 7: must be in [0, 1]");
  EXPECT_ERROR(load("", "0,0,1,2,-1\n"), "knee_r_confidence = -1: must be in [0, 1]");
  EXPECT_ERROR(load("", std::string("0,0,1\0,2,1\n", 12)), "t.csv: line 10, column 6: a NUL");
}

}  // namespace
}  // namespace stride
