#include "train/training/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <variant>

#include "extract/io/data_file.h"
#include "extract/io/error.h"
#include "extract/io/toml.h"
#include "shaping/potential.h"

namespace stride::training {
namespace fs = std::filesystem;
namespace {

/// The names of an enumeration as choices of a setting that may be left empty.
template <typename Choice>
std::vector<std::string> names_or_empty(const Names<Choice>& names) {
  std::vector<std::string> choices{""};
  for (const auto& [value, name] : names) choices.emplace_back(name);
  return choices;
}

using Value = std::variant<bool*, int*, std::int64_t*, double*, std::string*, std::vector<int>*>;

/// One setting of a config file. A range restricts numbers, a list restricts words.
struct Field {
  std::string key, meaning;
  Value value;
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  std::vector<std::string> words = {};
};

constexpr double kInf = std::numeric_limits<double>::infinity();
const double kBelowOne = std::nextafter(1.0, 0.0);  // the end of [0, 1)

std::vector<Field> fields(TrainOptions& o) {
  const std::vector<std::string> activations{"relu", "elu", "tanh"};
  return {
      {"run.learner",
       "what learns: ddpg, the paper's, or ppo",
       &o.run.learner,
       -kInf,
       kInf,
       {"ddpg", "ppo"}},
      {"run.seed", "of every random number", &o.run.seed, 0},
      {"run.decisions", "of all environments together; then the run ends", &o.run.decisions, 1},
      {"run.threads", "0: one a core; the curve does not depend on it", &o.run.threads, 0, 1024},
      {"run.environments", "that step side by side", &o.run.environments, 1, 4096},
      {"run.action_repeat", "steps of 0.01 s that an action is held", &o.run.action_repeat, 1, 100},
      {"run.round", "decisions of each environment between two meetings with the learner",
       &o.run.round, 1, 10000},
      {"run.updates_per_decision", "of the networks", &o.run.updates_per_decision, 0, 100},
      {"run.warm_up", "decisions before the first update", &o.run.warm_up, 0},
      {"run.evaluate_every", "decisions between two episodes without noise: rows of curve.csv",
       &o.run.evaluate_every, 1},
      {"run.evaluation_episodes",
       "in one evaluation; more than 1 only matter where episodes differ",
       &o.run.evaluation_episodes, 1, 1000},
      {"run.checkpoint_s", "seconds of wall clock between two checkpoints", &o.run.checkpoint_s,
       0.01},
      {"run.precision",
       "of states and networks",
       &o.run.precision,
       -kInf,
       kInf,
       {"float", "double"}},

      {"environment.engine",
       "of the simulation",
       &o.environment.engine,
       -kInf,
       kInf,
       {"planar", "simbody"}},
      {"environment.rules",
       "clean, or nips2017: the competition with its oddities",
       &o.environment.rules,
       -kInf,
       kInf,
       {"clean", "nips2017"}},
      {"environment.model", "an .osim file; empty: the model of Learning to Run",
       &o.environment.model},
      {"environment.difficulty", "0: no obstacles; 1: obstacles; 2: and weaker muscles",
       &o.environment.difficulty, 0, 2},
      {"environment.max_obstacles", "at difficulty 1 and 2", &o.environment.max_obstacles, 0, 20},
      {"environment.flat_share", "of training episodes have no obstacles",
       &o.environment.flat_share, 0, 1},
      {"environment.few_share", "of training episodes have at most three obstacles",
       &o.environment.few_share, 0, 1},
      {"environment.late_positions", "under nips2017: observed bodies are late now and then",
       &o.environment.late_positions},
      {"environment.raw_fibres", "under nips2017: fibres are not in equilibrium at the start",
       &o.environment.raw_fibres},
      {"environment.drop_contacts",
       "under nips2017: a contact that pulls drops the next one's force",
       &o.environment.drop_contacts},
      {"environment.drop_share", "of that force, in training: less than 1 to learn it by degrees",
       &o.environment.drop_share, 0, 1},
      {"environment.accuracy", "of the integration", &o.environment.accuracy, 1e-12, 1},
      {"environment.training_accuracy", "of the integration in training; 0: the same",
       &o.environment.training_accuracy, 0, 0.1},
      {"environment.reference", "file in the run folder on which episodes may start; empty: none",
       &o.environment.reference},
      {"environment.reference_share", "of training episodes start on it",
       &o.environment.reference_share, 0, 1},
      {"environment.reference_by_slot", "in that share of the environments every episode does",
       &o.environment.reference_by_slot},

      {"imitation.reward_per_s",
       "for moving as the calibrated run does, of each simulated second in training; no potential",
       &o.environment.imitation.reward_per_s, 0, 1000},
      {"imitation.angle_deg", "root mean square difference of the angles that leaves 1/e of it",
       &o.environment.imitation.angle_deg, 1, 180},
      {"imitation.end_deg", "that ends an episode of training; 0: never",
       &o.environment.imitation.end_deg, 0, 180},

      {"task.movement", "whose task it is", &o.environment.task.movement},
      {"task.name", "reward, end and measure of an episode", &o.environment.task.name, -kInf, kInf,
       task::task_names()},
      {"task.speed_m_s", "that the task speed wants", &o.environment.task.speed_m_s, 0, 12},
      {"task.effort", "what mean squared activation costs in the task speed, m/s",
       &o.environment.task.effort, 0, 100},
      {"task.slip", "what a metre that a foot slides on the ground costs in the task walk, m",
       &o.environment.task.slip, 0, 100},

      {"observation.robust",
       "instead of the 41 what can be trusted under the competition's rules: feet by joint angles, "
       "obstacles remembered",
       &o.observation.robust},
      {"observation.centre", "x positions from the pelvis", &o.observation.centre},
      {"observation.derived", "the 71 features added to the competition's 41",
       &o.observation.derived},
      {"observation.activations", "of the runner's own muscles", &o.observation.activations},
      {"observation.phase", "sine and cosine of the phase of the stride", &o.observation.phase},

      {"reward.scale", "of the environment's reward", &o.reward.scale, 1e-9, 1e9},
      {"reward.fall", "added to the reward of a fall while training", &o.reward.fall},
      {"reward.alive_per_s", "added to the reward while training, each simulated second",
       &o.reward.alive_per_s},
      {"reward.backward_knees",
       "taken while training, for each second and radian that a knee bends backward",
       &o.environment.backward_knees, 0, 1000},

      {"shaping.potential", "file in the run folder; empty: no shaping", &o.shaping.potential},
      {"shaping.source", "where that file came from: the film finds its video there",
       &o.shaping.source},
      {"shaping.scale", "on the file's weight", &o.shaping.scale, 0},
      {"shaping.stride_share",
       "if > 0, instead of scale: being in step with the clip is worth this share of a stride's "
       "distance",
       &o.shaping.stride_share, 0, 1000},
      {"shaping.discounted", "F with the agent's discount; false: with 1, which keeps no theorem",
       &o.shaping.discounted},
      {"shaping.epsilon_m", "bounds 1/d; -1: the file's", &o.shaping.epsilon_m, -1},
      {"shaping.velocity_s", "> 0: velocities are compared as well, 1 m/s as so many metres",
       &o.shaping.velocity_s, 0},
      {"shaping.angle_m",
       "> 0: inclination of thighs and flexion of knees as well, 1 rad as so many metres",
       &o.shaping.angle_m, 0},
      {"shaping.function", "empty: the file's", &o.shaping.function, -kInf, kInf,
       names_or_empty(kInverseDistances)},
      {"shaping.index", "empty: the file's", &o.shaping.index, -kInf, kInf,
       names_or_empty(kPotentialIndices)},

      {"agent.actor_hidden", "neurons of each layer", &o.agent.actor_hidden, 1, 4096},
      {"agent.critic_hidden", "neurons of each layer", &o.agent.critic_hidden, 1, 4096},
      {"agent.actor_activation", "", &o.agent.actor_activation, -kInf, kInf, activations},
      {"agent.critic_activation", "", &o.agent.critic_activation, -kInf, kInf, activations},
      {"agent.layer_norm", "layer normalisation of hidden layers", &o.agent.layer_norm},
      {"agent.gamma", "discount a decision; shaping uses the same", &o.agent.gamma, 0, kBelowOne},
      {"agent.tau", "how far the target networks follow in an update", &o.agent.tau, 0, 1},
      {"agent.actor_rate", "Adam's step size", &o.agent.actor_rate, 0, 1},
      {"agent.critic_rate", "Adam's step size", &o.agent.critic_rate, 0, 1},
      {"agent.final_rate", "share of both rates that is left after decay_decisions",
       &o.agent.final_rate, 0, 1},
      {"agent.decay_decisions", "over which the rates fall, linearly", &o.agent.decay_decisions, 1},
      {"agent.beta2", "Adam's", &o.agent.beta2, 0, kBelowOne},
      {"agent.weight_decay", "of the critic, decoupled", &o.agent.weight_decay, 0, 1000},
      {"agent.gradient_norm_limit", "0: none", &o.agent.gradient_norm_limit, 0},
      {"agent.error_limit", "TD errors beyond it count linearly; 0: never", &o.agent.error_limit,
       0},
      {"agent.critics", "1: DDPG; 2: targets take the lower of two", &o.agent.critics, 1, 2},
      {"agent.n_step", "decisions whose rewards a target adds up", &o.agent.n_step, 1, 1000},
      {"agent.batch", "decisions in an update", &o.agent.batch, 1, 100000},

      {"exploration.sigma", "of the Ornstein-Uhlenbeck noise on actions at first",
       &o.exploration.sigma, 0, 10},
      {"exploration.final_sigma", "after decay_decisions", &o.exploration.final_sigma, 0, 10},
      {"exploration.decay_decisions", "over which sigma falls, linearly",
       &o.exploration.decay_decisions, 1},
      {"exploration.theta", "pull of the noise towards 0 a decision; 1: white",
       &o.exploration.theta, 1e-6, 1},
      {"exploration.sigma_ratio", "environments differ in sigma by up to this factor",
       &o.exploration.sigma_ratio, 1, 1000},
      {"exploration.noise_free_fraction", "of episodes have no noise",
       &o.exploration.noise_free_fraction, 0, 1},
      {"exploration.parameter_share", "of episodes have a perturbed actor instead",
       &o.exploration.parameter_share, 0, 1},
      {"exploration.parameter_distance", "root mean square change of its actions",
       &o.exploration.parameter_distance, 0, 1},

      {"replay.capacity", "decisions kept", &o.replay.capacity, 1},
      {"replay.mirror", "half of all samples reflected in the sagittal plane", &o.replay.mirror},

      {"ppo.actor_hidden", "neurons of each layer", &o.ppo.actor_hidden, 1, 4096},
      {"ppo.critic_hidden", "neurons of each layer", &o.ppo.critic_hidden, 1, 4096},
      {"ppo.activation", "", &o.ppo.activation, -kInf, kInf, activations},
      {"ppo.gamma", "discount a decision; shaping uses the same", &o.ppo.gamma, 0, kBelowOne},
      {"ppo.lambda", "decay of the advantage's horizon a decision", &o.ppo.lambda, 0, 1},
      {"ppo.horizon", "decisions of each environment between two updates", &o.ppo.horizon, 1,
       10000},
      {"ppo.epochs", "passes over them", &o.ppo.epochs, 1, 1000},
      {"ppo.minibatch", "decisions in a step of Adam", &o.ppo.minibatch, 2, 1e6},
      {"ppo.clip", "of the ratio of probabilities", &o.ppo.clip, 0, 10},
      {"ppo.rate", "Adam's step size at first", &o.ppo.rate, 0, 1},
      {"ppo.kl", "divergence of an update to which the actor's rate is steered, at first",
       &o.ppo.kl, 1e-6, 10},
      {"ppo.final_kl", "after decay_decisions", &o.ppo.final_kl, 1e-6, 10},
      {"ppo.entropy", "weight of the entropy at first", &o.ppo.entropy, 0, 10},
      {"ppo.final_entropy", "after decay_decisions", &o.ppo.final_entropy, 0, 10},
      {"ppo.decay_decisions", "over which kl, entropy and the critic's rate anneal, linearly",
       &o.ppo.decay_decisions, 1},
      {"ppo.final_rate", "share of the critic's rate that is left after decay_decisions",
       &o.ppo.final_rate, 0, 1},
      {"ppo.gradient_norm_limit", "0: none", &o.ppo.gradient_norm_limit, 0},
      {"ppo.alive_per_s", "reward of each simulated second in training at first",
       &o.ppo.alive_per_s},
      {"ppo.final_alive_per_s", "after alive_decisions", &o.ppo.final_alive_per_s},
      {"ppo.alive_decisions", "over which it falls, linearly", &o.ppo.alive_decisions, 1},
      {"ppo.mirror", "every state is seen with the right leg ahead", &o.ppo.mirror},
      {"ppo.start", "file in the run folder with the networks of another run; empty: random ones",
       &o.ppo.start},
  };
}

struct Print {
  std::string operator()(bool* v) const { return *v ? "true" : "false"; }
  std::string operator()(std::string* v) const { return toml_text(*v); }
  std::string operator()(std::vector<int>* v) const {
    return fmt::format("[{}]", fmt::join(*v, ", "));
  }
  std::string operator()(auto* v) const { return fmt::format("{}", *v); }
};

std::string to_text(const Value& value) { return std::visit(Print{}, value); }

template <typename Number>
bool parse_number(const std::string& text, Number& value) {
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, value);
  return result.ec == std::errc() && result.ptr == end;
}

/// False if the value is not of the field's type.
struct Assign {
  const std::vector<std::string>& in;

