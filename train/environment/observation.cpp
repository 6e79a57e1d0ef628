#include "train/environment/observation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "extract/io/error.h"
#include "train/environment/robust_features.h"

namespace stride::environment {
namespace {

constexpr std::array kPoints{"head",    "torso",   "tibia_r", "tibia_l", "talus_r",
                             "talus_l", "calcn_r", "calcn_l", "toes_r",  "toes_l"};

constexpr std::array kAngles{"pelvis_tilt",   "hip_flexion_r", "knee_angle_r", "ankle_angle_r",
                             "hip_flexion_l", "knee_angle_l",  "ankle_angle_l"};

int find(const EnvironmentSpec& spec, const std::string& name) {
  const auto found = std::ranges::find(spec.observation_names, name);
  require(found != spec.observation_names.end(),
          "observation '{}': the environment does not have it; switch the features that need it "
          "off (observation.derived, observation.centre, observation.activations)",
          name);
  return static_cast<int>(found - spec.observation_names.begin());
}

/// Of the competition's 41, coordinates and centre of mass are never late.
constexpr int kRobustOfCompetition = 22;

/// `head_x`, `com_x`, `pelvis_tx`: a position along the ground.
bool is_position_along_ground(const std::string& name) {
  return name == "pelvis_tx" || (name.ends_with("_x") && !name.starts_with("obstacle"));
}

}  // namespace

Observer::Observer(const EnvironmentSpec& spec, const ObservationOptions& options,
                   double decision_s)
    : decision_s_(decision_s), phase_(options.phase), phase_as_(options.phase_as) {
  const int base = std::min(options.robust ? 0 : kCompetitionObservations,
                            static_cast<int>(spec.observation_names.size()));
  const auto take = [this](const std::string& name, int value, int origin = -1) {
    names_.push_back(name);
    taken_.push_back({value, origin});
  };

  if (options.robust) {
    for (int i = 0; i < kRobustOfCompetition; ++i) {
      const std::string& name = spec.observation_names[static_cast<std::size_t>(i)];
      if (name != "pelvis_tx") take(name, i, name == "com_x" ? find(spec, "pelvis_tx") : -1);
    }
    for (const std::string& name : RobustFeatures::names()) take(name, find(spec, name));
  }
  const int pelvis_x = options.centre || options.derived ? find(spec, "pelvis_tx") : -1;
  for (int i = 0; i < base; ++i) {
    const std::string& name = spec.observation_names[static_cast<std::size_t>(i)];
    take(name, i, options.centre && is_position_along_ground(name) ? pelvis_x : -1);
  }
  if (options.derived) {
    const int pelvis_y = find(spec, "pelvis_ty");
    for (const std::string point : kPoints) {
      take(point + "_from_pelvis_x", find(spec, point + "_x"), pelvis_x);
      take(point + "_from_pelvis_y", find(spec, point + "_y"), pelvis_y);
    }
    for (const std::string point : kPoints) {
      take(point + "_vx", find(spec, point + "_vx"));
      take(point + "_vy", find(spec, point + "_vy"));
    }
  }
  if (options.activations)
    for (int i = 0; i < static_cast<int>(spec.observation_names.size()); ++i)
      if (spec.observation_names[static_cast<std::size_t>(i)].starts_with("activation_"))
        take(spec.observation_names[static_cast<std::size_t>(i)], i);
  if (options.derived) {
    const auto rate = [&](const std::string& feature, const std::string& velocity) {
      names_.push_back(feature);
      rates_.push_back(find(spec, velocity));
    };
    for (const std::string point : kPoints) {
      rate(point + "_ax", point + "_vx");
      rate(point + "_ay", point + "_vy");
    }
    rate("pelvis_ax", "pelvis_tx_u");
    rate("pelvis_ay", "pelvis_ty_u");
    rate("com_ax", "com_vx");
    rate("com_ay", "com_vy");
    for (const std::string angle : kAngles) rate(angle + "_acceleration", angle + "_u");
  }
  last_rates_.resize(static_cast<Eigen::Index>(rates_.size()));
  if (phase_) {
    if (phase_as_ == PhaseAs::passage) names_.emplace_back("passage");
    if (phase_as_ == PhaseAs::cycle) names_.insert(names_.end(), {"cycle_sin", "cycle_cos"});
    if (phase_as_ == PhaseAs::phase_of_turns)
      names_.insert(names_.end(), {"phase_sin", "phase_cos"});
  }
}

void Observer::observe(const Eigen::VectorXd& observation, double phase,
                       Eigen::VectorXd& features) {
  features.resize(static_cast<Eigen::Index>(names_.size()));
  Eigen::Index i = 0;
  for (const auto& [value, origin] : taken_)
    features[i++] = observation[value] - (origin < 0 ? 0 : observation[origin]);
  for (Eigen::Index k = 0; k < last_rates_.size(); ++k) {
    const double rate = observation[rates_[static_cast<std::size_t>(k)]];
    features[i++] = (rate - last_rates_[k]) / decision_s_;
    last_rates_[k] = rate;
  }
  if (phase_ && phase_as_ == PhaseAs::passage) {
    features[i++] = std::clamp(phase, 0.0, 1.0);
  } else if (phase_) {
    features[i++] = std::sin(2 * std::numbers::pi * phase);
    features[i++] = std::cos(2 * std::numbers::pi * phase);
  }
}

void Observer::start(const Eigen::VectorXd& observation, double phase, Eigen::VectorXd& features) {
  for (Eigen::Index k = 0; k < last_rates_.size(); ++k)
    last_rates_[k] = observation[rates_[static_cast<std::size_t>(k)]];
  observe(observation, phase, features);
}

void Observer::follow(const Eigen::VectorXd& observation, double phase, Eigen::VectorXd& features) {
  observe(observation, phase, features);
}

}  // namespace stride::environment
