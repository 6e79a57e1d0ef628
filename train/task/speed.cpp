#include <algorithm>
#include <cmath>

#include "extract/io/error.h"
#include "train/task/tasks.h"

namespace stride::task {
namespace {

double mean_squared(const std::array<double, simulation::kMuscles>& activation) {
  double sum = 0;
  for (const double each : activation) sum += each * each;
  return sum / simulation::kMuscles;
}

class Speed final : public Task {
 public:
  /// `bearing_N`: what a foot on the ground bears at least; 0: the ground does not matter.
  Speed(const TaskOptions& options, double bearing_N)
      : wanted_m_s_(options.speed_m_s), effort_m_s_(options.effort), bearing_N_(bearing_N) {
    require(options.speed_m_s > 0 && options.speed_m_s <= 12,
            "task.speed_m_s = {}: must be in (0, 12]", options.speed_m_s);
    require(options.effort >= 0 && options.effort <= 100, "task.effort = {}: must be in [0, 100]",
            options.effort);
  }

  void start(const Moment&) override { measure_m_ = 0; }

  Outcome step(const Moment& moment) override {
    const double v = moment.competition.forward / moment.step_s;
    const auto& [right, left] = moment.kinematics.ground_reaction_N;
    const bool flies = bearing_N_ > 0 && std::max(right.y, left.y) < bearing_N_;
    const double useful_m =
        moment.step_s * (flies ? -wanted_m_s_ : wanted_m_s_ - std::abs(v - wanted_m_s_));
    measure_m_ += useful_m;
    const double effort_m = moment.step_s * effort_m_s_ * mean_squared(moment.state.activation);
    return {useful_m - effort_m + moment.competition.ligament,
            competition::has_fallen(moment.state) ? End::fall : End::none};
  }

  double measure_m() const override { return measure_m_; }

 private:
  double wanted_m_s_, effort_m_s_, bearing_N_;
  double measure_m_ = 0;
};

}  // namespace

std::unique_ptr<Task> speed(const TaskOptions& options, const osim::Model&) {
  return std::make_unique<Speed>(options, 0);
}

std::unique_ptr<Task> walk(const TaskOptions& options, const osim::Model& model) {
  return std::make_unique<Speed>(options, bearing_N(model));
}

}  // namespace stride::task
