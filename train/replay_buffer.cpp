#include "train/replay_buffer.h"

#include <algorithm>

#include "extract/error.h"

namespace stride {

PackedPose pack(const Pose& pose) {
  return {pose.pelvis_height_m, pose.knee_r.x(), pose.knee_r.y(), pose.foot_r.x(), pose.foot_r.y(),
          pose.knee_l.x(),      pose.knee_l.y(), pose.foot_l.x(), pose.foot_l.y()};
}

Pose unpack(const PackedPose& p) {
  return {.pelvis_height_m = p[0],
          .knee_r = {p[1], p[2]},
          .foot_r = {p[3], p[4]},
          .knee_l = {p[5], p[6]},
          .foot_l = {p[7], p[8]}};
}

template <typename Scalar>
ReplayBuffer<Scalar>::ReplayBuffer(const Layout& layout, const Mirror& feature_mirror,
                                   const Mirror& action_mirror)
    : layout_(layout), feature_mirror_(feature_mirror), action_mirror_(action_mirror) {
  kept_rounds_ = layout.capacity / layout.environments;
  require(kept_rounds_ >= 2, "replay.capacity = {}: must be at least twice the {} environments",
          layout.capacity, layout.environments);
  stored_rounds_ = kept_rounds_ + layout.lead;
  const Eigen::Index count = stored_rounds_ * layout.environments;
  features_.resize(layout.features, count);
  actions_.resize(layout.actions, count);
  records_.resize(static_cast<std::size_t>(count));
}

template <typename Scalar>
typename ReplayBuffer<Scalar>::Record& ReplayBuffer<Scalar>::record(std::int64_t round,
                                                                    int environment) {
  return records_[static_cast<std::size_t>(position(round, environment))];
}

template <typename Scalar>
const typename ReplayBuffer<Scalar>::Record& ReplayBuffer<Scalar>::record(std::int64_t round,
                                                                          int environment) const {
  return records_[static_cast<std::size_t>(position(round, environment))];
}

template <typename Scalar>
void ReplayBuffer<Scalar>::publish(int rounds) {
  rounds_ += rounds;
}

template <typename Scalar>
void ReplayBuffer<Scalar>::sample(const SampleOptions& options, Random& random,
                                  Batch<Scalar>& batch) const {
  batch.states.resize(layout_.features, options.batch);
  batch.next_states.resize(layout_.features, options.batch);
  batch.actions.resize(layout_.actions, options.batch);
  batch.rewards.resize(options.batch);
  batch.discounts.resize(options.batch);

  const std::int64_t first = first_round();
  const auto choices = static_cast<std::uint64_t>((rounds_ - 1 - first) * layout_.environments);
  for (int s = 0; s < options.batch; ++s) {
    std::int64_t round = 0;
    int environment = 0;
    do {
      const auto drawn = static_cast<std::int64_t>(uniform_index(random, choices));
      round = first + drawn / layout_.environments;
      environment = static_cast<int>(drawn % layout_.environments);
    } while (record(round, environment).outcome == Outcome::ended);
    const bool mirror = options.mirror && (random() >> 63) != 0;

    // Up to n steps, fewer at the end of the episode or of what is known. The potentials in
    // between cancel: Σ γⁱ Fᵢ = γᵐ Φ(s_m) − Φ(s_0).
    const auto phi = [&](const Record& r) { return mirror ? r.phi_mirrored : r.phi; };
    double reward = 0, discount = 1;
    std::int64_t last = round;
    for (int i = 0;; ++i) {
      const Record& step = record(last, environment);
      reward += discount * options.reward_scale * step.reward;
      discount = step.outcome == Outcome::terminated ? 0 : discount * options.gamma;
      ++last;
      if (step.outcome != Outcome::continued || i + 1 == options.n_step || last + 1 == rounds_)
        break;
    }
    if (options.shaped)
      reward += discount * phi(record(last, environment)) - phi(record(round, environment));

    const Eigen::Index here = position(round, environment), next = position(last, environment);
    if (mirror) {
      feature_mirror_.apply(features_.col(here), batch.states.col(s));
      feature_mirror_.apply(features_.col(next), batch.next_states.col(s));
      action_mirror_.apply(actions_.col(here), batch.actions.col(s));
    } else {
      batch.states.col(s) = features_.col(here);
      batch.next_states.col(s) = features_.col(next);
      batch.actions.col(s) = actions_.col(here);
    }
    batch.rewards[s] = static_cast<Scalar>(reward);
    batch.discounts[s] = static_cast<Scalar>(discount);
  }
}

template <typename Scalar>
void ReplayBuffer<Scalar>::set_potential(const Potential& potential) {
  for (std::int64_t round = first_round(); round < rounds_; ++round)
    for (int e = 0; e < layout_.environments; ++e) {
      Record& r = record(round, e);
      const Pose pose = unpack(r.pose);
      r.phi = potential(pose, r.phase);
      r.phi_mirrored = potential(pose.mirrored(), r.phase + 0.5);
    }
}

template class ReplayBuffer<float>;
template class ReplayBuffer<double>;

}  // namespace stride
