#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "extract/io/random.h"
#include "shaping/potential.h"
#include "train/environment/mirror.h"

namespace stride::ddpg {

/// What a record holds: the outcome of one round in one environment.
enum class RecordKind : std::uint8_t {
  continued,   // a decision; its next state is the environment's next record
  terminated,  // a decision that ended in a fall
  truncated,   // a decision that ended at the time limit
  ended        // no decision: the record only holds the last state of an episode
};

/// Samples for an update, a column or element for each. Rewards are n-step sums including shaping;
/// `discount` is γ to the power of the number of steps, 0 after a fall.
template <typename Scalar>
struct Batch {
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> states, actions, next_states;
  Eigen::Matrix<Scalar, 1, Eigen::Dynamic> rewards, discounts;

  /// Indices of the sampled decisions. All are drawn before the first is read, so that memory can
  /// be prefetched.
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
  bool shaped = false;     // add F = γΦ(s′) − Φ(s) of every step
  bool discounted = true;  // or Φ(s′) − Φ(s)
  bool mirror = true;      // half of the samples are mirrored, as if each was stored twice
};

/// The decisions of several environments in lockstep. Every round adds one record of each
/// environment, so the successor of (round, environment) is (round + 1, environment). States are
/// stored once, with phase and pose for the shaping, so that the potential can be changed
/// afterwards.
///
/// Rounds in progress are separate from those that can be sampled: a learner may sample while
/// environments write the rounds from `rounds()` on, at most `lead` of them.
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
    RecordKind outcome = RecordKind::continued;
    double reward = 0;  // of the environment, summed over the repeated action
    double phase = 0;
    Pose pose;
    double phi = 0, phi_mirrored = 0;  // Φ(pose, phase), Φ(mirrored pose, phase + ½)
  };

  ReplayBuffer(const Layout& layout, const environment::Mirror& feature_mirror,
               const environment::Mirror& action_mirror);

  const Layout& layout() const { return layout_; }

  /// Number of complete rounds added so far, and the first one that is still stored.
  std::int64_t rounds() const { return rounds_; }
  std::int64_t first_round() const { return std::max<std::int64_t>(0, rounds_ - kept_rounds_); }
  /// Upper bound of the number of decisions that can be sampled (includes last states of episodes).
  std::int64_t size() const { return (rounds_ - first_round()) * layout_.environments; }

  /// The record of a round in [first_round(), rounds() + lead).
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

  /// Makes the next `rounds` rounds available; all must be written.
  void publish(int rounds);
  /// Continues a stored buffer whose rounds before `rounds` were written by the caller.
  void set_rounds(std::int64_t rounds) { rounds_ = rounds; }

  /// Whether anything can be sampled.
  bool ready() const { return rounds_ - first_round() >= 2; }

  /// Draws decisions uniformly, with replacement.
  void sample(const SampleOptions& options, Random& random, Batch<Scalar>& batch) const;

  /// Recomputes Φ of every record from the stored poses and phases. Velocities are not stored:
  /// throws Error for a potential that compares them.
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
