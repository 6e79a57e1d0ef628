#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "extract/io/error.h"
#include "train/task/tasks.h"

namespace stride::task {
namespace {

double mean_squared(const std::array<double, simulation::kMuscles>& activation) {
  double sum = 0;
  for (const double each : activation) sum += each * each;
  return sum / simulation::kMuscles;
}

/// The ground under the feet.
class Ground {
 public:
  explicit Ground(const osim::Model& model)
      : heels_{model.body("calcn_r"), model.body("calcn_l")},
        toes_{model.body("toes_r"), model.body("toes_l")},
        bearing_N_(bearing_N(model)) {}

  bool touched(const simulation::RunnerKinematics& kinematics) const {
    const auto& [right, left] = kinematics.ground_reaction_N;
    return std::max(right.y, left.y) >= bearing_N_;
  }

  /// Of both feet together, weighted by what they bear up to the least that counts as bearing.
  double slip_m_s(const simulation::RunnerKinematics& kinematics) const {
    const auto speed = [&](int body) {
      return std::abs(kinematics.bodies[static_cast<std::size_t>(body)].velocity.x);
    };
    double slip = 0;
    for (std::size_t side = 0; side < 2; ++side) {
      const double bears = kinematics.ground_reaction_N[side].y / bearing_N_;
      slip += std::clamp(bears, 0.0, 1.0) * std::min(speed(heels_[side]), speed(toes_[side]));
    }
    return slip;
  }

 private:
  std::array<int, 2> heels_, toes_;  // indices into Model::bodies
  double bearing_N_;
};

class Speed final : public Task {
 public:
  /// Without `ground` it does not matter.
  Speed(const TaskOptions& options, std::optional<Ground> ground)
      : wanted_m_s_(options.speed_m_s),
        effort_m_s_(options.effort),
        slip_(options.slip),
        ground_(ground) {
    require(options.speed_m_s > 0 && options.speed_m_s <= 12,
            "task.speed_m_s = {}: must be in (0, 12]", options.speed_m_s);
    require(options.effort >= 0 && options.effort <= 100, "task.effort = {}: must be in [0, 100]",
            options.effort);
    require(options.slip >= 0 && options.slip <= 100, "task.slip = {}: must be in [0, 100]",
            options.slip);
  }

  void start(const Moment&) override { measure_m_ = 0; }

  Outcome step(const Moment& moment) override {
    const double v = moment.competition.forward / moment.step_s;
    const bool flies = ground_ && !ground_->touched(moment.kinematics);
    const double useful_m =
        moment.step_s * (flies ? -wanted_m_s_ : wanted_m_s_ - std::abs(v - wanted_m_s_));
    measure_m_ += useful_m;
    const double effort_m = moment.step_s * effort_m_s_ * mean_squared(moment.state.activation);
    const double slid_m =
        ground_ && slip_ > 0 ? moment.step_s * ground_->slip_m_s(moment.kinematics) : 0;
    return {useful_m - effort_m - slip_ * slid_m + moment.competition.ligament,
            competition::has_fallen(moment.state) ? End::fall : End::none};
  }

  double measure_m() const override { return measure_m_; }

 private:
  double wanted_m_s_, effort_m_s_, slip_;
  std::optional<Ground> ground_;
  double measure_m_ = 0;
};

}  // namespace

std::unique_ptr<Task> speed(const TaskOptions& options, const osim::Model&) {
  return std::make_unique<Speed>(options, std::nullopt);
}

std::unique_ptr<Task> walk(const TaskOptions& options, const osim::Model& model) {
  return std::make_unique<Speed>(options, Ground(model));
}

}  // namespace stride::task
