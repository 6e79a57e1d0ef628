#include "train/ddpg/explorer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stride::ddpg {
namespace {

constexpr int kDistanceStates = 64;  // on which the effect of parameter noise is measured
constexpr int kDistanceTrials = 12;  // of the bisection for its size

}  // namespace

template <typename Scalar>
Explorer<Scalar>::Explorer(std::unique_ptr<environment::Environment> environment,
                           environment::Observer observer, const Setup& setup, std::uint64_t seed)
    : environment_(std::move(environment)), observer_(std::move(observer)), setup_(setup) {
  state_.random.seed(seed);
  state_.noise.theta = setup.exploration.theta;
  const auto actions = static_cast<Eigen::Index>(environment_->spec().action_names.size());
  state_.noise.x = applied_ = Eigen::VectorXd::Zero(actions);
}

template <typename Scalar>
double Explorer<Scalar>::phase() const {
  if (setup_.potential == nullptr) return 0;
  return environment_->initial_phase() + setup_.potential->phase_at(environment_->time_s());
}

template <typename Scalar>
void Explorer<Scalar>::reset() {
  const Eigen::VectorXd& observation = environment_->reset(state_.episode_seed);
  observer_.start(observation, phase(), features_);
}

template <typename Scalar>
void Explorer<Scalar>::start_episode(const network::Policy<Scalar>& policy,
                                     const ReplayBuffer<Scalar>& buffer) {
  const ExplorationOptions& options = setup_.exploration;
  state_.running = true;
  state_.over = false;
  state_.episode_seed = state_.random();
  state_.actions.clear();
  state_.episode = {};
  state_.perturbed.resize(0);
  state_.sigma_factor = setup_.sigma_factor;
  const double kind = uniform(state_.random);
  if (kind < options.noise_free_fraction) {
    state_.sigma_factor = 0;
  } else if (kind < options.noise_free_fraction + options.parameter_share && buffer.ready()) {
    state_.sigma_factor = 0;
    perturb(policy, buffer);
  }
  state_.noise.start(state_.noise.x.size(), state_.sigma_factor * policy.sigma, state_.random);
  reset();
}

/// Noise on the weights and biases of the actor (Plappert et al. 2018), scaled such that it changes
/// the actions on states from the buffer by the wanted distance. Scale and shift of the layer
/// normalisation are not perturbed.
template <typename Scalar>
void Explorer<Scalar>::perturb(const network::Policy<Scalar>& policy,
                               const ReplayBuffer<Scalar>& buffer) {
  Batch<Scalar> batch;
  buffer.sample({.batch = kDistanceStates, .mirror = false}, state_.random, batch);
  policy.normaliser.apply(batch.states);
  const typename network::Mlp<Scalar>::Matrix actions = policy.actor.forward(batch.states, work_);

  Vector direction = Vector::Zero(policy.actor.parameters().size());
  for (const auto& block : policy.actor.blocks()) {
    if (block.name.find("norm") != std::string::npos) continue;
    for (Scalar& value : direction.segment(block.offset, block.rows * block.columns))
      value = static_cast<Scalar>(normal(state_.random));
  }
  double low = 1e-4, high = 10;
  perturbed_actor_ = policy.actor;
  for (int i = 0; i < kDistanceTrials; ++i) {
    const double size = std::sqrt(low * high);
    perturbed_actor_.parameters() =
        policy.actor.parameters() + static_cast<Scalar>(size) * direction;
    const double distance = (perturbed_actor_.forward(batch.states, work_) - actions).norm() /
                            std::sqrt(static_cast<double>(actions.size()));
    (distance < setup_.exploration.parameter_distance ? low : high) = size;
  }
  state_.perturbed = perturbed_actor_.parameters();
}

template <typename Scalar>
RecordKind Explorer<Scalar>::repeat(const Eigen::Ref<const Vector>& action, double& reward) {
  applied_ = action.template cast<double>();
  const double step_s = environment_->spec().step_s;
  network::EpisodeSummary& episode = state_.episode;
  for (int i = 0; i < setup_.action_repeat; ++i) {
    const environment::Step& step = environment_->step(applied_);
    state_.simulated_s += step_s;
    episode.reward += step.reward;
    reward += step.reward + setup_.alive_reward_per_s * step_s;
    const bool last = i + 1 == setup_.action_repeat;
    if (!last && !step.terminated && !step.truncated) continue;
    observer_.follow(step.observation, phase(), features_);
    if (step.terminated) reward += setup_.fall_reward;
    episode.fell = step.terminated;
    episode.failed = step.failed;
    if (step.terminated) return RecordKind::terminated;
    if (step.truncated) return RecordKind::truncated;
  }
  return RecordKind::continued;
}

template <typename Scalar>
void Explorer<Scalar>::decide(const network::Policy<Scalar>& policy,
                              const ReplayBuffer<Scalar>& buffer,
                              typename ReplayBuffer<Scalar>::Record& record,
                              Eigen::Ref<Vector> features, Eigen::Ref<Vector> action) {
  if (!state_.running) start_episode(policy, buffer);
  if (state_.perturbed.size() > perturbed_actor_.parameters().size()) {  // after restore()
    perturbed_actor_ = policy.actor;
    perturbed_actor_.parameters() = state_.perturbed;
  }
  const MovingPose motion = environment_->motion();
  record = {};
  record.pose = motion.pose;
  record.phase = phase();
  if (setup_.potential != nullptr) {
    record.phi = (*setup_.potential)(motion, record.phase);
    record.phi_mirrored =
        (*setup_.potential)(motion.mirrored(), record.phase + setup_.potential->mirrored_after);
  }
  features = features_.template cast<Scalar>();
  if (state_.over) {
    record.outcome = RecordKind::ended;
    action.setZero();
    start_episode(policy, buffer);
    return;
  }

  input_ = features;
  policy.normaliser.apply(input_);
  const bool perturbed = state_.perturbed.size() > 0;
  action = (perturbed ? perturbed_actor_ : policy.actor).forward(input_, work_).col(0);
  if (state_.sigma_factor > 0)
    action += state_.noise.step(state_.sigma_factor * policy.sigma, state_.random)
                  .template cast<Scalar>();
  action = action.cwiseMax(Scalar(0)).cwiseMin(Scalar(1));
  state_.actions.insert(state_.actions.end(), action.begin(), action.end());

  record.outcome = repeat(action, record.reward);
  state_.over = record.outcome != RecordKind::continued;
  if (!state_.over) return;
  state_.episode.distance_m = environment_->distance_m();
  state_.episode.time_s = environment_->time_s();
  finished_.push_back(state_.episode);
}

template <typename Scalar>
std::vector<network::EpisodeSummary> Explorer<Scalar>::take_finished() {
  return std::exchange(finished_, {});
}

template <typename Scalar>
void Explorer<Scalar>::restore(const ExplorerState<Scalar>& state) {
  state_ = state;
  if (!state.running) return;
  reset();
  const auto count = static_cast<std::size_t>(applied_.size());
  for (std::size_t i = 0; i < state.actions.size(); i += count) {
    double ignored = 0;
    repeat(Eigen::Map<const Vector>(state.actions.data() + i, applied_.size()), ignored);
  }
  state_.episode = state.episode;
  state_.simulated_s = state.simulated_s;
}

template class Explorer<float>;
template class Explorer<double>;

}  // namespace stride::ddpg