  bool operator()(std::vector<int>* v) const {
    std::vector<int> list(in.size());
    for (std::size_t i = 0; i < in.size(); ++i)
      if (!parse_number(in[i], list[i])) return false;
    *v = list;
    return true;
  }
  bool operator()(std::string* v) const {
    if (in.size() > 1) return false;
    *v = in.empty() ? "" : in[0];
    return true;
  }
  bool operator()(bool* v) const {
    if (in.size() != 1 || (in[0] != "true" && in[0] != "false")) return false;
    *v = in[0] == "true";
    return true;
  }
  bool operator()(std::int64_t* v) const {  // 2e6 counts as a whole number
    double real = 0;
    if (in.size() != 1) return false;
    if (parse_number(in[0], *v)) return true;
    if (!parse_number(in[0], real) || real != std::floor(real) || std::abs(real) > 9e15)
      return false;
    *v = static_cast<std::int64_t>(real);
    return true;
  }
  bool operator()(auto* v) const { return in.size() == 1 && parse_number(in[0], *v); }
};

std::string_view kind(const Value& value) {
  constexpr std::string_view kinds[] = {"true or false",      "a whole number",
                                        "a whole number",     "a number",
                                        "one word in quotes", "a list of whole numbers"};
  return kinds[value.index()];
}

/// Levenshtein distance of two keys, to suggest a correction.
std::size_t letters_apart(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = std::exchange(row[j], std::min({replaced, row[j] + 1, row[j - 1] + 1}));
    }
  }
  return row.back();
}

