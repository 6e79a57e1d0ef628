#include "train/training/checkpoint.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <sstream>
#include <string>
#include <type_traits>

#include "extract/io/error.h"
#include "train/network/safetensors.h"

namespace stride::training {
namespace fs = std::filesystem;
namespace {

constexpr Eigen::Index kLongestEpisode = 1'000'000;  // decisions
constexpr std::int64_t kSegmentRecords = 200'000;    // at most, of one replay segment

template <typename Scalar>
using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

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
  const Eigen::VectorXd numbers{{state.sigma_factor, state.simulated_s, state.episode.reward,
                                 state.episode.distance_m, state.episode.time_s,
                                 state.episode.fell ? 1.0 : 0.0, state.episode.failed ? 1.0 : 0.0}};
  tensors.put(name + ".numbers", numbers);
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

// ---- counters

void put(network::Tensors& tensors, const Progress& progress) {
  static_assert(std::is_trivially_copyable_v<Progress>);
  tensors.put_bytes("progress", {reinterpret_cast<const char*>(&progress), sizeof progress});
}

void get(const network::Tensors& tensors, Progress& progress) {
  const std::string& bytes = tensors.bytes("progress");
  require(bytes.size() == sizeof progress, "{}: of another version of this program", tensors.file);
  std::memcpy(&progress, bytes.data(), sizeof progress);
}

// ---- replay segments: the records of rounds [from, to), by round and environment

struct Segment {
  std::int64_t from = 0, to = 0;
  fs::path file;
};

fs::path segment_file(const fs::path& run, std::int64_t from, std::int64_t to) {
  return run / "replay" / fmt::format("{:012}-{:012}.safetensors", from, to);
}

std::vector<Segment> segments_of(const fs::path& run) {
  std::vector<Segment> segments;
  if (!fs::exists(run / "replay")) return segments;
  for (const auto& entry : fs::directory_iterator(run / "replay")) {
    Segment segment{.file = entry.path()};
    long long from = 0, to = 0;
    if (std::sscanf(entry.path().filename().c_str(), "%12lld-%12lld.safetensors", &from, &to) != 2)
      continue;
    segment.from = from;
    segment.to = to;
    segments.push_back(segment);
  }
  std::ranges::sort(segments, {}, &Segment::from);
  return segments;
}

template <typename Column>
void append(std::string& bytes, const Column& column) {
  bytes.append(reinterpret_cast<const char*>(column.data()),
               static_cast<std::size_t>(column.size()) * sizeof(*column.data()));
}

template <typename Scalar>
void save_segment(const ddpg::ReplayBuffer<Scalar>& buffer, std::int64_t from, std::int64_t to,
                  const fs::path& file) {
  using Record = typename ddpg::ReplayBuffer<Scalar>::Record;
  static_assert(std::is_trivially_copyable_v<Record>);
  std::string features, actions, records;
  for (std::int64_t round = from; round < to; ++round)
    for (int e = 0; e < buffer.layout().environments; ++e) {
      append(features, buffer.features(round, e));
      append(actions, buffer.action(round, e));
      records.append(reinterpret_cast<const char*>(&buffer.record(round, e)), sizeof(Record));
    }
  network::Tensors tensors;
  tensors.put_bytes("features", features);
  tensors.put_bytes("actions", actions);
  tensors.put_bytes("records", records);
  network::save(tensors, file);
}

template <typename Scalar>
void load_segment(ddpg::ReplayBuffer<Scalar>& buffer, const Segment& segment) {
  using Record = typename ddpg::ReplayBuffer<Scalar>::Record;
  const network::Tensors tensors = network::load_tensors(segment.file);
  const auto& layout = buffer.layout();
  const auto count = static_cast<std::size_t>((segment.to - segment.from) * layout.environments);
  const auto take = [&](const char* name, std::size_t size) {
    const std::string& bytes = tensors.bytes(name);
    require(bytes.size() == count * size, "{}: {} of {} bytes, {} are needed: of another run",
            tensors.file, name, bytes.size(), count * size);
    return bytes.data();
  };
  const std::size_t feature_bytes = static_cast<std::size_t>(layout.features) * sizeof(Scalar);
  const std::size_t action_bytes = static_cast<std::size_t>(layout.actions) * sizeof(Scalar);
  const char* features = take("features", feature_bytes);
  const char* actions = take("actions", action_bytes);
  const char* records = take("records", sizeof(Record));
  for (std::int64_t round = segment.from; round < segment.to; ++round)
    for (int e = 0; e < layout.environments; ++e) {
      std::memcpy(buffer.features(round, e).data(), features, feature_bytes);
      std::memcpy(buffer.action(round, e).data(), actions, action_bytes);
      std::memcpy(static_cast<void*>(&buffer.record(round, e)), records, sizeof(Record));
      const Record& record = buffer.record(round, e);
      require(buffer.features(round, e).allFinite() && buffer.action(round, e).allFinite() &&
                  std::isfinite(record.reward + record.phi + record.phi_mirrored) &&
                  record.outcome <= ddpg::Outcome::ended,
              "{}: the record of round {}, environment {} holds what is no number: damaged",
              tensors.file, round, e);
      features += feature_bytes;
      actions += action_bytes;
      records += sizeof(Record);
    }
}

template <typename Scalar>
void save_new_segments(const ddpg::ReplayBuffer<Scalar>& buffer, const fs::path& run) {
  std::int64_t from = buffer.first_round();
  for (const Segment& segment : segments_of(run)) from = std::max(from, segment.to);
  const std::int64_t longest =
      std::max<std::int64_t>(1, kSegmentRecords / buffer.layout().environments);
  while (from < buffer.rounds()) {
    const std::int64_t to = std::min(from + longest, buffer.rounds());
    save_segment(buffer, from, to, segment_file(run, from, to));
    from = to;
  }
}

/// Rounds before the first stored one may be missing in the segments, none after it.
template <typename Scalar>
void load_segments(ddpg::ReplayBuffer<Scalar>& buffer, const fs::path& run, std::int64_t rounds) {
  buffer.set_rounds(rounds);
  std::int64_t known = buffer.first_round();
  for (const Segment& segment : segments_of(run)) {
    if (segment.from >= rounds) {  // written before a kill, after the checkpoint
      fs::remove(segment.file);
      continue;
    }
    require(segment.from <= known && segment.to <= rounds,
            "{}: the rounds from {} on are missing in {}: the replay memory is not complete",
            segment.file.string(), known, segment.file.parent_path().string());
    load_segment(buffer, segment);
    known = segment.to;
  }
  require(known == rounds, "{}: the rounds from {} to {} are missing", (run / "replay").string(),
          known, rounds);
}

}  // namespace

fs::path checkpoint_file(const fs::path& run) { return run / "checkpoint.safetensors"; }

template <typename Scalar>
void save_checkpoint(const Training<Scalar>& training, const fs::path& run) {
  save_new_segments(training.buffer, run);
  network::Tensors tensors;
  tensors.metadata = {{"format", "stride checkpoint"}, {"version", "1"}};
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

  for (const Segment& segment : segments_of(run))
    if (segment.to <= training.buffer.first_round()) fs::remove(segment.file);
}

template <typename Scalar>
void load_checkpoint(Training<Scalar>& training, const fs::path& run) {
  const network::Tensors tensors = network::load_tensors(checkpoint_file(run));
  require(tensors.meta("format") == "stride checkpoint" && tensors.meta("version") == "1",
          "{}: is a {} of version {}, a stride checkpoint of version 1 is needed", tensors.file,
          tensors.meta("format"), tensors.meta("version"));
  get(tensors, training.progress);
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
