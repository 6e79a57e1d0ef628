#pragma once

#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "calibrate/osim/model.h"
#include "train/simulation/engine/engine.h"
#include "train/simulation/engine/runner_layout.h"
#include "train/simulation/laws/path.h"

namespace stride::film {

/// The simulated runner in one frame.
struct RunnerPicture {
  simulation::RunnerState state;
  simulation::RunnerKinematics kinematics;  // of that state
  std::vector<simulation::Obstacle> obstacles;
};

struct FilmOptions {
  int width_px = 640, height_px = 360;
  double metres_high = 2.35;  // what the picture's height shows
  std::string title;          // in the upper right corner
};

/// The parts of a model that are drawn.
struct FilmModel {
  struct LegBodies {
    int femur = -1, tibia = -1, talus = -1, calcn = -1, toes = -1;  // indices into Model::bodies
  };
  int pelvis = -1, torso = -1, head = -1;
  std::array<LegBodies, 2> legs;  // right, left
  struct DrawnMuscle {
    laws::PathLaw path;
    int side = 0;           // 0 right, 1 left
    double belly_m = 0.02;  // half the width of its thickest place
  };
  std::vector<DrawnMuscle> muscles;  // in the order of RunnerState::activation
  std::vector<osim::ContactSphere> spheres;
  std::vector<double> default_coordinates;  // of Model::coordinates
  simulation::RunnerLayout layout;
};

/// Throws Error naming the body, muscle or coordinate that the model lacks.
FilmModel film_model(const osim::Model& model);

/// Draws the runner from its right side, the camera following: bones and joints, feet with their
/// contact spheres, muscles along their paths from blue (relaxed) to red (active), the force of the
/// ground on each foot, a ground with a tick every metre, obstacles, and time, distance and speed.
/// BGR, 8 bit.
cv::Mat film_frame(const FilmModel& model, const RunnerPicture& picture,
                   const FilmOptions& options = {});

/// Projects a point in axes of the ground into that frame, px.
simulation::PlanarVector film_place(const RunnerPicture& picture, const FilmOptions& options,
                                    simulation::PlanarVector p_m);

}  // namespace stride::film