void check_range(const Field& field, double value, const std::string& text) {
  const bool below_one = field.max == kBelowOne;
  require(value >= field.min && value <= field.max, "{} = {}: must be in [{}, {}{}", field.key,
          text, field.min, below_one ? 1 : field.max, below_one ? ')' : ']');
}

void check_field(const Field& field) {
  const std::string text = to_text(field.value);
  if (const auto* v = std::get_if<int*>(&field.value)) check_range(field, **v, text);
  if (const auto* v = std::get_if<std::int64_t*>(&field.value))
    check_range(field, static_cast<double>(**v), text);
  if (const auto* v = std::get_if<double*>(&field.value)) {
    require(std::isfinite(**v), "{} = {}: must be finite", field.key, text);
    check_range(field, **v, text);
  }
  if (const auto* v = std::get_if<std::vector<int>*>(&field.value))
    for (const int n : **v) check_range(field, n, text);
  if (const auto* v = std::get_if<std::string*>(&field.value))
    require(field.words.empty() || std::ranges::count(field.words, **v) > 0,
            "{} = {}: must be one of {}", field.key, text, fmt::join(field.words, ", "));
}

}  // namespace

void TrainOptions::check() const {
  TrainOptions copy = *this;
  for (const Field& field : fields(copy)) check_field(field);
  require(exploration.noise_free_fraction + exploration.parameter_share <= 1,
          "exploration.noise_free_fraction + exploration.parameter_share = {}: must be at most 1",
          exploration.noise_free_fraction + exploration.parameter_share);
}

