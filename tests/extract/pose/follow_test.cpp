#include "extract/pose/follow.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stride::pose {
namespace {

using Eigen::Vector2d;

constexpr double kSize_px = 200;

/// Somebody of whom the stand-ins for the networks know where he is. Frames are pictures whose
/// first pixel holds their number.
struct Actor {
  std::function<Vector2d(int frame)> hips;
  double stride_px = 0;  // swing of the ankles
  std::function<bool(int frame)> visible = [](int) { return true; };
};

cv::Mat frame_picture(int frame) {
  cv::Mat image(480, 640, CV_8UC3, cv::Scalar::all(0));
  image.at<cv::Vec3b>(0, 0)[0] = static_cast<unsigned char>(frame);
  return image;
}

PoseLandmarks body_of(const Actor& actor, int frame) {
  PoseLandmarks body;
  body.presence = 0.9;
  const Vector2d hips = actor.hips(frame);
  for (Landmark& landmark : body.landmarks) landmark.p_px = hips;
  const double swing = actor.stride_px * std::cos(0.25 * frame);
  body.landmarks[27].p_px += Vector2d(swing, 80);
  body.landmarks[28].p_px += Vector2d(-swing, 80);
  body.next = {hips, kSize_px, 0};
  return body;
}

Viewer viewer_of(const std::vector<Actor>& actors) {
  const auto near = [actors](const cv::Mat& image, const Vector2d& at, double reach_px) {
    const int frame = image.at<cv::Vec3b>(0, 0)[0];
    std::vector<PoseLandmarks> bodies;
    for (const Actor& actor : actors)
      if (actor.visible(frame) && (actor.hips(frame) - at).norm() < reach_px)
        bodies.push_back(body_of(actor, frame));
    std::ranges::sort(bodies, {},
                      [&](const PoseLandmarks& b) { return (b.next.centre_px - at).norm(); });
    return bodies;
  };
  return {[near](const cv::Mat& image, const Crop& region) {
            std::vector<Candidate> found;
            for (const PoseLandmarks& b : near(image, region.centre_px, region.size_px))
              found.push_back({b.next, 0.8});
            return found;
          },
          [near](const cv::Mat& image, const Crop& crop) {
            const std::vector<PoseLandmarks> bodies = near(image, crop.centre_px, crop.size_px / 2);
            return bodies.empty() ? PoseLandmarks{} : bodies.front();
          }};
}

std::vector<FollowedPerson> followed(const std::vector<Actor>& actors, int frames) {
  Viewer forward = viewer_of(actors), backward = viewer_of(actors);
  return follow_people({frames, frame_picture}, forward, backward);
}

Actor walking(double from_px, double step_px, double y_px) {
  return {[=](int frame) { return Vector2d(from_px + step_px * frame, y_px); }, 60};
}
Actor standing(double x_px, double y_px) {
  return {[=](int) { return Vector2d(x_px, y_px); }, 5};
}

bool is_at(const FollowedPerson& person, int frame, const Actor& actor) {
  const auto& body = person.frames[static_cast<std::size_t>(frame)];
  return body && (body->next.centre_px - actor.hips(frame)).norm() < 1;
}

TEST(FollowedPerson, IsSeenOnEveryFrameBothWaysFromTheBestOne) {
  const Actor runner = walking(50, 5, 200);
  const auto people = followed({runner}, 100);
  ASSERT_EQ(people.size(), 1U);
  EXPECT_EQ(people[0].seen, 100);
  for (int frame = 0; frame < 100; ++frame) EXPECT_TRUE(is_at(people[0], frame, runner));
}

TEST(FollowedPerson, IsFirstTheOneWhoMovesInStridesThoughOthersStandLonger) {
  Actor runner = walking(30, 6, 150);
  const auto people = followed({standing(500, 380), runner, standing(200, 380)}, 90);
  ASSERT_EQ(people.size(), 3U);
  EXPECT_TRUE(is_at(people[0], 45, runner));
  EXPECT_GT(people[0].striding, 60);
  EXPECT_EQ(people[1].striding, 0);
}

TEST(FollowedPerson, WhoWasLostIsFoundAgain) {
  Actor runner = walking(50, 4, 200);
  runner.visible = [](int frame) { return frame < 40 || frame > 52; };
  const auto people = followed({runner}, 100);
  ASSERT_EQ(people.size(), 1U);
  EXPECT_EQ(people[0].seen, 87);
  EXPECT_FALSE(people[0].frames[45]);
  EXPECT_TRUE(is_at(people[0], 53, runner));
}

TEST(FollowedPerson, IsNotReplacedByABystanderWhenTheRunnerLeaves) {
  Actor runner = walking(60, 12, 200);  // out of the picture after frame 48
  runner.visible = [](int frame) { return frame < 47; };
  const Actor bystander = standing(585, 240);
  const auto people = followed({runner, bystander}, 100);
  ASSERT_EQ(people.size(), 2U);
  for (int frame = 0; frame < 47; ++frame) EXPECT_TRUE(is_at(people[0], frame, runner));
  for (int frame = 50; frame < 100; ++frame)
    EXPECT_FALSE(people[0].frames[static_cast<std::size_t>(frame)]) << frame;
}

TEST(FollowedPerson, IsNobodyInAnEmptyPicture) { EXPECT_TRUE(followed({}, 20).empty()); }

TEST(FollowedPerson, ThrowsOnWhatTheNetworksThrow) {
  Viewer good = viewer_of({walking(50, 4, 200)}), bad = good;
  bad.look = [](const cv::Mat&, const Crop&) -> PoseLandmarks {
    throw std::runtime_error("broken");
  };
  EXPECT_THROW(follow_people({50, frame_picture}, good, bad), std::runtime_error);
}

}  // namespace
}  // namespace stride::pose
