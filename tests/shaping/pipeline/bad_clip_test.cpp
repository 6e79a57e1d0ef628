// Clips that `stride convert` must refuse or flag: small videos with clicks, each spoilt in one
// respect, from the file to the potential.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>

#include "extract/io/file.h"
#include "extract/skeleton/keypoints.h"
#include "extract/video/video.h"
#include "extract/video/video_writer.h"
#include "shaping/pipeline/convert.h"
#include "shaping/potential.h"
#include "tests/support/temporary_folder.h"

namespace stride {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr int kFrames = 60;

struct BadClip {
  std::vector<cv::Mat> frames;
  Keypoints clicks;
  double rate_hz = 24;

  int width() const { return frames[0].cols; }
  int height() const { return frames[0].rows; }
};

/// The jogger of small.mp4 in side view: three strides.
BadClip jogger() {
  static const BadClip good = [] {
    const auto file = std::filesystem::path(STRIDE_SOURCE_DIR) / "videos" / "small.mp4";
    BadClip clip;
    clip.clicks = load_keypoints(keypoints_file_of(file));
    video::Video video(file);
    video::VideoFrame frame;
    while (clip.frames.size() < kFrames && video.read(frame))
      clip.frames.push_back(frame.image.clone());
    auto& clicked = clip.clicks.frames;
    clicked.erase(clicked.lower_bound(kFrames), clicked.end());
    return clip;
  }();
  BadClip copy = good;
  for (cv::Mat& frame : copy.frames) frame = frame.clone();
  return copy;
}

/// The verdict of `stride convert`, which the potential repeats if there is one.
std::string verdict_of(BadClip clip) {
  const TemporaryFolder folder;
  const auto file = folder / "clip.mp4";
  video::VideoWriter writer(file, clip.rate_hz);
  for (const cv::Mat& frame : clip.frames) writer.write(frame);
  writer.finish();
  clip.clicks.video = "clip.mp4";
  clip.clicks.video_sha256 = sha256_of_file(file);
  for (auto& [number, frame] : clip.clicks.frames) frame.time_s = number / clip.rate_hz;
  save(clip.clicks, keypoints_file_of(file));
  pipeline::ConvertOptions options;
  options.out = folder / "out";
  options.pictures = false;
  const pipeline::Converted converted = pipeline::convert({file}, options)[0];
  const auto potential = folder / "out" / "clip.potential.json";
  EXPECT_EQ(std::filesystem::exists(potential), !converted.failed);
  if (!converted.failed) {
    EXPECT_EQ(load_potential(potential).verdict, converted.verdict);
  }
  return converted.verdict;
}

/// Every click at `where(x, y)`; a click that falls outside the frame is taken away.
template <typename Where>
void move_clicks(BadClip& clip, Where where) {
  for (auto& [number, frame] : clip.clicks.frames)
    for (auto& click : frame.clicks) {
      if (!click) continue;
      click->p_px = where(click->p_px);
      const Eigen::Vector2d& p = click->p_px;
      if (p.minCoeff() < 0 || p.x() > clip.width() - 1 || p.y() > clip.height() - 1) click.reset();
    }
}

void shift(cv::Mat& image, double by_px) {
  cv::warpAffine(image.clone(), image, cv::Matx23d(1, 0, by_px, 0, 1, 0), image.size(),
                 cv::INTER_NEAREST, cv::BORDER_REPLICATE);
}

/// The same runner in the other direction.
BadClip mirrored(BadClip clip) {
  for (cv::Mat& frame : clip.frames) cv::flip(frame.clone(), frame, 1);
  move_clicks(clip, [&](const Eigen::Vector2d& p) {
    return Eigen::Vector2d(clip.width() - 1 - p.x(), p.y());
  });
  for (auto& [number, frame] : clip.clicks.frames) {
    const ClickedFrame before = frame;
    for (const BodyPart part : kBodyParts) frame[part] = before[mirrored(part)];
  }
  return clip;
}

TEST(BadClip, TheGoodOneIsFine) { EXPECT_EQ(verdict_of(jogger()), "ok"); }

TEST(BadClip, OneLegOnlyIsRefused) {
  BadClip clip = jogger();
  for (auto& [number, frame] : clip.clicks.frames)
    for (const BodyPart part : {BodyPart::knee_l, BodyPart::ankle_l, BodyPart::toe_l})
      frame[part].reset();
  EXPECT_THAT(verdict_of(clip), StartsWith("refused: knee_l is seen in no frame"));
}

TEST(BadClip, ARunTowardsTheCameraIsRefused) {
  BadClip clip = jogger();
  const double narrow = 0.15, middle = clip.width() / 2.0;
  for (cv::Mat& frame : clip.frames)
    cv::warpAffine(frame.clone(), frame, cv::Matx23d(narrow, 0, (1 - narrow) * middle, 0, 1, 0),
                   frame.size(), cv::INTER_AREA, cv::BORDER_REPLICATE);
  move_clicks(clip, [&](const Eigen::Vector2d& p) {
    return Eigen::Vector2d(middle + narrow * (p.x() - middle), p.y());
  });
  EXPECT_THAT(verdict_of(clip), AllOf(StartsWith("refused: "), HasSubstr("from the side")));
}

TEST(BadClip, SomebodyWhoStandsIsRefused) {
  BadClip clip = jogger();
  for (cv::Mat& frame : clip.frames) frame = clip.frames[0];
  for (auto& [number, frame] : clip.clicks.frames) frame = clip.clicks.frames.begin()->second;
  EXPECT_THAT(verdict_of(clip), AllOf(StartsWith("refused: "), HasSubstr("nobody runs here")));
}

TEST(BadClip, TwoPeopleWhoCrossAreToldOrRefused) {
  BadClip clip = jogger();
  const BadClip other = mirrored(clip);
  for (std::size_t i = 0; i < clip.frames.size(); ++i)
    cv::max(clip.frames[i], other.frames[i], clip.frames[i]);
  // In the middle third the clicks are on the runner in the other direction.
  for (auto& [number, frame] : clip.clicks.frames)
    if (number >= kFrames / 3 && number < kFrames * 2 / 3) frame = other.clicks.frames.at(number);
  EXPECT_THAT(verdict_of(clip), HasSubstr("person"));
}

TEST(BadClip, ACutIsTold) {
  // The camera stands elsewhere in the second half, and half a second is missing.
  BadClip clip = jogger();
  const BadClip before = clip;
  const int cut = kFrames / 2, missing = 12;
  const double by_px = -60;
  clip.clicks.frames.erase(clip.clicks.frames.lower_bound(cut), clip.clicks.frames.end());
  clip.frames.resize(cut);
  for (int i = cut + missing; i < kFrames; ++i) {
    clip.frames.push_back(before.frames[static_cast<std::size_t>(i)]);
    shift(clip.frames.back(), by_px);
    const auto clicked = before.clicks.frames.find(i);
    if (clicked == before.clicks.frames.end()) continue;
    ClickedFrame& frame = clip.clicks.frames[i - missing] = clicked->second;
    for (auto& click : frame.clicks)
      if (click) click->p_px.x() += by_px;
  }
  EXPECT_THAT(verdict_of(clip),
              HasSubstr("background changes at frame " + std::to_string(cut) + ": a cut"));
}

TEST(BadClip, BlackFramesAreTold) {
  BadClip clip = jogger();
  for (int i = 20; i < 40; ++i) {
    clip.frames[static_cast<std::size_t>(i)].setTo(0);
    clip.clicks.frames.erase(i);
  }
  EXPECT_THAT(verdict_of(clip), HasSubstr("nothing is seen between frames"));
}

TEST(BadClip, AClipOnItsHeadIsRefused) {
  BadClip clip = jogger();
  for (cv::Mat& frame : clip.frames) cv::flip(frame.clone(), frame, 0);
  move_clicks(clip, [&](const Eigen::Vector2d& p) {
    return Eigen::Vector2d(p.x(), clip.height() - 1 - p.y());
  });
  EXPECT_THAT(verdict_of(clip), StartsWith("refused: knees are above the pelvis"));
}

TEST(BadClip, AClipTurnedByNinetyDegreesIsRefused) {
  BadClip clip = jogger();
  const int height = clip.height();
  for (cv::Mat& frame : clip.frames) cv::rotate(frame.clone(), frame, cv::ROTATE_90_CLOCKWISE);
  std::swap(clip.clicks.width_px, clip.clicks.height_px);
  move_clicks(clip,
              [&](const Eigen::Vector2d& p) { return Eigen::Vector2d(height - 1 - p.y(), p.x()); });
  EXPECT_THAT(verdict_of(clip), StartsWith("refused: the legs lie level"));
}

TEST(BadClip, SlowMotionThatNobodyToldIsFoundAndNamed) {
  BadClip clip = jogger();
  clip.rate_hz /= 4;
  EXPECT_THAT(verdict_of(clip), HasSubstr("is it slow motion by about 4"));
}

TEST(BadClip, LessThanAStrideIsRefusedAndLittleMoreIsTold) {
  BadClip clip = jogger();
  const auto keep = [&](int frames) {
    clip.frames.resize(static_cast<std::size_t>(frames));
    clip.clicks.frames.erase(clip.clicks.frames.lower_bound(frames), clip.clicks.frames.end());
  };
  keep(26);
  EXPECT_THAT(verdict_of(clip), StartsWith("ok, but only 1."));
  keep(15);
  EXPECT_THAT(verdict_of(clip), StartsWith("refused: "));
}

TEST(BadClip, AWrongFrameRateIsTold) {
  for (const double factor : {0.4, 2.5}) {
    BadClip clip = jogger();
    clip.rate_hz *= factor;
    EXPECT_THAT(verdict_of(clip), HasSubstr("is the frame rate"));
  }
}

TEST(BadClip, WrongKeypointsAreRefused) {
  BadClip clip = jogger();
  std::mt19937_64 random(5);
  move_clicks(clip, [&](const Eigen::Vector2d&) {
    return Eigen::Vector2d(static_cast<double>(random() % 320),
                           static_cast<double>(random() % 180));
  });
  EXPECT_THAT(verdict_of(clip), StartsWith("refused: "));
  clip = jogger();
  for (auto& [number, frame] : clip.clicks.frames) {
    std::swap(frame[BodyPart::knee_r], frame[BodyPart::ankle_r]);
    std::swap(frame[BodyPart::knee_l], frame[BodyPart::ankle_l]);
  }
  EXPECT_THAT(verdict_of(clip), StartsWith("refused: "));
}

}  // namespace
}  // namespace stride
