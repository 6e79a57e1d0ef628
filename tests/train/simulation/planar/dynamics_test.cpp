#include "train/simulation/planar/dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/throws.h"
#include "tests/train/engines.h"
#include "train/simulation/laws/contact.h"
#include "train/simulation/laws/muscle.h"
#include "train/simulation/make_engine.h"
#include "train/simulation/planar/muscles.h"
#include "train/simulation/planar/planar_engine.h"

namespace stride {
namespace {

/// Varied states: falling, standing and pressed into the ground, at joint limits, close to every
/// path point's switch, on obstacles; fibres slack, taut and at their minimum length.
class RandomStates {
 public:
  explicit RandomStates(const osim::Model& model)
      : model_(model), layout_(simulation::runner_layout(model)) {
    for (const osim::Muscle& muscle : model.muscles) {
      for (const osim::PathPoint& point : muscle.path) {
        if (point.kind != osim::PathPoint::Kind::conditional) continue;
        switches_.push_back({point.coordinate, point.range_min});
        switches_.push_back({point.coordinate, point.range_max});
      }
    }
  }

  double between(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>()(random_);
  }

  simulation::RunnerState next(simulation::Engine& engine) {
    simulation::RunnerState s;
    s.q[0] = between(-1.5, 1.5);
    s.q[1] = between(-3, 8);
    for (int leg = 0; leg < 2; ++leg) {
      s.q[3 + 3 * leg] = between(-2.2, 2.2);
      s.q[4 + 3 * leg] = between(-2.7, 0.5);
      s.q[5 + 3 * leg] = between(-1.2, 1.2);
    }
    if (pick(3) == 0) at_a_switch(s);
    for (double& u : s.u) u = between(-8, 8);
    s.q[2] = between(0.3, 1.4);
    if (pick(2) == 0) onto_the_ground(engine, s);
    for (int i = 0; i < simulation::kMuscles; ++i) s.activation[i] = between(-0.1, 1);
    engine.set_state(s);
    const simulation::RunnerKinematics k = engine.kinematics();
    for (int i = 0; i < simulation::kMuscles; ++i) {
      const laws::MuscleLaw law(model_.muscles[layout_.muscle[i]]);
      const double strain = between(-0.05, 0.09);
      const double along = k.muscle_length_m[i] - (1 + strain) * law.tendon_slack_m;
      s.fiber_length_m[i] = pick(10) == 0 ? law.minimum_length_m * between(0.9, 1.1)
                                          : std::hypot(std::max(along, 1e-3), law.width_m);
    }
    engine.set_state(s);
    return s;
  }

  std::vector<simulation::Obstacle> obstacles() {
    std::vector<simulation::Obstacle> all;
    for (int i = 0; i < 20; ++i)
      all.push_back({0.5 * i - 2, between(-0.1, 0.1), between(0.05, 0.3)});
    return all;
  }

 private:
  int pick(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }

  void at_a_switch(simulation::RunnerState& s) {
    const auto [coordinate, angle] = switches_[pick(static_cast<int>(switches_.size()))];
    for (int i = 0; i < simulation::kCoordinates; ++i) {
      if (layout_.coordinate[i] == coordinate) s.q[i] = angle + between(-3e-5, 3e-5);
    }
  }

  /// Lowers the runner until its lowest sphere is up to 6 cm deep.
  void onto_the_ground(simulation::Engine& engine, simulation::RunnerState& s) {
    engine.set_state(s);
    const simulation::RunnerKinematics k = engine.kinematics();
    double lowest = 1e9;
    for (const osim::ContactSphere& sphere : model_.spheres) {
      const simulation::RunnerKinematics::Frame& f = k.bodies[sphere.body];
      lowest = std::min(lowest, f.position.y + std::sin(f.angle_rad) * sphere.location_m[0] +
                                    std::cos(f.angle_rad) * sphere.location_m[1] - sphere.radius_m);
    }
    s.q[2] -= lowest + between(0, 0.06);
  }

