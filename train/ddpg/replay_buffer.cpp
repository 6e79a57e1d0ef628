#include "train/ddpg/replay_buffer.h"

#include <sys/mman.h>

#include <algorithm>
#include <memory>

#include "extract/io/error.h"
#include "shaping/shaping_reward.h"

namespace stride::ddpg {
namespace {

/// Requests large pages before the memory is first written. Random reads otherwise spend a quarter
/// of their time on address translation.
template <typename Element>
void advise_large_pages(Element* data, std::size_t count) {
  constexpr std::size_t kPage = 4096;
  std::size_t bytes = count * sizeof(Element);
  void* begin = data;
  if (std::align(kPage, kPage, begin, bytes) != nullptr)
    ::madvise(begin, bytes / kPage * kPage, MADV_HUGEPAGE);
}

/// Prefetches memory.
template <typename Element>
void prefetch(const Element* data, Eigen::Index count) {
  constexpr std::ptrdiff_t kLine = 64;
  const auto* begin = reinterpret_cast<const char*>(data);
  const auto* end = reinterpret_cast<const char*>(data + count);
  for (const char* at = begin; at < end; at += kLine) __builtin_prefetch(at);
  __builtin_prefetch(end - 1);
}

template <typename Column>
void prefetch(const Column& column) {
  prefetch(column.data(), column.size());
}

}  // namespace

template <typename Scalar>
ReplayBuffer<Scalar>::ReplayBuffer(const Layout& layout, const environment::Mirror& feature_mirror,
                                   const environment::Mirror& action_mirror)
    : layout_(layout), feature_mirror_(feature_mirror), action_mirror_(action_mirror) {
  kept_rounds_ = layout.capacity / layout.environments;
  require(kept_rounds_ >= 2, "replay.capacity = {}: must be at least twice the {} environments",
          layout.capacity, layout.environments);
  stored_rounds_ = kept_rounds_ + layout.lead;
  const Eigen::Index count = stored_rounds_ * layout.environments;
  features_.resize(layout.features, count);
  actions_.resize(layout.actions, count);
  advise_large_pages(features_.data(), static_cast<std::size_t>(features_.size()));
  advise_large_pages(actions_.data(), static_cast<std::size_t>(actions_.size()));
  records_.reserve(static_cast<std::size_t>(count));
  advise_large_pages(records_.data(), static_cast<std::size_t>(count));
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
  batch.draws.clear();
  for (int s = 0; s < options.batch; ++s) {
    std::int64_t round = 0;
    int environment = 0;
    do {
      const auto drawn = static_cast<std::int64_t>(uniform_index(random, choices));
      round = first + drawn / layout_.environments;
      environment = static_cast<int>(drawn % layout_.environments);
    } while (record(round, environment).outcome == RecordKind::ended);
    const bool mirror = options.mirror && (random() >> 63) != 0;
    batch.draws.push_back({round, environment, mirror});
    const std::int64_t last = std::min(round + options.n_step, rounds_ - 1);
    prefetch(features_.col(position(round, environment)));
    prefetch(actions_.col(position(round, environment)));
    prefetch(features_.col(position(last, environment)));
    for (std::int64_t i = round; i <= last; ++i) prefetch(&record(i, environment), 1);
  }

  for (int s = 0; s < options.batch; ++s) {
    const auto& [round, environment, mirror] = batch.draws[static_cast<std::size_t>(s)];
    // Up to n steps, fewer at the end of the episode or of what is known. The rewards for shaping
    // telescope over them: shaping_reward().
    const auto phi = [&, mirrored = mirror](const Record& r) {
      return mirrored ? r.phi_mirrored : r.phi;
    };
    double reward = 0, discount = 1;
    bool terminated = false;
    std::int64_t last = round;
    for (int i = 0;; ++i) {
      const Record& step = record(last, environment);
      reward += discount * options.reward_scale * step.reward;
      terminated = step.outcome == RecordKind::terminated;
      ++last;
      if (options.shaped && !options.discounted)
        reward +=
            discount * shaping_reward(phi(step), phi(record(last, environment)), 1, terminated);
      discount *= options.gamma;
      if (step.outcome != RecordKind::continued || i + 1 == options.n_step || last + 1 == rounds_)
        break;
    }
    if (options.shaped && options.discounted)
      reward += shaping_reward(phi(record(round, environment)), phi(record(last, environment)),
                               discount, terminated);

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
    batch.discounts[s] = static_cast<Scalar>(terminated ? 0 : discount);
  }
}

template <typename Scalar>
void ReplayBuffer<Scalar>::set_potential(const Potential& potential) {
  for (std::int64_t round = first_round(); round < rounds_; ++round)
    for (int e = 0; e < layout_.environments; ++e) {
      Record& r = record(round, e);
      r.phi = potential(r.pose, r.phase);
      r.phi_mirrored = potential(r.pose.mirrored(), r.phase + potential.mirrored_after);
    }
}

template class ReplayBuffer<float>;
template class ReplayBuffer<double>;

}  // namespace stride::ddpg