namespace {

/// Renamed keys of version 0.1.0, whose runs are still read.
std::string present_key(const std::string& key) {
  if (key == "exploration.spread") return "exploration.sigma_ratio";
  if (key == "exploration.quiet_share") return "exploration.noise_free_fraction";
  return key;
}

/// KEY=VALUE as TOML: on the command line a word needs no quotes.
std::string quoted(std::string_view assignment) {
  constexpr std::array<std::string_view, 4> kWords{"true", "false", "inf", "nan"};
  const auto at = assignment.find('=') + 1;
  const std::string_view key = assignment.substr(0, at), value = assignment.substr(at);
  const bool is_toml =
      std::ranges::count(kWords, value) > 0 || value.find_first_of("\"'[+-.0123456789") == 0;
  return is_toml ? std::string(assignment) : fmt::format("{}{}", key, toml_text(value));
}

}  // namespace

void set_options(const std::vector<TomlSetting>& settings, const std::string& source,
                 TrainOptions& options) {
  std::vector<Field> known = fields(options);
  for (const TomlSetting& setting : settings) {
    const std::string key = present_key(setting.key());
    const auto field = std::ranges::find(known, key, &Field::key);
    require(key != "base", "{}: base: only a preset has one: name the preset by --preset", source);
    if (field == known.end()) {
      const auto nearest = std::ranges::min_element(
          known, {}, [&](const Field& f) { return letters_apart(f.key, key); });
      throw Error(fmt::format("{}: {}: unknown key; did you mean {}?", source, key, nearest->key));
    }
    require(std::visit(Assign{setting.words}, field->value), "{}: {} = {}: must be {}", source, key,
            fmt::join(setting.words, ", "), kind(field->value));
  }
}

