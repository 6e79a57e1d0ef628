#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "extract/io/random.h"
#include "shaping/potential.h"
#include "train/environment/mirror.h"

namespace stride::ddpg {

/// What became of an environment in one round of decisions.
enum class Outcome : std::uint8_t {
  continued,   // a decision; its next state is the environment's next record
  terminated,  // a decision that ended in a fall
  truncated,   // a decision that ended at the time limit
  ended        // no decision: the record only holds the last state of an episode
};

/// A pose as it is stored: pelvis height, then x, y of right knee, right foot, left knee, left
/// foot.
using PackedPose = std::array<double, 9>;
PackedPose pack(const Pose& pose);
Pose unpack(const PackedPose& packed);

/// Samples as the update wants them, one column or element a sample. Rewards are n-step sums
/// including shaping; `discount` is γ to the number of steps, 0 after a fall.
template <typename Scalar>
struct Batch {
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> states, actions, next_states;
  Eigen::Matrix<Scalar, 1, Eigen::Dynamic> rewards, discounts;

  /// Which decisions they are. All are drawn before the first is read, so that the memory, which is
  /// far larger than the caches, is fetched meanwhile.
  struct Draw {
    std::int64_t round = 0;
    int environment = 0;
    bool mirror = false;
  };
  std::vector<Draw> draws;
};

struct SampleOptions {
  int batch = 128;
  int n_step = 1;
  double gamma = 0.99;
  double reward_scale = 1;
  bool shaped = false;  // add F = γΦ(s′) − Φ(s) of every step
  bool mirror = true;   // half of the samples are mirrored: as if each was stored twice
};

/// The decisions of several environments in lockstep: every round adds one record of each, so the
/// record after (round, environment) is (round + 1, environment). States are stored once, with the
/// phase and the pose that shaping needs, so that the potential can be changed afterwards.
///
/// Room for the records of a round in progress is kept apart from what can be sampled: while
/// environments write the rounds from `rounds()` on, up to `lead` of them, a learner may sample.
template <typename Scalar>
class ReplayBuffer {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  struct Layout {
    int features = 0, actions = 0, environments = 1;
    std::int64_t capacity = 1'000'000;  // records that can be sampled
    int lead = 1;                       // rounds that may be written ahead
  };

  /// Everything of one record.
  struct Record {
    Outcome outcome = Outcome::continued;
    double reward = 0;  // of the environment, summed over the repeated action
    double phase = 0;
    PackedPose pose{};
    double phi = 0, phi_mirrored = 0;  // Φ(pose, phase), Φ(mirrored pose, phase + ½)
  };

  ReplayBuffer(const Layout& layout, const environment::Mirror& feature_mirror,
               const environment::Mirror& action_mirror);

  const Layout& layout() const { return layout_; }

  /// Complete rounds that were ever added, and the first that is still kept.
  std::int64_t rounds() const { return rounds_; }
  std::int64_t first_round() const { return std::max<std::int64_t>(0, rounds_ - kept_rounds_); }
  /// Decisions that can be sampled now, upper bound (last states of episodes included).
  std::int64_t size() const { return (rounds_ - first_round()) * layout_.environments; }

  /// Where to write or read the record of a round (≥ first_round(), < rounds() + lead).
  Record& record(std::int64_t round, int environment);
  const Record& record(std::int64_t round, int environment) const;
  auto features(std::int64_t round, int environment) {
    return features_.col(position(round, environment));
  }
  auto features(std::int64_t round, int environment) const {
    return features_.col(position(round, environment));
  }
  auto action(std::int64_t round, int environment) {
    return actions_.col(position(round, environment));
  }
  auto action(std::int64_t round, int environment) const {
    return actions_.col(position(round, environment));
  }

  /// Makes the next `rounds` rounds, all written, available.
  void publish(int rounds);
  /// Continues a stored buffer: the rounds before `rounds` were written by the caller.
  void set_rounds(std::int64_t rounds) { rounds_ = rounds; }

  /// Whether anything can be sampled.
  bool ready() const { return rounds_ - first_round() >= 2; }

  /// Draws decisions uniformly, with replacement.
  void sample(const SampleOptions& options, Random& random, Batch<Scalar>& batch) const;

  /// Computes Φ of every record anew from the stored poses and phases.
  void set_potential(const Potential& potential);

 private:
  Eigen::Index position(std::int64_t round, int environment) const {
    return (round % stored_rounds_) * layout_.environments + environment;
  }

  Layout layout_;
  environment::Mirror feature_mirror_, action_mirror_;
  std::int64_t kept_rounds_, stored_rounds_, rounds_ = 0;
  Matrix features_, actions_;
  std::vector<Record> records_;
};

extern template class ReplayBuffer<float>;
extern template class ReplayBuffer<double>;

}  // namespace stride::ddpg
