#include "train/network/policy.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <sstream>

#include "extract/io/error.h"
#include "train/network/safetensors.h"

namespace stride::network {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
  return parts;
}

int number(const Tensors& tensors, const std::string& key, const std::string& text) {
  int value = 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  require(result.ec == std::errc() && result.ptr == end && value > 0 && value <= 4096,
          "{}: {} = '{}': must be whole numbers from 1 to 4096", tensors.file, key,
          tensors.meta(key));
  return value;
}

/// An agent's file.
Tensors load_agent(const std::filesystem::path& file) {
  Tensors tensors = load_tensors(file);
  const std::string &format = tensors.meta("format"), &version = tensors.meta("version");
  require(format == "stride agent" && (version == "1" || version == "2"),
          "{}: is a {} of version {}, a stride agent of version 1 or 2 is needed", tensors.file,
          format, version);
  return tensors;
}

void check_names(const Tensors& tensors, const std::string& key,
                 const std::vector<std::string>& names) {
  const std::string expected = fmt::format("{}", fmt::join(names, ","));
  require(tensors.meta(key) == expected,
          "{}: its {} are not those of this environment and configuration: {} instead of {}",
          tensors.file, key, tensors.meta(key), expected);
}

}  // namespace

template <typename Scalar>
EpisodeSummary run_episode(const Policy<Scalar>& policy, environment::Environment& environment,
                           environment::Observer& observer, const Potential* potential,
                           int action_repeat, std::uint64_t seed,
                           const std::function<void(const Eigen::VectorXd& action)>& after_step) {
  EpisodeSummary episode;
  Eigen::VectorXd features, action;
  typename Mlp<Scalar>::Workspace work;
  const auto phase = [&] {
    if (potential == nullptr) return 0.0;
    return environment.initial_phase() + potential->phase_at(environment.time_s());
  };
  const Eigen::VectorXd& observation = environment.reset(seed);
  observer.start(observation, phase(), features);
  action = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(environment.spec().action_names.size()));
  if (after_step) after_step(action);
  for (bool over = false; !over;) {
    action = policy.act(features, work);
    for (int i = 0; i < action_repeat && !over; ++i) {
      const environment::Step& step = environment.step(action);
      if (after_step) after_step(action);
      episode.reward += step.reward;
      episode.fell = step.terminated;
      episode.failed = step.failed;
      over = step.terminated || step.truncated;
      if (i + 1 == action_repeat || over) observer.follow(step.observation, phase(), features);
    }
  }
  episode.distance_m = environment.distance_m();
  episode.time_s = environment.time_s();
  return episode;
}

std::filesystem::path agent_file(const std::filesystem::path& run, const std::string& agent) {
  require(agent == "best" || agent == "agent", "--agent {}: must be best, or agent: the last one",
          agent);
  return run / (agent + ".safetensors");
}

template <typename Scalar>
void save_policy(const Policy<Scalar>& policy, const std::vector<std::string>& features,
                 const std::vector<std::string>& actions, int action_repeat,
                 const std::filesystem::path& file) {
  const MlpShape& shape = policy.actor.shape();
  Tensors tensors;
  tensors.metadata = {{"format", "stride agent"},
                      {"version", policy.symmetry ? "2" : "1"},
                      {"actor.hidden", fmt::format("{}", fmt::join(shape.hidden, ","))},
                      {"actor.activation", std::string(name(shape.activation))},
                      {"actor.layer_norm", shape.layer_norm ? "true" : "false"},
                      {"features", fmt::format("{}", fmt::join(features, ","))},
                      {"actions", fmt::format("{}", fmt::join(actions, ","))},
                      {"action_repeat", fmt::format("{}", action_repeat)}};
  if (policy.symmetry) tensors.metadata["right_leg_ahead"] = "true";
  for (const auto& block : policy.actor.blocks()) {
    const Scalar* data = policy.actor.parameters().data() + block.offset;
    using Matrix = typename Mlp<Scalar>::Matrix;
    using Vector = typename Mlp<Scalar>::Vector;
    if (block.name.ends_with("weight"))
      tensors.put("actor." + block.name,
                  Matrix(Eigen::Map<const Matrix>(data, block.rows, block.columns)));
    else
      tensors.put("actor." + block.name, Vector(Eigen::Map<const Vector>(data, block.rows)));
  }
  tensors.put("normaliser.mean", policy.normaliser.mean());
  tensors.put("normaliser.inverse_sd", policy.normaliser.inverse_sd());
  save(tensors, file);
}

PolicyNames load_policy_names(const std::filesystem::path& file) {
  const Tensors tensors = load_agent(file);
  return {.features = split(tensors.meta("features")),
          .actions = split(tensors.meta("actions")),
          .action_repeat = number(tensors, "action_repeat", tensors.meta("action_repeat"))};
}

template <typename Scalar>
Policy<Scalar> load_policy(const std::filesystem::path& file,
                           const std::vector<std::string>& features,
                           const std::vector<std::string>& actions) {
  const Tensors tensors = load_agent(file);
  check_names(tensors, "features", features);
  check_names(tensors, "actions", actions);
  std::vector<int> hidden;
  for (const std::string& neurons : split(tensors.meta("actor.hidden")))
    hidden.push_back(number(tensors, "actor.hidden", neurons));
  const MlpShape shape{.inputs = static_cast<int>(features.size()),
                       .outputs = static_cast<int>(actions.size()),
                       .hidden = hidden,
                       .activation = activation(tensors.meta("actor.activation")),
                       .output = Activation::sigmoid,
                       .layer_norm = tensors.meta("actor.layer_norm") == "true"};
  Policy<Scalar> policy{.actor = Mlp<Scalar>(shape),
                        .normaliser = Normaliser(environment::mirror_by_name(features))};
  for (const auto& block : policy.actor.blocks()) {
    typename Mlp<Scalar>::Matrix value(block.rows, block.columns);
    tensors.get("actor." + block.name, value);
    std::copy(value.data(), value.data() + value.size(),
              policy.actor.parameters().data() + block.offset);
  }
  Eigen::VectorXd mean(shape.inputs), inverse_sd(shape.inputs);
  tensors.get("normaliser.mean", mean);
  tensors.get("normaliser.inverse_sd", inverse_sd);
  policy.normaliser.fix(mean, inverse_sd);
  if (tensors.meta("version") == "2")
    policy.symmetry = environment::right_leg_ahead(features, actions);
  return policy;
}

template EpisodeSummary run_episode(const Policy<float>&, environment::Environment&,
                                    environment::Observer&, const Potential*, int, std::uint64_t,
                                    const std::function<void(const Eigen::VectorXd&)>&);
template EpisodeSummary run_episode(const Policy<double>&, environment::Environment&,
                                    environment::Observer&, const Potential*, int, std::uint64_t,
                                    const std::function<void(const Eigen::VectorXd&)>&);
template void save_policy(const Policy<float>&, const std::vector<std::string>&,
                          const std::vector<std::string>&, int, const std::filesystem::path&);
template void save_policy(const Policy<double>&, const std::vector<std::string>&,
                          const std::vector<std::string>&, int, const std::filesystem::path&);
template Policy<float> load_policy(const std::filesystem::path&, const std::vector<std::string>&,
                                   const std::vector<std::string>&);
template Policy<double> load_policy(const std::filesystem::path&, const std::vector<std::string>&,
                                    const std::vector<std::string>&);

}  // namespace stride::network
