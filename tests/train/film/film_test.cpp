#include "train/film/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "calibrate/osim/model.h"
#include "tests/support/throws.h"
#include "train/simulation/make_engine.h"

namespace stride {
namespace {

/// Right leg in front, left foot behind, as in running.
film::RunnerPicture running(const osim::Model& model) {
  const auto engine = simulation::make_engine("simbody", model);
  simulation::RunnerState state = simulation::default_state(model);
  state.q = {-0.1, 12.3, 0.93, 0.7, -0.9, 0.1, -0.2, -1.2, -0.2};
  state.u[simulation::kPelvisX] = 3.5;
  engine->set_state(state);
  film::RunnerPicture picture{engine->state(), engine->kinematics(), {}};
  return picture;
}

const osim::Model& runner() {
  static const osim::Model model = osim::load_osim(osim::default_model_file());
  return model;
}

cv::Vec3b colour_at(const cv::Mat& frame, simulation::PlanarVector p) {
  return frame.at<cv::Vec3b>(static_cast<int>(std::lround(p.y)),
                             static_cast<int>(std::lround(p.x)));
}

/// Reddish or bluish pixels.
int count(const cv::Mat& frame, bool red) {
  int sum = 0;
  for (int v = 0; v < frame.rows; ++v)
    for (int u = 0; u < frame.cols; ++u) {
      const auto pixel = frame.at<cv::Vec3b>(v, u);
      sum += red ? pixel[2] > pixel[0] + 110 : pixel[0] > pixel[2] + 90;
    }
  return sum;
}

TEST(Film, ShowsJointsWhereTheSimulationHasThem) {
  const film::RunnerPicture picture = running(runner());
  const film::FilmModel model = film::film_model(runner());
  const film::FilmOptions options;
  const cv::Mat frame = film::film_frame(model, picture, options);
  ASSERT_EQ(frame.size(), cv::Size(640, 360));
  // A near joint is a bright disc of 1.2 cm with a darker rim.
  for (const int body : {model.legs[0].tibia, model.legs[0].talus}) {
    const simulation::PlanarVector p =
        film::film_place(picture, options, picture.kinematics.bodies[body].position);
    EXPECT_GT(cv::norm(colour_at(frame, p)), 320) << body;
    EXPECT_LT(cv::norm(colour_at(frame, {p.x + 2.6, p.y})), cv::norm(colour_at(frame, p)));
  }
}

TEST(Film, ShowsActiveMusclesRedAndRelaxedOnesBlue) {
  film::RunnerPicture picture = running(runner());
  const film::FilmModel model = film::film_model(runner());
  picture.kinematics.ground_reaction_N = {};
  picture.state.activation.fill(0.02);
  const cv::Mat relaxed = film::film_frame(model, picture);
  picture.state.activation.fill(1);
  const cv::Mat active = film::film_frame(model, picture);
  EXPECT_GT(count(active, true), 3 * count(relaxed, true) + 500);
  EXPECT_GT(count(relaxed, false), 3 * count(active, false) + 500);
}

TEST(Film, ShowsObstaclesAndTheGroundMovingUnderTheRunner) {
  film::RunnerPicture picture = running(runner());
  const film::FilmModel model = film::film_model(runner());
  const film::FilmOptions options;
  const cv::Mat without = film::film_frame(model, picture, options);
  picture.obstacles = {{13.6, 0.02, 0.1}};
  const cv::Mat with = film::film_frame(model, picture, options);
  const simulation::PlanarVector p = film::film_place(picture, options, {13.6, 0.05});
  EXPECT_GT(cv::norm(colour_at(with, p), colour_at(without, p)), 40);
  // The same pose half a metre ahead: another position on the ground, the same in the picture.
  picture.obstacles.clear();
  picture.state.q[simulation::kPelvisX] += 0.5;
  for (auto& body : picture.kinematics.bodies) body.position.x += 0.5;
  const cv::Mat later = film::film_frame(model, picture, options);
  const cv::Rect ground(0, 320, 640, 20), trunk(300, 90, 40, 60);
  EXPECT_GT(cv::norm(later(ground), without(ground), cv::NORM_L1), 1e4);
  EXPECT_EQ(cv::norm(later(trunk), without(trunk), cv::NORM_INF), 0);
}

TEST(Film, NamesTheBodyThatAModelLacks) {
  osim::Model model = runner();
  model.bodies[model.body("toes_l")].name = "paw";
  EXPECT_ERROR(film::film_model(model), "toes_l");
}

}  // namespace
}  // namespace stride
