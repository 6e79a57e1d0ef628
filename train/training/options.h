#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "extract/io/toml.h"
#include "train/ddpg/agent.h"
#include "train/ddpg/explorer.h"
#include "train/environment/imitation.h"
#include "train/environment/observation.h"
#include "train/task/task.h"

namespace stride::training {

struct RunOptions {
  std::string learner = "ddpg";  // or ppo
  std::int64_t seed = 1;
  std::int64_t decisions = 1'000'000;  // of all environments together
  int threads = 0;                     // 0: one for each core; the curve does not depend on it
  int environments = 16;
  int action_repeat = 3;  // steps of 0.01 s for which an action is held
  int round = 4;          // decisions of each environment in a round
  double updates_per_decision = 0.25;
  std::int64_t warm_up = 10'000;         // decisions before the first update
  std::int64_t evaluate_every = 25'000;  // decisions
  int evaluation_episodes = 1;      // without noise; more than one only matter if resets differ
  double checkpoint_s = 120;        // wall clock between two checkpoints
  std::string precision = "float";  // of states and networks: float or double
};

struct EnvironmentOptions {
  std::string engine = "planar";  // or simbody
  std::string rules = "clean";    // or nips2017
  std::string model;              // .osim; empty: the model of Learning to Run
  int difficulty = 0;
  int max_obstacles = 3;
  double flat_share = 0, few_share = 0;  // of training episodes: no obstacles, three at most
  bool late_positions = true;            // under nips2017, as OpenSim observes bodies
  bool raw_fibres = true;                // likewise: at the start not in equilibrium
  bool drop_contacts = true;             // likewise: one that pulls drops the next
  double drop_share = 1;                 // of its force, in training
  double accuracy = 1e-3;                // of the integration
  double training_accuracy = 0;          // of training episodes; 0: the same
  double backward_knees = 0;             // their cost in training, m/s per rad
  std::string reference;                 // calibrated run, as it was copied into the run folder
  double reference_share = 0.7;          // of training episodes start on it
  bool reference_by_slot = false;        // in that share of the environments all episodes do
  environment::ImitationOptions imitation = {};  // of the calibrated run, in training episodes
  task::TaskOptions task = {};                   // what the agent is to do
};

struct RewardOptions {
  double scale = 10;       // of the environment's reward, for the learner
  double fall = 0;         // added at a fall in training, before scaling
  double alive_per_s = 0;  // likewise for each simulated second
};

struct ShapingOptions {
  std::string potential;    // file, as it was copied into the run folder; empty: no shaping
  std::string source;       // where that file came from; the source video is searched there
  double scale = 0.008;     // factor on the file's weight; PF3 with weight 1 outweighs the reward
  double stride_share = 0;  // if > 0, instead of scale: what being in step is worth, in strides
  bool discounted = true;  // F = γ Φ′ − Φ; false: Φ′ − Φ, which keeps no theorem (Jeon et al.)
  double epsilon_m = 0.1;  // instead of the file's; -1: the file's
  double velocity_s = 0;   // > 0: velocities are compared as well, 1 m/s as so many metres
  double angle_m = 0;      // > 0: the angles of the legs as well, 1 rad as so many metres
  std::string function;    // pf1 … pf4; empty: the file's
  std::string index;       // time, nearest; empty: the file's
};

struct ReplayOptions {
  std::int64_t capacity = 1'000'000;  // decisions
  bool mirror = true;
};

/// Proximal policy optimisation (Schulman et al. 2017) with generalised advantage estimation
/// (Schulman et al. 2016).
struct PpoOptions {
  std::vector<int> actor_hidden = {128, 128}, critic_hidden = {128, 128};
  std::string activation = "tanh";
  double gamma = 0.99, lambda = 0.95;  // discount, and decay of the advantage's horizon, a decision
  int horizon = 64;                    // decisions of each environment between two updates
  int epochs = 6;                      // passes over them
  int minibatch = 512;                 // decisions in a step of Adam
  double clip = 0.2;                   // of the ratio of probabilities
  double rate = 3e-4;                  // Adam's step size at first; then kl steers the actor's
  double kl = 0.03, final_kl = 0.01;   // wanted mean divergence from the policy of the batch
  double entropy = 0.003, final_entropy = 0.003;  // weight of the entropy
  double decay_decisions = 4e6;  // over which kl, entropy and the critic's rate anneal
  double final_rate = 0.2;       // share of the critic's rate that is left then
  double gradient_norm_limit = 0.5;
  double alive_per_s = 2, final_alive_per_s = 0.3;  // reward of not having fallen
  double alive_decisions = 600'000;                 // over which it falls
  bool mirror = true;                               // every state is seen with the right leg ahead
  std::string start;  // checkpoint whose networks the run begins with, as copied into its folder
};

/// Everything a run depends on. Defaults are those of the preset `ddpg`.
struct TrainOptions {
  RunOptions run = {};
  EnvironmentOptions environment = {};
  environment::ObservationOptions observation = {};
  RewardOptions reward = {};
  ShapingOptions shaping = {};
  ddpg::AgentOptions agent = {};
  ddpg::ExplorationOptions exploration = {};
  ReplayOptions replay = {};
  PpoOptions ppo = {};

  /// Throws Error naming the first option that is out of range: `agent.gamma = 1.2: must be in [0,
  /// 1)`.
  void check() const;
};

/// Sets the options that a TOML file names. Throws Error naming file, key and cure for an unknown
/// key or a value of another kind.
void read_toml(const std::filesystem::path& file, TrainOptions& options);
/// The same for settings from a larger file; errors name `source`.
void set_options(const std::vector<TomlSetting>& settings, const std::string& source,
                 TrainOptions& options);
/// The same for a `key=value` of the command line.
void set_option(std::string_view assignment, TrainOptions& options);

/// All options as TOML with comments; reads back as the same options.
std::string to_toml(const TrainOptions& options, std::string_view heading);

/// The first option in which `other` differs, as "agent.gamma = 0.99, not 0.9"; empty if none does.
std::string first_difference(const TrainOptions& options, const TrainOptions& other);

/// Sets the options of train/presets/NAME.toml. Where it says `base = "OTHER"`, those of the preset
/// OTHER come first. Throws Error with the list of presets for an unknown name or base, and with
/// the chain of bases that leads back to itself.
void read_preset(std::string_view name, TrainOptions& options);

}  // namespace stride::training
