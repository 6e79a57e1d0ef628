#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "shaping/potential.h"
#include "train/environment/environment.h"
#include "train/environment/observation.h"
#include "train/network/mlp.h"
#include "train/network/normaliser.h"

namespace stride::network {

/// A policy: the actor and the normalisation of its inputs.
template <typename Scalar>
struct Policy {
  Mlp<Scalar> actor;
  Normaliser normaliser;
  double sigma = 0;  // of the current exploration noise
  /// If it sees every state with its right leg ahead; the normaliser is then of what it sees.
  std::optional<environment::RightLegAhead> symmetry = {};

  /// The action without noise, for features as observed.
  Eigen::VectorXd act(const Eigen::VectorXd& features,
                      typename Mlp<Scalar>::Workspace& work) const {
    const bool mirrored = symmetry && symmetry->mirrors(features);
    Eigen::VectorXd seen = features;
    if (mirrored) symmetry->features.apply(features, seen);
    typename Mlp<Scalar>::Matrix input = seen.cast<Scalar>();
    normaliser.apply(input);
    Eigen::VectorXd action = actor.forward(input, work).col(0).template cast<double>();
    if (!mirrored) return action;
    Eigen::VectorXd done(action.size());
    symmetry->actions.apply(action, done);
    return done;
  }
};

/// The outcome of an episode.
struct EpisodeSummary {
  double reward = 0;  // of the environment, neither scaled nor shaped
  double distance_m = 0, time_s = 0;
  bool fell = false, failed = false;
};

/// An episode without noise. `potential` (or null) gives the phase that the agent observes;
/// `after_step` (or null) is called after the reset and after every step of the environment, with
/// the action that led there.
template <typename Scalar>
EpisodeSummary run_episode(const Policy<Scalar>& policy, environment::Environment& environment,
                           environment::Observer& observer, const Potential* potential,
                           int action_repeat, std::uint64_t seed,
                           const std::function<void(const Eigen::VectorXd& action)>& after_step);

/// Describes a policy file, agent.safetensors. Tensors, float32 or float64, row-major:
/// `actor.<layer>.weight` [outputs, inputs], `.bias`, `.norm.scale`, `.norm.shift` (of layer
/// normalisation, variance + 1e-5, before the activation), `normaliser.mean`,
/// `normaliser.inverse_sd` [features]. action = sigmoid(actor(clip((features − mean) · inverse_sd,
/// ±10))). Metadata: format, version, actor.hidden, actor.activation, actor.layer_norm, features
/// and actions (names, separated by commas), action_repeat. Version 2 has `right_leg_ahead`: where
/// hip_flexion_l > hip_flexion_r, features and action are mirrored (RightLegAhead).
template <typename Scalar>
void save_policy(const Policy<Scalar>& policy, const std::vector<std::string>& features,
                 const std::vector<std::string>& actions, int action_repeat,
                 const std::filesystem::path& file);

/// The policy file of a run. `agent` is "best" or "agent" (the last one); throws Error otherwise.
std::filesystem::path agent_file(const std::filesystem::path& run, const std::string& agent);

/// The names of features and actions in a policy file.
struct PolicyNames {
  std::vector<std::string> features, actions;
  int action_repeat = 1;
};
PolicyNames load_policy_names(const std::filesystem::path& file);

/// Reads a policy. Throws Error naming the file, also if its features or actions are others than
/// these.
template <typename Scalar>
Policy<Scalar> load_policy(const std::filesystem::path& file,
                           const std::vector<std::string>& features,
                           const std::vector<std::string>& actions);

}  // namespace stride::network