  const osim::Model& model_;
  simulation::RunnerLayout layout_;
  std::vector<std::pair<int, double>> switches_;
  std::mt19937_64 random_{20170924};
};

/// Largest difference relative to the largest of the vector: accelerations are one solution.
template <typename Vector>
double relative_difference(const Vector& a, const Vector& b) {
  double difference = 0, size = 1e-3;
  for (std::size_t i = 0; i < a.size(); ++i) {
    difference = std::max(difference, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(b[i]));
    if (!std::isfinite(a[i]) || !std::isfinite(b[i])) return 1e9;
  }
  return difference / size;
}

void expect_agreement(const simulation::EngineOptions& options) {
  const osim::Model model = osim::load_osim(osim::default_model_file());
  const auto reference = simulation::make_engine("simbody", model, options);
  const auto planar = planar::make_planar_engine(model, options);
  RandomStates states(model);
  const std::vector<simulation::Obstacle> obstacles = states.obstacles();
  reference->set_obstacles(obstacles), planar->set_obstacles(obstacles);
  int loaded = 0, limited = 0;
  for (int n = 0; n < 10000; ++n) {
    planar->set_state(states.next(*reference));
    simulation::Excitations excitations;
    for (double& e : excitations) e = states.between(0, 1);
    const simulation::RunnerDerivative a = planar->derivative(excitations),
                                       b = reference->derivative(excitations);
    ASSERT_LE(relative_difference(a.udot, b.udot), 1e-8) << n;
    ASSERT_LE(relative_difference(a.activation_rate, b.activation_rate), 1e-12) << n;
    ASSERT_LE(relative_difference(a.fiber_velocity_m_s, b.fiber_velocity_m_s), 1e-8) << n;
    const simulation::RunnerKinematics k = planar->kinematics(), l = reference->kinematics();
    loaded += k.ground_reaction_N[0].y > 0 || k.ground_reaction_N[1].y > 0;
    limited += k.limit_torque_Nm != decltype(k.limit_torque_Nm){};
    ASSERT_LE(relative_difference(k.limit_torque_Nm, l.limit_torque_Nm), 1e-10) << n;
    ASSERT_LE(relative_difference(k.tendon_force_N, l.tendon_force_N), 1e-9) << n;
    ASSERT_NEAR(k.energy_J, l.energy_J, 1e-9 * std::abs(l.energy_J));
  }
  EXPECT_GT(loaded, 3000);
  EXPECT_GT(limited, 3000);
}

TEST(PlanarDynamics, AgreesWithSimbodyOnRandomStates) { expect_agreement({}); }

TEST(PlanarDynamics, AgreesWithSimbodyUnderTheCompetitionsContacts) {
  simulation::EngineOptions options;
  options.drop_contacts = true;
  options.nominal_obstacles = true;
  expect_agreement(options);
}

TEST(PlanarDynamics, AgreesWithSimbodyWhereAShareOfTheForceIsDropped) {
  simulation::EngineOptions options;
  options.drop_contacts = true;
  options.drop_share = 0.4;
  expect_agreement(options);
}

TEST(PlanarDynamics, KnowsHowFastFibersReturn) {
  const osim::Model model = osim::load_osim(osim::default_model_file());
  const planar::PlanarModel planar = planar::planar_model(model);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int n = 0; n < 2000; ++n) {
    const planar::PlanarModel::Muscles& m = planar.muscles[n % 5];
    simd::V4 a, path, length;
    for (int i = 0; i < 4; ++i) {
      a[i] = 0.01 + 0.99 * uniform(random);
      length[i] = (0.5 + uniform(random)) / m.optimal_inverse[i];
      path[i] = std::sqrt(length[i] * length[i] - m.width2[i]) +
                (0.95 + 0.15 * uniform(random)) / m.slack_inverse[i];
    }
    const simd::V4 h = length * 1e-7;
    const simd::V4 slope = (planar::muscle_group<true>(m, a, length + h, path).fiber_velocity_m_s -
                            planar::muscle_group<true>(m, a, length - h, path).fiber_velocity_m_s) /
                           (2 * h);
    const planar::MuscleGroup found = planar::muscle_group<true>(m, a, length, path);
    for (int i = 0; i < 4; ++i) {
      // Away from the corners of the curves, where a difference straddles two slopes.
      const double straddled =
          std::abs(planar::muscle_group<true>(m, a, length + 2 * h, path).fiber_1_s[i] -
                   planar::muscle_group<true>(m, a, length - 2 * h, path).fiber_1_s[i]);
      EXPECT_NEAR(found.fiber_1_s[i], slope[i], 1e-4 * std::abs(slope[i]) + straddled + 1e-6);
    }
  }
}

TEST(PlanarModel, RefusesWhatItCannotRepresentWithTheReasonAndTheCure) {
  const osim::Model model = osim::load_osim(osim::default_model_file());
  osim::Model other = model;
  other.joints[other.joints.size() - 1].orientation_in_child_rad[2] = 0.1;
  EXPECT_ERROR(planar::planar_model(other), "is turned against its bodies; use --engine simbody");
  other = model;
  other.muscles[other.muscle("rect_fem_r")].path.pop_back();
  EXPECT_ERROR(planar::planar_model(other), "the other leg's path has other points");
  other = model;
  other.contacts[1].stiffness *= 2;
  EXPECT_ERROR(planar::planar_model(other), "is of another material");
  other = model;
  other.spheres[0].body = other.body("pelvis");
  EXPECT_ERROR(planar::planar_model(other), "is not on a foot");
}

}  // namespace
}  // namespace stride
