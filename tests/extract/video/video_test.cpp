#include "extract/video/video.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

#include "extract/io/file.h"
#include "extract/video/repeated.h"
#include "extract/video/video_writer.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

const std::filesystem::path kClips = STRIDE_TEST_DATA;

/// Frame i is grey of brightness 20 + 4 i.
void write_ramp(const std::filesystem::path& file, int frames, cv::Size size, double rate_hz = 25) {
  video::VideoWriter writer(file, rate_hz);
  for (int i = 0; i < frames; ++i)
    writer.write(cv::Mat(size, CV_8UC3, cv::Scalar::all(20 + 4 * i)));
  writer.finish();
}

std::vector<video::VideoFrame> all_frames(video::Video& video) {
  std::vector<video::VideoFrame> frames;
  video::VideoFrame frame;
  while (video.read(frame)) frames.push_back(frame);
  return frames;
}

TEST(Video, HandsOutEveryFrameInOrderWithItsTime) {
  const TemporaryFolder folder;
  write_ramp(folder / "ramp.mp4", 50, {64, 48});
  video::Video video(folder / "ramp.mp4");
  EXPECT_EQ(video.info().width_px, 64);
  EXPECT_EQ(video.info().height_px, 48);
  EXPECT_NEAR(video.info().rate_hz, 25, 1e-9);
  const auto frames = all_frames(video);
  ASSERT_EQ(frames.size(), 50u);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(frames[i].index, i);
    EXPECT_NEAR(frames[i].time_s, i / 25.0, 1e-3);  // the last one too
    EXPECT_NEAR(cv::mean(frames[i].image)[0] - cv::mean(frames[0].image)[0], 4 * i, 1.5);
  }
  EXPECT_EQ(video.shortfall(), "");
}

TEST(Video, DividesTimeByTheSlowMotionFactor) {
  const TemporaryFolder folder;
  write_ramp(folder / "slow.mp4", 10, {64, 48});
  video::Video video(folder / "slow.mp4", 4);
  EXPECT_NEAR(video.info().rate_hz, 100, 1e-9);
  EXPECT_NEAR(all_frames(video).back().time_s, 9 / 100.0, 1e-3);
  EXPECT_ERROR(video::Video(folder / "slow.mp4", 0), "slow-motion factor = 0: must be positive");
}

TEST(Video, KeepsTheTimesOfAVariableRate) {
  video::Video video(kClips / "variable_rate.mp4");
  const auto frames = all_frames(video);
  const int shown[] = {0, 1, 3, 4, 5, 7, 8, 9, 11, 12, 13};
  ASSERT_EQ(frames.size(), std::size(shown));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    // The last two come out of the decoder without a stamp and continue with the last step.
    const double tolerance_s = i + 2 < frames.size() ? 1e-3 : 0.07;
    EXPECT_NEAR(frames[i].time_s, shown[i] / 30.0, tolerance_s) << i;
    if (i > 0) {
      EXPECT_GT(frames[i].time_s, frames[i - 1].time_s);
    }
  }
}

TEST(Video, WidensPixelsThatAreNotSquare) {
  video::Video video(kClips / "wide_pixels.mp4");
  EXPECT_EQ(video.info().stored_width_px, 48);
  EXPECT_EQ(video.info().width_px, 64);
  EXPECT_EQ(video.info().height_px, 32);
  for (const video::VideoFrame& frame : all_frames(video))
    EXPECT_EQ(frame.image.size(), cv::Size(64, 32));
}

TEST(Video, TurnsFramesUpright) {
  video::Video video(kClips / "wide_pixels_turned.mp4");
  EXPECT_EQ(video.info().height_px, 48);
  EXPECT_EQ(video.info().width_px, 24);  // 32 pixels, each 3/4 as wide as high once turned
}

TEST(Video, PadsOddSizesInsteadOfCuttingThem) {
  const TemporaryFolder folder;
  write_ramp(folder / "odd.mp4", 3, {65, 47});
  EXPECT_EQ(video::Video(folder / "odd.mp4").info().width_px, 66);
  EXPECT_EQ(video::Video(folder / "odd.mp4").info().height_px, 48);
}

TEST(Video, SaysWhatIsWrongWithAFile) {
  const TemporaryFolder folder;
  EXPECT_ERROR(video::Video(folder / "none.mp4"), "none.mp4: no such video");
  EXPECT_ERROR(video::Video(folder.path()), "is a folder, one video is needed");
  write_file_atomically(folder / "text.mp4", "this is not a video\n");
  EXPECT_ERROR(video::Video(folder / "text.mp4"), "text.mp4: not a video");
  write_file_atomically(folder / "empty.mp4", "");
  EXPECT_ERROR(video::Video(folder / "empty.mp4"), "empty.mp4: not a video");
}

TEST(Video, SaysHowManyFramesOfATruncatedFileWereReadable) {
  const TemporaryFolder folder;
  write_ramp(folder / "whole.mp4", 50, {64, 48});
  const std::string content = read_file(folder / "whole.mp4");
  write_file_atomically(folder / "cut.mp4", content.substr(0, content.find("moov") - 4));
  EXPECT_ERROR(video::Video(folder / "cut.mp4"), "cut.mp4: truncated: 0 frames readable");

  // The index is there and the frames behind it are not: as a download that was cut off.
  std::string hollow = content;
  const std::size_t data = content.find("mdat"), index = content.find("moov");
  ASSERT_LT(data, index);
  const std::size_t half = data + (index - data) / 2;
  std::fill(hollow.begin() + static_cast<long>(half), hollow.begin() + static_cast<long>(index) - 4,
            '\0');
  write_file_atomically(folder / "hollow.mp4", hollow);
  video::Video video(folder / "hollow.mp4");
  const auto frames = all_frames(video);
  EXPECT_LT(frames.size(), 50u);
  EXPECT_THAT(video.shortfall(),
              testing::HasSubstr(fmt::format("{} of the 50 announced frames", frames.size())));
}

TEST(Repeated, PlaysALoopAsOftenAsAsked) {
  const TemporaryFolder folder;
  write_ramp(folder / "loop.mp4", 6, {64, 48}, 12);
  video::write_repeated(folder / "loop.mp4", 3, folder / "long.mp4");
  video::Video video(folder / "long.mp4");
  const auto frames = all_frames(video);
  ASSERT_EQ(frames.size(), 18u);
  EXPECT_NEAR(frames[17].time_s, 17 / 12.0, 1e-3);
  for (const int i : {0, 6, 13})
    EXPECT_NEAR(cv::mean(frames[i].image)[0] - cv::mean(frames[0].image)[0], 4 * (i % 6), 2);
}

TEST(VideoWriter, LeavesNothingUnfinishedBehind) {
  const TemporaryFolder folder;
  {
    video::VideoWriter writer(folder / "out.mp4", 25);
    writer.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(9)));
    EXPECT_ERROR(writer.write(cv::Mat(48, 66, CV_8UC3)), "out.mp4: a frame of 66×48 px");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_ERROR(video::VideoWriter(folder / "out.avi", 25), "videos are written as .mp4");
  EXPECT_ERROR(video::VideoWriter(folder / "out.mp4", 0), "rate_hz = 0: must be positive");
}

}  // namespace
}  // namespace stride