void read_toml(const fs::path& file, TrainOptions& options) {
  set_options(load_toml(file), file.string(), options);
}

void set_option(std::string_view assignment, TrainOptions& options) {
  require(assignment.find('=') != std::string_view::npos,
          "--set {}: must be KEY=VALUE, such as agent.gamma=0.99", assignment);
  const std::string source = fmt::format("--set {}", assignment);
  set_options(parse_toml(quoted(assignment), source), source, options);
}

std::string to_toml(const TrainOptions& options, std::string_view heading) {
  TrainOptions copy = options;
  std::string text(heading), section;
  for (const Field& field : fields(copy)) {
    const auto dot = field.key.find('.');
    if (dot == std::string::npos) continue;
    if (field.key.substr(0, dot) != section) {
      section = field.key.substr(0, dot);
      text += fmt::format("\n[{}]\n", section);
    }
    text += fmt::format("{} = {}", field.key.substr(dot + 1), to_text(field.value));
    text += field.meaning.empty() ? "\n" : fmt::format("  # {}\n", field.meaning);
  }
  return text;
}

std::string first_difference(const TrainOptions& options, const TrainOptions& other) {
  TrainOptions copy = options, copy_of_other = other;
  const std::vector<Field> theirs = fields(copy_of_other);
  for (std::size_t i = 0; const Field& field : fields(copy)) {
    const std::string value = to_text(field.value), their_value = to_text(theirs[i++].value);
    if (value != their_value) return fmt::format("{} = {}, not {}", field.key, value, their_value);
  }
  return "";
}

namespace {

/// `what` names the preset in an error.
fs::path preset_file(const std::string& name, const std::string& what) {
  const fs::path folder = data_file("train/presets");
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") names.insert(entry.path().stem().string());
  require(names.contains(name), "{}: must be one of {}", what, fmt::join(names, ", "));
  return folder / fmt::format("{}.toml", name);
}

/// `what` names the preset in an error; `chain`: the presets whose base it is.
void read_preset(const std::string& name, const std::string& what, std::vector<std::string> chain,
                 TrainOptions& options) {
  const fs::path file = preset_file(name, what);
  chain.push_back(name);
  std::vector<TomlSetting> settings = load_toml(file);
  const auto setting = std::ranges::find(settings, "base", &TomlSetting::key);
  if (setting != settings.end()) {
    const std::string base = fmt::format("{}", fmt::join(setting->words, ", "));
    const std::string named = fmt::format("{}: base = {}", file.string(), base);
    require(std::ranges::count(chain, base) == 0,
            "{}: must not lead back to this preset, as it does by way of {}", named,
            fmt::join(chain, ", "));
    settings.erase(setting);
    read_preset(base, named, chain, options);
  }
  set_options(settings, file.string(), options);
}

}  // namespace

void read_preset(std::string_view name, TrainOptions& options) {
  read_preset(std::string(name), fmt::format("preset '{}'", name), {}, options);
}

}  // namespace stride::training
