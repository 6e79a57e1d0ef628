#include <algorithm>
#include <array>
#include <cmath>

#include "train/task/tasks.h"

namespace stride::task {
namespace {

constexpr double kShortestFlight_s = 0.05;
constexpr double kStand_s = 0.5;        // after the landing
constexpr double kFromStart_m = 0.5;    // a take-off farther ahead has a run-up
constexpr double kFallTilt_rad = 1.2;   // of the pelvis either way; a deep crouch has 0.6
constexpr double kFallHeight_m = 0.45;  // of the pelvis; who lands deep has it at 0.6

/// What both jumps share: flight, landing, and standing after it.
class Jump : public Task {
 public:
  explicit Jump(const osim::Model& model)
      : ankles_{model.body("talus_r"), model.body("talus_l")}, bearing_N_(task::bearing_N(model)) {}

  void start(const Moment& first) override {
    airborne_s_ = standing_s_ = measure_m_ = paid_m_ = flight_m_ = flown_m_ = 0;
    landed_ = false;
    left_ = place(first);
    start_x_m_ = left_.foremost_ankle_m;
  }

  Outcome step(const Moment& moment) override {
    Outcome outcome{moment.competition.ligament, End::none};
    const std::array<bool, 2> down = feet_down(moment);
    if (!down[0] && !down[1])
      fly(moment, outcome);
    else
      touch(moment, down, outcome);
    const auto& q = moment.state.q;
    if (q[simulation::kPelvisY] < kFallHeight_m ||
        std::abs(q[simulation::kPelvisTilt]) > kFallTilt_rad)
      outcome = {outcome.reward - flown_m_, End::fall};
    if (outcome.end == End::fall) measure_m_ = 0;
    return outcome;
  }

  double measure_m() const override { return measure_m_; }

 protected:
  struct Place {
    double foremost_ankle_m = 0, com_height_m = 0;
  };

  /// A flight begins there; what a step of it is worth; and the whole jump, m.
  virtual void begin_flight() {}
  virtual double gain_m(const Moment& moment) = 0;
  virtual double size_m() const = 0;
  /// Whether the feet that have touched the ground since the landing are those to stand on.
  virtual bool lands_on(const std::array<bool, 2>& touched) const {
    return touched[0] && touched[1];
  }

  const Place& take_off() const { return take_off_; }
  double rearmost_landing_m() const { return std::min(landing_x_m_[0], landing_x_m_[1]); }
  double right_landing_m() const { return landing_x_m_[0]; }

 private:
  double ankle_x(const Moment& moment, std::size_t side) const {
    return moment.kinematics.bodies[static_cast<std::size_t>(ankles_[side])].position.x;
  }

  Place place(const Moment& moment) const {
    return {std::max(ankle_x(moment, 0), ankle_x(moment, 1)), moment.kinematics.com.y};
  }

  std::array<bool, 2> feet_down(const Moment& moment) const {
    const auto& force = moment.kinematics.ground_reaction_N;
    return {force[0].y > bearing_N_, force[1].y > bearing_N_};
  }

  bool flies() const { return airborne_s_ > kShortestFlight_s - 1e-9; }
  bool counts() const { return take_off_.foremost_ankle_m < start_x_m_ + kFromStart_m; }

  void fly(const Moment& moment, Outcome& outcome) {
    const bool flew = flies();
    airborne_s_ += moment.step_s;
    if (!flies()) return;
    if (!flew) {  // another flight before it stood: the next landing counts
      take_off_ = left_;
      landed_ = false;
      flight_m_ = 0;
      begin_flight();
    }
    if (!counts()) return;
    flight_m_ += gain_m(moment);
    const double farther_m = std::max(0.0, flight_m_ - flown_m_);  // many hops are paid once
    flown_m_ += farther_m;
    outcome.reward += farther_m;
  }

  void touch(const Moment& moment, const std::array<bool, 2>& down, Outcome& outcome) {
    if (flies() && counts()) {
      landed_ = true;
      touched_ = {};
      standing_s_ = 0;
    }
    airborne_s_ = 0;
    left_ = place(moment);
    if (!landed_) return;
    for (std::size_t side = 0; side < 2; ++side) {
      if (!touched_[side]) landing_x_m_[side] = ankle_x(moment, side);
      touched_[side] = touched_[side] || down[side];
    }
    if (!lands_on(touched_)) return;
    standing_s_ += moment.step_s;
    const double stood = std::min(1.0, standing_s_ / kStand_s);
    const double earned_m = std::max(0.0, size_m()) * stood * stood;
    outcome.reward += std::max(0.0, earned_m - paid_m_);
    paid_m_ = std::max(paid_m_, earned_m);
    if (standing_s_ < kStand_s - 1e-9) return;
    measure_m_ = std::max(0.0, size_m());
    outcome.end = End::done;
  }

  std::array<int, 2> ankles_;  // indices into Model::bodies
  double bearing_N_;
  double start_x_m_ = 0;
  Place left_, take_off_;  // when a foot was last on the ground; when the flight began
  double airborne_s_ = 0, standing_s_ = 0, measure_m_ = 0;
  double flight_m_ = 0;              // what this flight is worth
  double paid_m_ = 0, flown_m_ = 0;  // for standing and for flight so far
  bool landed_ = false;
  std::array<bool, 2> touched_{};  // since the landing
  std::array<double, 2> landing_x_m_{};
};

class LongJump final : public Jump {
 public:
  using Jump::Jump;

 private:
  double gain_m(const Moment& moment) override { return moment.competition.forward; }
  double size_m() const override { return rearmost_landing_m() - take_off().foremost_ankle_m; }
};

class Hop final : public Jump {
 public:
  using Jump::Jump;

 private:
  double gain_m(const Moment& moment) override { return moment.competition.forward; }
  double size_m() const override { return right_landing_m() - take_off().foremost_ankle_m; }
  bool lands_on(const std::array<bool, 2>& touched) const override {
    return touched[0] && !touched[1];
  }
};

class HighJump final : public Jump {
 public:
  using Jump::Jump;

 private:
  void begin_flight() override { rise_m_ = 0; }
  double gain_m(const Moment& moment) override {
    const double before_m = rise_m_;
    rise_m_ = std::max(rise_m_, moment.kinematics.com.y - take_off().com_height_m);
    return rise_m_ - before_m;
  }
  double size_m() const override { return rise_m_; }

  double rise_m_ = 0;
};

}  // namespace

std::unique_ptr<Task> long_jump(const TaskOptions&, const osim::Model& model) {
  return std::make_unique<LongJump>(model);
}

std::unique_ptr<Task> hop(const TaskOptions&, const osim::Model& model) {
  return std::make_unique<Hop>(model);
}

std::unique_ptr<Task> high_jump(const TaskOptions&, const osim::Model& model) {
  return std::make_unique<HighJump>(model);
}

}  // namespace stride::task
