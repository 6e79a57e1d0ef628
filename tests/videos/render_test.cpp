#include "videos/render.h"

#include <gtest/gtest.h>

#include "videos/costume.h"
#include "videos/truth.h"
#include "videos/variant.h"

namespace stride::videos {
namespace {

// The truth projects points; the painter maps pixels back. They meet in the picture.
TEST(Render, PaintsEveryPartWhereTheTruthSays) {
  Clip clip = stride::videos::clip("human");
  clip.character = "markers";
  clip.scene = "dark";
  clip.noise_grey = clip.vignette = clip.shutter = 0;
  clip.samples = 24;
  const Renderer renderer(clip);
  const Trajectory truth = truth_px(clip);
  for (const int index : {0, 31, 80}) {
    const cv::Mat picture = renderer.frame(index);
    for (const BodyPart part :
         {BodyPart::pelvis, BodyPart::head, BodyPart::ankle_r, BodyPart::toe_l}) {
      const Eigen::Vector2d p = truth.frames[index][part].p_px;
      Eigen::Vector2d sum(0, 0);
      double weight = 0;
      for (int v = static_cast<int>(p.y()) - 7; v <= p.y() + 7; ++v)
        for (int u = static_cast<int>(p.x()) - 7; u <= p.x() + 7; ++u) {
          const double blue = picture.at<cv::Vec3b>(v, u)[0];
          sum += blue * Eigen::Vector2d(u, v);
          weight += blue;
        }
      EXPECT_GT(weight, 255 * 20) << name(part);
      EXPECT_LT((sum / weight - p).norm(), 0.12) << name(part) << " of frame " << index;
    }
  }
}

TEST(Render, GivesTheSamePictureForTheSameSeedOnly) {
  Clip clip = resized(stride::videos::clip("human"), 0.5);
  clip.samples = 2;
  const cv::Mat picture = Renderer(clip).frame(5), again = Renderer(clip).frame(5);
  EXPECT_EQ(cv::norm(picture, again, cv::NORM_INF), 0);
  clip.seed += 1;
  EXPECT_GT(cv::norm(picture, Renderer(clip).frame(5), cv::NORM_L1), 0);
}

TEST(Render, ShowsARunnerWhereTheTruthSays) {
  Clip clip = resized(stride::videos::clip("human"), 0.5);
  clip.samples = 4;
  const int index = 12;
  const cv::Mat with = Renderer(clip).frame(index);
  clip.character = "markers";
  const cv::Mat without = Renderer(clip).frame(index);
  const Trajectory truth = truth_px(clip);
  // Between two joints lies a limb, which the same scene with markers alone does not have.
  const auto& frame = truth.frames[index];
  const Eigen::Vector2d thigh = 0.5 * (frame[BodyPart::hip_r].p_px + frame[BodyPart::knee_r].p_px);
  const cv::Point at(static_cast<int>(thigh.x()), static_cast<int>(thigh.y()));
  EXPECT_GT(cv::norm(with.at<cv::Vec3b>(at), without.at<cv::Vec3b>(at)), 20);
}

}  // namespace
}  // namespace stride::videos
