#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "extract/io/random.h"
#include "shaping/potential.h"
#include "train/environment/environment.h"

namespace stride {

/// A point mass on a line that should come to rest at 0: x″ = 4a − 2 under the action a in [0, 1],
/// reward −x² − 0.1 v² a second. It falls off the line beyond ±2 and has 2 s of time.
class PointMass : public environment::Environment {
 public:
  PointMass() {
    spec_ = {
        .observation_names = {"x", "v"}, .action_names = {"push"}, .step_s = 0.05, .max_steps = 40};
  }

  const environment::EnvironmentSpec& spec() const override { return spec_; }

  const Eigen::VectorXd& reset(std::uint64_t seed) override {
    Random random(seed);
    x_ = 2 * uniform(random) - 1;
    v_ = 0;
    steps_ = 0;
    return observe();
  }

  const environment::Step& step(const Eigen::VectorXd& action) override {
    const double h = spec_.step_s;
    v_ += h * (4 * std::clamp(action[0], 0.0, 1.0) - 2);
    x_ += h * v_;
    ++steps_;
    step_.reward = -h * (x_ * x_ + 0.1 * v_ * v_);
    step_.terminated = std::abs(x_) > 2;
    if (step_.terminated) step_.reward -= 2;
    step_.truncated = !step_.terminated && steps_ == spec_.max_steps;
    observe();
    return step_;
  }

  Pose pose() const override {
    return {{1 + x_, 0.1 * x_, -0.4, 0.2 * v_, -0.8, -0.1 * x_, -0.4, 0.1, -0.8 + 0.1 * v_}};
  }
  Pose pose_velocity() const override { return {{v_, 0.1 * v_, 0, 0, 0, -0.1 * v_, 0, 0, 0}}; }
  double time_s() const override { return steps_ * spec_.step_s; }
  double distance_m() const override { return -std::abs(x_); }  // from the goal: higher is better

 private:
  const Eigen::VectorXd& observe() {
    step_.observation.resize(2);
    step_.observation[0] = x_;
    step_.observation[1] = v_;
    return step_.observation;
  }

  environment::EnvironmentSpec spec_;
  environment::Step step_;
  double x_ = 0, v_ = 0;
  int steps_ = 0;
};

inline std::unique_ptr<environment::Environment> point_mass(int) {
  return std::make_unique<PointMass>();
}

/// Eight poses of no runner.
inline Potential point_mass_potential() {
  Potential potential;
  potential.source = "test";
  potential.model = "point mass";
  potential.period_s = 0.7;
  potential.weight = 0.01;
  for (int k = 0; k < 8; ++k) {
    Keyframe key;
    key.phase = k / 8.0;
    key.pose = {{1, 0.02 * k, -0.4, 0.1, -0.8, -0.02 * k, -0.4, 0.1, -0.8 + 0.01 * k}};
    potential.keyframes.push_back(key);
  }
  return potential;
}

}  // namespace stride
