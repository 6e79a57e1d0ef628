#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "extract/commands.h"
#include "extract/io/file.h"
#include "extract/io/table.h"
#include "extract/skeleton/trajectory.h"
#include "extract/video/video.h"
#include "tests/support/environment_variable.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

namespace fs = std::filesystem;
const fs::path kVideos = STRIDE_SOURCE_DIR "/videos";

void run(const std::string& arguments) {
  CLI::App app;
  add_extract_commands(app);
  app.parse(arguments);
}

TEST(TrackCommand, WritesTheTrajectoryBesideTheVideoAndAnOverlay) {
  const TemporaryFolder folder;
  fs::copy(kVideos / "human.mp4", folder / "human.mp4");
  fs::copy(kVideos / "human.keypoints.json", folder / "human.keypoints.json");
  run(fmt::format("track {0}/human.mp4 --overlay {0}/seen.mp4", folder.path().string()));
  const Trajectory trajectory = load_trajectory(folder / "human.trajectory.csv");
  EXPECT_EQ(trajectory.video, "human.mp4");
  EXPECT_EQ(trajectory.width_px, 640);
  EXPECT_EQ(trajectory.video_sha256, sha256_of_file(folder / "human.mp4"));
  EXPECT_EQ(video::Video(folder / "seen.mp4").info().width_px, 640);
}

TEST(TrackCommand, ExportsWhatItImported) {
  const TemporaryFolder folder;
  std::string clicks =
      "frame,pelvis_x,pelvis_y,pelvis_confidence,knee_r_x,knee_r_y,"
      "knee_r_confidence\n";
  for (int frame = 4; frame <= 20; frame += 4)
    clicks += fmt::format("{},300,180,1,310,240,1\n", frame);
  write_file_atomically(folder / "clicks.csv", clicks);
  run(fmt::format("track {}/human.mp4 --import {}/clicks.csv --export {}/out.csv --no-flow",
                  kVideos.string(), folder.path().string(), folder.path().string()));
  const Table table = load_csv(folder / "out.csv");
  ASSERT_EQ(table.rows.size(), 17u);
  EXPECT_EQ(table.columns[0], "frame");
  EXPECT_EQ(table.columns[1], "time_s");
  EXPECT_EQ(table.rows.front()[0], 4);
  EXPECT_NEAR(table.rows.front()[table.column("knee_r_x")], 310, 0.5);
  EXPECT_FALSE(fs::exists(kVideos / "human.trajectory.csv"));
}

TEST(TrackCommand, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string here = folder.path().string();
  EXPECT_ERROR(run("track " + here + "/none.mp4"), "none.mp4: no such video");
  fs::copy(kVideos / "human.mp4", folder / "human.mp4");
  {
    const EnvironmentVariable home("XDG_DATA_HOME", here), machine("XDG_DATA_DIRS", here);
    EXPECT_ERROR(run("track " + here + "/human.mp4"), "click points with 'stride annotate");
    EXPECT_ERROR(run("track " + here + "/human.mp4"), "./setup.sh --pose fetches the pose network");
    EXPECT_ERROR(run("track " + here + "/human.mp4 --pose"), "no pose network is installed");
  }
  std::string turned = read_file(kVideos / "human.keypoints.json");
  turned.replace(turned.find("\"width_px\": 640"), 15, "\"width_px\": 641");
  write_file_atomically(folder / "human.keypoints.json", turned);
  EXPECT_ERROR(
      run("track " + here + "/human.mp4"),
      "human.keypoints.json: the clicks lie on a picture of 641 x 360 px, the video is 640");
  EXPECT_ERROR(
      run("annotate " + here + "/human.mp4 --script none"),
      "human.keypoints.json: the clicks lie on a picture of 641 x 360 px, the video is 640");
  for (const char* option :
       {"--format coco", "--y-up 360", "--import-rate 30", "--points-size 1 1", "--first-frame 1",
        "--labels knee_r=a", "--min-confidence 0.5", "--pose-box 1 2 3 4", "--pose-config a.toml"})
    EXPECT_ERROR(run(fmt::format("track {}/human.mp4 {}", here, option)), "has no effect without");
  EXPECT_ERROR(run("track " + here + "/human.mp4 --export " + here + "/a.docx"),
               "a.docx: format 'docx' cannot be written");
  write_file_atomically(folder / "human.keypoints.json",
                        read_file(kVideos / "human.keypoints.json"));
  for (const char* option : {"--person 2", "--no-leg-repair"})
    EXPECT_ERROR(run(fmt::format("track {}/human.mp4 {}", here, option)),
                 "has no effect on clicks");
  for (const char* option : {"-o a.csv", "--person 2", "--no-flow", "--slow-motion 2"})
    EXPECT_ERROR(
        run(fmt::format("track {0}/human.mp4 --score {0}/human.truth.csv {1}", here, option)),
        "has no effect with --score");
  std::string clicks = read_file(kVideos / "human.keypoints.json");
  clicks.replace(clicks.find("\"video_sha256\": \"") + 17, 4, "ffff");
  write_file_atomically(folder / "human.keypoints.json", clicks);
  EXPECT_ERROR(run("track " + here + "/human.mp4"),
               "is another video than the one that was clicked");
  write_file_atomically(folder / "far.csv",
                        "frame,pelvis_x,pelvis_y,pelvis_confidence\n5,1,1,1\n500,1,1,1\n");
  EXPECT_ERROR(run("track " + here + "/human.mp4 --import " + here + "/far.csv"),
               "has points to frame 500, but the video has 96 frames");
}

}  // namespace
}  // namespace stride
