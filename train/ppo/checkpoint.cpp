#include <fmt/format.h>

#include "extract/io/error.h"
#include "train/network/safetensors.h"
#include "train/ppo/training.h"
#include "train/training/checkpoint.h"

namespace stride::ppo {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kLongestEpisode = 1'000'000;  // decisions

void put(network::Tensors& tensors, const std::string& name, const network::Mlp<float>& network,
         const network::Adam<float>& adam) {
  tensors.put(name, network.parameters());
  tensors.put(name + ".adam.step", adam.step);
  tensors.put(name + ".adam.m", adam.m);
  tensors.put(name + ".adam.v", adam.v);
}

void get(const network::Tensors& tensors, const std::string& name, network::Mlp<float>& network,
         network::Adam<float>& adam) {
  tensors.get(name, network.parameters());
  adam.step = tensors.integer(name + ".adam.step");
  if (adam.step == 0) return;
  adam.m.resize(network.parameters().size());
  adam.v.resize(network.parameters().size());
  tensors.get(name + ".adam.m", adam.m);
  tensors.get(name + ".adam.v", adam.v);
}

void put(network::Tensors& tensors, const std::string& name, const SlotState& state) {
  tensors.put_bytes(name + ".random", training::to_text(state.random));
  tensors.put(name + ".running", std::int64_t{state.running});
  tensors.put(name + ".seed", static_cast<std::int64_t>(state.episode_seed));
  tensors.put_bytes(name + ".actions",
                    {reinterpret_cast<const char*>(state.actions.data()), state.actions.size()});
  tensors.put(name + ".reward", Eigen::VectorXd{{state.episode.reward}});
  tensors.put(name + ".simulated_s", Eigen::VectorXd{{state.simulated_s}});
}

double number(const network::Tensors& tensors, const std::string& name) {
  Eigen::VectorXd value(1);
  tensors.get(name, value);
  return value[0];
}

SlotState get(const network::Tensors& tensors, const std::string& name, std::size_t actions) {
  SlotState state;
  state.random = training::random_from(tensors.bytes(name + ".random"), tensors.file);
  state.running = tensors.integer(name + ".running") != 0;
  state.episode_seed = static_cast<std::uint64_t>(tensors.integer(name + ".seed"));
  const std::string& bytes = tensors.bytes(name + ".actions");
  require(bytes.size() % actions == 0 && bytes.size() <= kLongestEpisode * actions,
          "{}: {}.actions has {} elements, a multiple of {} is needed: of another model",
          tensors.file, name, bytes.size(), actions);
  for (const char byte : bytes) {
    require(byte == 0 || byte == 1, "{}: {}.actions holds what is neither 0 nor 1", tensors.file,
            name);
    state.actions.push_back(static_cast<std::uint8_t>(byte));
  }
  state.episode.reward = number(tensors, name + ".reward");
  state.simulated_s = number(tensors, name + ".simulated_s");
  return state;
}

/// The counters, by name.
template <typename Visit>
void visit_counters(training::Progress& progress, const Visit& visit) {
  visit("decisions", progress.decisions), visit("updates", progress.updates);
  visit("episodes", progress.episodes), visit("falls", progress.falls);
  visit("failures", progress.failures), visit("rows", progress.rows);
  visit("last_row_decisions", progress.last_row_decisions);
  visit("next_evaluation", progress.next_evaluation);
}
template <typename Visit>
void visit_sums(training::Progress& progress, BatchSums& sums, const Visit& visit) {
  visit("best_distance_m", progress.best_distance_m);
  visit("sums.episodes", progress.sums.episodes);
  visit("sums.distance_m", progress.sums.distance_m);
  visit("sums.reward", progress.sums.reward);
  visit("sums.batches", sums.batches), visit("sums.kl", sums.kl);
  visit("sums.entropy", sums.entropy), visit("sums.value_loss", sums.value_loss);
  visit("sums.explained_variance", sums.explained_variance);
}

network::Tensors load_tensors_of_ppo(const fs::path& file) {
  network::Tensors tensors = network::load_tensors(file);
  require(tensors.meta("format") == "stride ppo checkpoint" && tensors.meta("version") == "1",
          "{}: is a {} of version {}, a stride ppo checkpoint of version 1 is needed", tensors.file,
          tensors.meta("format"), tensors.meta("version"));
  return tensors;
}

/// Networks, what steers them, and the normaliser.
void get_learner(const network::Tensors& tensors, PpoTraining& training) {
  Learner& learner = training.learner;
  get(tensors, "actor", learner.actor(), learner.actor_adam());
  get(tensors, "critic", learner.critic().net, learner.critic().adam);
  Eigen::VectorXd scale(3);
  tensors.get("critic.scale", scale);
  learner.critic().shift = scale[0];
  learner.critic().scale = scale[1];
  learner.critic().batches = scale[2];
  learner.rate() = number(tensors, "actor.rate");
  network::Normaliser::State normaliser = training.normaliser.state();
  normaliser.count = static_cast<double>(tensors.integer("normaliser.count"));
  tensors.get("normaliser.mean", normaliser.mean);
  tensors.get("normaliser.squares", normaliser.squares);
  training.normaliser.set_state(normaliser);
}

}  // namespace

void save_checkpoint(const PpoTraining& training, const fs::path& run) {
  network::Tensors tensors;
  tensors.metadata = {{"format", "stride ppo checkpoint"}, {"version", "1"}};
  training::Progress progress = training.progress;
  BatchSums sums = training.sums;
  visit_counters(progress, [&](const char* name, std::int64_t value) { tensors.put(name, value); });
  visit_sums(progress, sums,
             [&](const char* name, double value) { tensors.put(name, Eigen::VectorXd{{value}}); });
  tensors.put_bytes("random", training::to_text(training.random));
  put(tensors, "actor", training.learner.actor(), training.learner.actor_adam());
  const ScaledCritic& critic = training.learner.critic();
  put(tensors, "critic", critic.net, critic.adam);
  tensors.put("critic.scale", Eigen::VectorXd{{critic.shift, critic.scale, critic.batches}});
  tensors.put("actor.rate", Eigen::VectorXd{{training.learner.rate()}});
  const network::Normaliser::State& normaliser = training.normaliser.state();
  tensors.put("normaliser.count", static_cast<std::int64_t>(normaliser.count));
  tensors.put("normaliser.mean", normaliser.mean);
  tensors.put("normaliser.squares", normaliser.squares);
  for (std::size_t i = 0; i < training.slots.size(); ++i)
    put(tensors, fmt::format("slot{}", i), training.slots[i].state());
  save(tensors, training::checkpoint_file(run));
}

void load_checkpoint(PpoTraining& training, const fs::path& run) {
  const network::Tensors tensors = load_tensors_of_ppo(training::checkpoint_file(run));
  visit_counters(training.progress,
                 [&](const char* name, std::int64_t& value) { value = tensors.integer(name); });
  visit_sums(training.progress, training.sums,
             [&](const char* name, double& value) { value = number(tensors, name); });
  training.random = training::random_from(tensors.bytes("random"), tensors.file);
  get_learner(tensors, training);
  for (std::size_t i = 0; i < training.slots.size(); ++i)
    training.slots[i].restore(get(tensors, fmt::format("slot{}", i), training.action_names.size()));
}

void begin_with(PpoTraining& training, const fs::path& checkpoint) {
  get_learner(load_tensors_of_ppo(checkpoint), training);
}

}  // namespace stride::ppo
