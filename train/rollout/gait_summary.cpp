#include "train/rollout/gait_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "train/task/task.h"

namespace stride::rollout {
namespace {

constexpr double kShortestContact_s = 0.03;
constexpr double kShortestSwing_s = 0.1;  // no foot swings forward in less

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double mean(const std::vector<double>& values) {
  if (values.empty()) return kUnknown;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Replaces runs of `value` shorter than `shortest` frames by what is before them.
void remove_short_runs(std::vector<bool>& values, bool value, std::size_t shortest) {
  std::size_t start = 0;
  for (std::size_t i = 1; i <= values.size(); ++i) {
    if (i < values.size() && values[i] == values[start]) continue;
    if (values[start] == value && start > 0 && i < values.size() && i - start < shortest)
      std::fill(values.begin() + static_cast<std::ptrdiff_t>(start),
                values.begin() + static_cast<std::ptrdiff_t>(i), !value);
    start = i;
  }
}

}  // namespace

double weight_N(const osim::Model& model) { return -model.mass_kg() * model.gravity_m_s2[1]; }

std::vector<FootContact> foot_contacts(const Rollout& rollout, const osim::Model& model) {
  const double threshold = task::bearing_N(model);
  const std::array<int, 2> ankle{model.body("talus_r"), model.body("talus_l")};
  const auto& frames = rollout.frames;
  const double step_s = frames.size() > 1 ? frames[1].state.time_s - frames[0].state.time_s : 0.01;
  std::vector<FootContact> all;
  for (int side = 0; side < 2; ++side) {
    std::vector<bool> down;
    for (const RolloutFrame& frame : frames)
      down.push_back(frame.kinematics.ground_reaction_N[static_cast<std::size_t>(side)].y >
                     threshold);
    const auto frames_of = [&](double time_s) {
      return static_cast<std::size_t>(std::lround(time_s / step_s));
    };
    remove_short_runs(down, false, frames_of(kShortestSwing_s));
    remove_short_runs(down, true, frames_of(kShortestContact_s));
    for (std::size_t i = 1; i < down.size(); ++i) {
      if (!down[i] || down[i - 1]) continue;
      std::size_t end = i;
      while (end < down.size() && down[end]) ++end;
      if (end == down.size()) break;
      const auto body = static_cast<std::size_t>(ankle[static_cast<std::size_t>(side)]);
      all.push_back({.side = side,
                     .start_s = frames[i].state.time_s,
                     .end_s = frames[end].state.time_s,
                     .start_x_m = frames[i].kinematics.bodies[body].position.x});
    }
  }
  std::ranges::sort(all, {}, &FootContact::start_s);
  return all;
}

GaitSummary gait_of(const Rollout& rollout, const osim::Model& model) {
  GaitSummary gait;
  const auto& frames = rollout.frames;
  const RolloutFrame &first = frames.front(), &last = frames.back();
  const RolloutFrame& later = frames[frames.size() * 2 / 3];
  const auto speed = [](const RolloutFrame& a, const RolloutFrame& b) {
    const double time = b.state.time_s - a.state.time_s;
    return time > 0 ? (b.state.q[simulation::kPelvisX] - a.state.q[simulation::kPelvisX]) / time
                    : kUnknown;
  };
  gait.speed_m_s = speed(first, last);
  gait.last_speed_m_s = speed(later, last);

  const std::vector<FootContact> all = foot_contacts(rollout, model);
  std::vector<double> step_times, step_lengths, stride_times, duties, leg_phases;
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].side == all[i - 1].side) continue;
    step_times.push_back(all[i].start_s - all[i - 1].start_s);
    step_lengths.push_back(all[i].start_x_m - all[i - 1].start_x_m);
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto again = std::ranges::find(all.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                         all.end(), all[i].side, &FootContact::side);
    if (again == all.end()) continue;
    const double stride = again->start_s - all[i].start_s;
    stride_times.push_back(stride);
    duties.push_back((all[i].end_s - all[i].start_s) / stride);
    for (const FootContact& other : all) {
      if (other.side == all[i].side || other.start_s < all[i].start_s ||
          other.start_s >= again->start_s)
        continue;
      const double phase = (other.start_s - all[i].start_s) / stride;
      leg_phases.push_back(std::min(phase, 1 - phase));
    }
  }
  gait.cadence_per_min = 60 / mean(step_times);
  gait.step_length_m = mean(step_lengths);
  gait.stride_s = mean(stride_times);
  gait.duty_factor = mean(duties);
  gait.leg_phase = mean(leg_phases);

  const double weight = weight_N(model), bearing = task::bearing_N(model);
  double flight = 0;
  for (const RolloutFrame& frame : frames) {
    const auto& force = frame.kinematics.ground_reaction_N;
    const double vertical = force[0].y + force[1].y;
    gait.peak_ground_force_bw = std::max(gait.peak_ground_force_bw, vertical / weight);
    flight += vertical < bearing;
  }
  gait.flight_share = flight / static_cast<double>(frames.size());
  return gait;
}

}  // namespace stride::rollout
