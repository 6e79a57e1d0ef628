#include "videos/truth.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <opencv2/videoio.hpp>

namespace stride::videos {
namespace {

std::filesystem::path committed(const Clip& clip, const char* extension) {
  return std::filesystem::path(STRIDE_SOURCE_DIR) / "videos" / (clip.name + extension);
}

TEST(Truth, BesideEachClipIsWhatTheProgramComputes) {
  for (const Clip& clip : clips()) {
    const Trajectory file = load_trajectory(committed(clip, ".truth.csv")), fresh = truth_px(clip);
    ASSERT_EQ(file.frames.size(), fresh.frames.size()) << clip.name;
    for (std::size_t i = 0; i < file.frames.size(); ++i)
      for (const BodyPart part : kAskedParts)
        EXPECT_LT((file.frames[i][part].p_px - fresh.frames[i][part].p_px).norm(), 1e-3);
    EXPECT_EQ(file.direction, clip.to_left ? Facing::left : Facing::right);

    const Table file_m = load_table(committed(clip, ".truth_m.csv"), "truth", 1), m = truth_m(clip);
    ASSERT_EQ(file_m.columns, m.columns);
    for (std::size_t i = 0; i < m.rows.size(); ++i)
      for (std::size_t c = 0; c < m.columns.size(); ++c)
        EXPECT_NEAR(file_m.rows[i][c], m.rows[i][c], 2e-6) << clip.name << ' ' << m.columns[c];
    EXPECT_NEAR(file_m.meta_number("speed_m_s"), m.meta_number("speed_m_s"), 1e-9);
  }
}

TEST(Truth, BelongsToTheVideoBesideIt) {
  for (const Clip& clip : clips()) {
    const auto video = committed(clip, ".mp4");
    check_belongs_to(load_keypoints(committed(clip, ".keypoints.json")), video);
    cv::VideoCapture capture(video.string(), cv::CAP_FFMPEG);
    cv::Mat frame;
    int frames = 0;
    while (capture.read(frame)) ++frames;
    EXPECT_EQ(frames, clip.frames) << clip.name;
    EXPECT_NEAR(capture.get(cv::CAP_PROP_FPS), clip.rate_hz, 1e-9) << clip.name;
  }
}

TEST(Truth, InMetresIsTheTruthInPixelsUpToPerspective) {
  for (const Clip& clip : clips()) {
    const Trajectory px = truth_px(clip);
    const Table m = truth_m(clip);
    const double roll = m.meta_number("camera_roll_rad");
    const Eigen::Rotation2D<double> level(roll);
    for (std::size_t i = 0; i < m.rows.size(); ++i) {
      const double scale = m.rows[i][m.column("metres_per_pixel")];
      for (const BodyPart part : kAskedParts) {
        Eigen::Vector2d p = px.frames[i][part].p_px - px.frames[i][BodyPart::pelvis].p_px;
        p.x() *= clip.camera.pixel_aspect;
        p = scale * (level * p);
        const std::string prefix(name(part));
        const Eigen::Vector2d expected(m.rows[i][m.column(prefix + "_x")],
                                       m.rows[i][m.column(prefix + "_y")]);
        EXPECT_NEAR((clip.to_left ? -1 : 1) * p.x(), expected.x(), 0.02) << clip.name << prefix;
        EXPECT_NEAR(-p.y(), expected.y(), 0.02) << clip.name << prefix;
      }
    }
  }
}

TEST(Clicks, AreEightAStrideAsFarFromTheTruthAsAPersonsHand) {
  for (const Clip& clip : clips()) {
    const Keypoints keypoints = load_keypoints(committed(clip, ".keypoints.json"));
    const Trajectory truth = truth_px(clip);
    const double strides = clip.frames / clip.rate_hz / clip.gait.period_s;
    EXPECT_GE(strides, 4) << clip.name;
    EXPECT_NEAR(static_cast<double>(keypoints.frames.size()), 8 * strides, 1) << clip.name;
    double squares = 0;
    int count = 0;
    for (const auto& [number, frame] : keypoints.frames)
      for (const BodyPart part : kRequiredParts) {
        ASSERT_TRUE(frame.placed(part));
        squares += (frame[part]->p_px - truth.frames[number][part].p_px).squaredNorm() / 2;
        ++count;
      }
    EXPECT_NEAR(std::sqrt(squares / count), clip.click_sd_px, 0.13 * clip.click_sd_px) << clip.name;
  }
}

}  // namespace
}  // namespace stride::videos
