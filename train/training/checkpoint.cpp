#include "train/training/checkpoint.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <sstream>
#include <string>
#include <type_traits>

#include "extract/io/error.h"
#include "train/network/safetensors.h"
#include "train/training/replay_segments.h"

namespace stride::training {
namespace fs = std::filesystem;
namespace {

constexpr Eigen::Index kLongestEpisode = 1'000'000;  // decisions

template <typename Scalar>
using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// Reads a vector of n · unit elements, 0 ≤ n ≤ `most`.
template <typename Scalar>
Vector<Scalar> vector_from(const network::Tensors& tensors, const std::string& name,
                           Eigen::Index unit, Eigen::Index most = 1) {
  Vector<Scalar> value(tensors.size(name));
  require(value.size() % unit == 0 && value.size() <= most * unit,
          "{}: tensor '{}' has {} elements, a multiple of {} is needed: of another model",
          tensors.file, name, value.size(), unit);
  tensors.get(name, value);
  return value;
}

// ---- networks

template <typename Scalar>
void put(network::Tensors& tensors, const std::string& name, const network::Adam<Scalar>& adam) {
  tensors.put(name + ".step", adam.step);
  tensors.put(name + ".m", adam.m);
  tensors.put(name + ".v", adam.v);
}

template <typename Scalar>
void get(const network::Tensors& tensors, const std::string& name, Eigen::Index parameters,
         network::Adam<Scalar>& adam) {
  adam.step = tensors.integer(name + ".step");
  adam.m = vector_from<Scalar>(tensors, name + ".m", parameters);
  adam.v = vector_from<Scalar>(tensors, name + ".v", parameters);
  require(adam.m.size() == adam.v.size(), "{}: tensors '{}.m' and '.v' differ in size",
          tensors.file, name);
}

template <typename Scalar>
void put(network::Tensors& tensors, ddpg::Agent<Scalar> agent) {
  tensors.put("actor", agent.actor().parameters());
  tensors.put("actor_target", agent.actor_target().parameters());
  put(tensors, "actor_adam", agent.actor_adam());
  for (std::size_t i = 0; i < agent.critics().size(); ++i) {
    const auto& critic = agent.critics()[i];
    tensors.put(fmt::format("critic{}", i), critic.network.parameters());
    tensors.put(fmt::format("critic{}_target", i), critic.target.parameters());
    put(tensors, fmt::format("critic{}_adam", i), critic.adam);
  }
}

template <typename Scalar>
void get(const network::Tensors& tensors, ddpg::Agent<Scalar>& agent) {
  tensors.get("actor", agent.actor().parameters());
  tensors.get("actor_target", agent.actor_target().parameters());
  get(tensors, "actor_adam", agent.actor().parameters().size(), agent.actor_adam());
  for (std::size_t i = 0; i < agent.critics().size(); ++i) {
    auto& critic = agent.critics()[i];
    tensors.get(fmt::format("critic{}", i), critic.network.parameters());
    tensors.get(fmt::format("critic{}_target", i), critic.target.parameters());
    get(tensors, fmt::format("critic{}_adam", i), critic.network.parameters().size(), critic.adam);
  }
}

// ---- environments

template <typename Scalar>
void put(network::Tensors& tensors, const std::string& name,
         const ddpg::ExplorerState<Scalar>& state) {
  tensors.put_bytes(name + ".random", to_text(state.random));
  tensors.put(name + ".running", std::int64_t{state.running});
  tensors.put(name + ".over", std::int64_t{state.over});
  tensors.put(name + ".seed", static_cast<std::int64_t>(state.episode_seed));
  const Vector<Scalar> actions = Eigen::Map<const Vector<Scalar>>(
      state.actions.data(), static_cast<Eigen::Index>(state.actions.size()));
  tensors.put(name + ".actions", actions);
  tensors.put(name + ".noise", state.noise.x);
  tensors.put(name + ".perturbed", state.perturbed);
  tensors.put_number(name + ".sigma_factor", state.sigma_factor);
  tensors.put_number(name + ".simulated_s", state.simulated_s);
  tensors.put_number(name + ".episode.reward", state.episode.reward);
  tensors.put_number(name + ".episode.distance_m", state.episode.distance_m);
  tensors.put_number(name + ".episode.time_s", state.episode.time_s);
  tensors.put(name + ".episode.fell", std::int64_t{state.episode.fell});
  tensors.put(name + ".episode.failed", std::int64_t{state.episode.failed});
}

template <typename Scalar>
ddpg::ExplorerState<Scalar> get(const network::Tensors& tensors, const std::string& name,
                                Eigen::Index actor_parameters, ddpg::ExplorerState<Scalar> state) {
  state.random = random_from(tensors.bytes(name + ".random"), tensors.file);
  state.running = tensors.integer(name + ".running") != 0;
  state.over = tensors.integer(name + ".over") != 0;
  state.episode_seed = static_cast<std::uint64_t>(tensors.integer(name + ".seed"));
  const Vector<Scalar> actions =
      vector_from<Scalar>(tensors, name + ".actions", state.noise.x.size(), kLongestEpisode);
  state.actions.assign(actions.begin(), actions.end());
  tensors.get(name + ".noise", state.noise.x);
  state.perturbed = vector_from<Scalar>(tensors, name + ".perturbed", actor_parameters);
  if (tensors.has(name + ".numbers")) {  // version 1
    Eigen::VectorXd numbers(7);
    tensors.get(name + ".numbers", numbers);
    state.sigma_factor = numbers[0];
    state.simulated_s = numbers[1];
    state.episode = {.reward = numbers[2],
                     .distance_m = numbers[3],
                     .time_s = numbers[4],
                     .fell = numbers[5] != 0,
                     .failed = numbers[6] != 0};
    return state;
  }
  state.sigma_factor = tensors.number(name + ".sigma_factor");
  state.simulated_s = tensors.number(name + ".simulated_s");
  state.episode = {.reward = tensors.number(name + ".episode.reward"),
                   .distance_m = tensors.number(name + ".episode.distance_m"),
                   .time_s = tensors.number(name + ".episode.time_s"),
                   .fell = tensors.integer(name + ".episode.fell") != 0,
                   .failed = tensors.integer(name + ".episode.failed") != 0};
  return state;
}

// ---- counters

/// Calls visit(name, value) for each, in the order in which version 1 wrote their bytes.
template <typename Visit>
void visit_counters(Progress& p, const Visit& visit) {
  visit("decisions", p.decisions);
  visit("updates", p.updates);
  visit("episodes", p.episodes);
  visit("falls", p.falls);
  visit("failures", p.failures);
  visit("rows", p.rows);
  visit("last_row_decisions", p.last_row_decisions);
  visit("next_evaluation", p.next_evaluation);
  visit("best_distance_m", p.best_distance_m);
  visit("sums.episodes", p.sums.episodes);
  visit("sums.distance_m", p.sums.distance_m);
  visit("sums.reward", p.sums.reward);
  visit("sums.updates", p.sums.updates);
  visit("sums.critic_loss", p.sums.critic_loss);
  visit("sums.q", p.sums.q);
  visit("sums.target", p.sums.target);
  visit("sums.actor_gradient", p.sums.actor_gradient);
  visit("sums.critic_gradient", p.sums.critic_gradient);
}

void put(network::Tensors& tensors, Progress progress) {
  visit_counters(progress, [&](const std::string& name, auto value) {
    if constexpr (std::is_integral_v<decltype(value)>)
      tensors.put("progress." + name, value);
    else
      tensors.put_number("progress." + name, value);
  });
}

void get(const network::Tensors& tensors, Progress& progress) {
  visit_counters(progress, [&](const std::string& name, auto& value) {
    if constexpr (std::is_integral_v<std::remove_reference_t<decltype(value)>>)
      value = tensors.integer("progress." + name);
    else
      value = tensors.number("progress." + name);
  });
}

/// Version 1: the bytes of the struct.
void get_version_1(const network::Tensors& tensors, Progress& progress) {
  const std::string& bytes = tensors.bytes("progress");
  std::size_t at = 0;
  visit_counters(progress, [&](const char*, auto& value) {
    require(at + sizeof value <= bytes.size(), "{}: progress has {} bytes: damaged", tensors.file,
            bytes.size());
    std::memcpy(&value, bytes.data() + at, sizeof value);
    at += sizeof value;
  });
}

}  // namespace

std::string to_text(const Random& random) {
  std::ostringstream out;
  out << random;
  return std::move(out).str();
}

Random random_from(const std::string& text, const std::string& file) {
  Random random;
  std::istringstream in(text);
  in >> random;
  // The last number of its state is the index of the next one; the library does not check it.
  std::istringstream last(text.substr(text.find_last_of(' ') + 1));
  std::size_t next = 0;
  require(!in.fail() && last >> next && next <= Random::state_size,
          "{}: the state of a random number generator cannot be read", file);
  return random;
}

fs::path checkpoint_file(const fs::path& run) { return run / "checkpoint.safetensors"; }

template <typename Scalar>
void save_checkpoint(const Training<Scalar>& training, const fs::path& run) {
  save_new_segments(training.buffer, run);
  network::Tensors tensors;
  tensors.metadata = {{"format", "stride checkpoint"}, {"version", "2"}};
  tensors.put("rounds", training.buffer.rounds());
  put(tensors, training.progress);
  tensors.put_bytes("random", to_text(training.random));
  put(tensors, training.agent);
  const network::Normaliser::State& normaliser = training.normaliser.state();
  tensors.put("normaliser.count", static_cast<std::int64_t>(normaliser.count));
  tensors.put("normaliser.mean", normaliser.mean);
  tensors.put("normaliser.squares", normaliser.squares);
  for (std::size_t i = 0; i < training.explorers.size(); ++i)
    put(tensors, fmt::format("slot{}", i), training.explorers[i].state());
  network::save(tensors, checkpoint_file(run));
  remove_old_segments(training.buffer, run);
}

template <typename Scalar>
void load_checkpoint(Training<Scalar>& training, const fs::path& run) {
  const network::Tensors tensors = network::load_tensors(checkpoint_file(run));
  const std::string &format = tensors.meta("format"), &version = tensors.meta("version");
  require(format == "stride checkpoint" && (version == "1" || version == "2"),
          "{}: is a {} of version {}, a stride checkpoint of version 1 or 2 is needed",
          tensors.file, format, version);
  version == "1" ? get_version_1(tensors, training.progress) : get(tensors, training.progress);
  training.random = random_from(tensors.bytes("random"), tensors.file);
  get(tensors, training.agent);
  network::Normaliser::State normaliser = training.normaliser.state();
  normaliser.count = static_cast<double>(tensors.integer("normaliser.count"));
  tensors.get("normaliser.mean", normaliser.mean);
  tensors.get("normaliser.squares", normaliser.squares);
  training.normaliser.set_state(normaliser);
  const std::int64_t rounds = tensors.integer("rounds");
  require(rounds >= 0, "{}: rounds = {}: must be at least 0", tensors.file, rounds);
  load_segments(training.buffer, run, rounds);
  for (std::size_t i = 0; i < training.explorers.size(); ++i) {
    auto& explorer = training.explorers[i];
    explorer.restore(get(tensors, fmt::format("slot{}", i),
                         training.agent.actor().parameters().size(), explorer.state()));
  }
}

template void save_checkpoint(const Training<float>&, const fs::path&);
template void save_checkpoint(const Training<double>&, const fs::path&);
template void load_checkpoint(Training<float>&, const fs::path&);
template void load_checkpoint(Training<double>&, const fs::path&);

}  // namespace stride::training
