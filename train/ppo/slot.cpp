#include "train/ppo/slot.h"

#include <cmath>
#include <utility>

#include "shaping/shaping_reward.h"

namespace stride::ppo {

Slot::Slot(std::unique_ptr<environment::Environment> environment, environment::Observer observer,
           const Setup& setup, std::uint64_t seed)
    : environment_(std::move(environment)), observer_(std::move(observer)), setup_(setup) {
  state_.random.seed(seed);
  applied_.setZero(static_cast<Eigen::Index>(environment_->spec().action_names.size()));
}

double Slot::phase() const {
  if (setup_.potential == nullptr) return 0;
  return environment_->initial_phase() + setup_.potential->phase_at(environment_->time_s());
}

double Slot::potential() const {
  if (setup_.potential == nullptr) return 0;
  return (*setup_.potential)(environment_->motion(), phase());
}

void Slot::reset() {
  const Eigen::VectorXd& observation = environment_->reset(state_.episode_seed);
  observer_.start(observation, phase(), features_);
}

void Slot::begin_next() {
  state_.running = true;
  state_.episode_seed = state_.random();
  state_.actions.clear();
  state_.episode = {};
  reset();
}

const Eigen::VectorXd& Slot::features() {
  if (!state_.running) begin_next();
  return features_;
}

Slot::DecisionResult Slot::repeat(double alive_per_s) {
  const double step_s = environment_->spec().step_s, phi = potential();
  network::EpisodeSummary& episode = state_.episode;
  DecisionResult outcome;
  double reward = 0;
  for (int i = 0; i < setup_.action_repeat && outcome.end == EpisodeEnd::none; ++i) {
    const environment::Step& step = environment_->step(applied_);
    state_.simulated_s += step_s;
    episode.reward += step.reward;
    reward += step.reward + alive_per_s * step_s;
    if (step.truncated) outcome.end = EpisodeEnd::truncated;
    if (step.terminated) outcome.end = EpisodeEnd::terminated;
    episode.failed = step.failed;
    if (outcome.end != EpisodeEnd::none || i + 1 == setup_.action_repeat)
      observer_.follow(step.observation, phase(), features_);
  }
  episode.fell = outcome.end == EpisodeEnd::terminated;
  if (episode.fell) reward += setup_.fall_reward;
  if (setup_.potential != nullptr)
    reward += shaping_reward(phi, potential(), setup_.gamma, episode.fell);
  outcome.reward = static_cast<float>(reward);
  return outcome;
}

Slot::DecisionResult Slot::decide(const Eigen::Ref<const Vector>& logits, double alive_per_s,
                                  Eigen::Ref<Vector> action, const environment::Mirror* mirror) {
  for (Eigen::Index i = 0; i < action.size(); ++i) {
    const double p = 1 / (1 + std::exp(-static_cast<double>(logits[i])));
    action[i] = uniform(state_.random) < p ? 1.0f : 0.0f;
  }
  const Eigen::VectorXd drawn = action.cast<double>();
  if (mirror != nullptr)
    mirror->apply(drawn, applied_);
  else
    applied_ = drawn;
  for (const double excitation : applied_)
    state_.actions.push_back(static_cast<std::uint8_t>(excitation));
  const DecisionResult outcome = repeat(alive_per_s);
  if (outcome.end == EpisodeEnd::none) return outcome;
  state_.episode.distance_m = environment_->distance_m();
  state_.episode.time_s = environment_->time_s();
  finished_.push_back(state_.episode);
  return outcome;
}

std::vector<network::EpisodeSummary> Slot::take_finished() { return std::exchange(finished_, {}); }

void Slot::restore(const SlotState& state) {
  state_ = state;
  if (!state.running) return;
  reset();
  const auto count = static_cast<std::size_t>(applied_.size());
  for (std::size_t i = 0; i < state.actions.size(); i += count) {
    for (std::size_t k = 0; k < count; ++k)
      applied_[static_cast<Eigen::Index>(k)] = state.actions[i + k];
    repeat(0);
  }
  state_.episode = state.episode;
  state_.simulated_s = state.simulated_s;
}

}  // namespace stride::ppo
