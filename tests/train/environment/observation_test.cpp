#include "train/environment/observation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "tests/support/throws.h"
#include "tests/train/support/point_mass.h"
#include "train/environment/mirror.h"
#include "train/environment/runner_environment.h"

namespace stride {
namespace {

class Observation : public ::testing::Test {
 protected:
  Observation() : runner_(osim::load_osim(osim::default_model_file()), {}) {}

  Eigen::VectorXd excitations(double seed) {
    Eigen::VectorXd a(18);
    for (int i = 0; i < 18; ++i) a[i] = 0.5 + 0.5 * std::sin(seed + 3 * i);
    return a;
  }
  double of(const environment::Observer& observer, const Eigen::VectorXd& features,
            const std::string& name) {
    const auto found = std::ranges::find(observer.names(), name);
    EXPECT_NE(found, observer.names().end()) << name;
    return features[found - observer.names().begin()];
  }
  double raw(const Eigen::VectorXd& observation, const std::string& name) {
    const auto& names = runner_.spec().observation_names;
    return observation[std::ranges::find(names, name) - names.begin()];
  }

  environment::RunnerEnvironment runner_;
};

TEST_F(Observation, OfThePaperHas112FeaturesWithNamesOfTheirOwn) {
  const environment::Observer observer(
      runner_.spec(), {.derived = true, .activations = false, .phase = false}, 0.03);
  EXPECT_EQ(observer.names().size(), 41u + 71u);
  EXPECT_EQ(std::set(observer.names().begin(), observer.names().end()).size(), 112u);
  const environment::Observer plain(
      runner_.spec(), {.centre = false, .derived = false, .activations = false, .phase = false},
      0.03);
  EXPECT_EQ(plain.names().size(), 41u);
}

TEST_F(Observation, FeaturesAreWhatTheirNamesSay) {
  environment::Observer observer(runner_.spec(), {.derived = true}, 0.03);
  Eigen::VectorXd features;
  Eigen::VectorXd before = runner_.reset(1);
  observer.start(before, 0.2, features);
  EXPECT_EQ(of(observer, features, "talus_r_ax"), 0);
  Eigen::VectorXd now;
  for (int i = 0; i < 3; ++i) now = runner_.step(excitations(1)).observation;
  observer.follow(now, 0.25, features);
  EXPECT_EQ(of(observer, features, "pelvis_tx"), 0);
  EXPECT_EQ(of(observer, features, "pelvis_ty"), raw(now, "pelvis_ty"));
  EXPECT_EQ(of(observer, features, "head_x"), raw(now, "head_x") - raw(now, "pelvis_tx"));
  EXPECT_EQ(of(observer, features, "tibia_l_from_pelvis_y"),
            raw(now, "tibia_l_y") - raw(now, "pelvis_ty"));
  EXPECT_EQ(of(observer, features, "calcn_r_vy"), raw(now, "calcn_r_vy"));
  EXPECT_EQ(of(observer, features, "talus_r_ax"),
            (raw(now, "talus_r_vx") - raw(before, "talus_r_vx")) / 0.03);
  EXPECT_EQ(of(observer, features, "knee_angle_l_acceleration"),
            (raw(now, "knee_angle_l_u") - raw(before, "knee_angle_l_u")) / 0.03);
  EXPECT_EQ(of(observer, features, "activation_soleus_r"), raw(now, "activation_soleus_r"));
  EXPECT_NEAR(of(observer, features, "phase_sin"), 1, 1e-15);
}

/// The training on mirrored samples is exact: mirroring commutes with the simulator and with the
/// features, the phase half a stride later.
TEST_F(Observation, OfAMirroredRunIsTheMirroredObservation) {
  environment::RunnerEnvironment other(osim::load_osim(osim::default_model_file()), {});
  environment::Observer observer(runner_.spec(), {.derived = true}, 0.03),
      other_observer(other.spec(), {.derived = true}, 0.03);
  const environment::Mirror features = environment::mirror_by_name(observer.names());
  const environment::Mirror actions = environment::mirror_by_name(runner_.spec().action_names);
  Eigen::VectorXd seen, other_seen, mirrored(static_cast<long>(observer.names().size()));
  Eigen::VectorXd action, other_action(18);
  observer.start(runner_.reset(1), 0.1, seen);
  other_observer.start(other.reset(1), 0.6, other_seen);
  for (int decision = 0; decision < 15; ++decision) {
    action = excitations(decision);
    actions.apply(action, other_action);
    double reward = 0, other_reward = 0;
    for (int i = 0; i < 3; ++i) {
      reward += runner_.step(action).reward;
      other_reward += other.step(other_action).reward;
    }
    const double phase = 0.1 + 0.04 * decision;
    observer.follow(runner_.step(action).observation, phase, seen);
    other_observer.follow(other.step(other_action).observation, phase + 0.5, other_seen);
    features.apply(seen, mirrored);
    EXPECT_NEAR(reward, other_reward, 1e-9);
    EXPECT_LT((mirrored - other_seen)
                  .cwiseQuotient(seen.cwiseAbs() + Eigen::VectorXd::Ones(seen.size()))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-7)
        << "decision " << decision;
    const Pose pose = runner_.pose().mirrored(), other_pose = other.pose();
    EXPECT_LT((pose.foot_r - other_pose.foot_r).norm(), 1e-9);
    EXPECT_LT((pose.knee_l - other_pose.knee_l).norm(), 1e-9);
  }
}

TEST(Observer, NamesWhatAnEnvironmentLacks) {
  const PointMass mass;
  EXPECT_ERROR(environment::Observer(mass.spec(), {}, 0.05), "observation 'pelvis_tx'");
}

}  // namespace
}  // namespace stride
