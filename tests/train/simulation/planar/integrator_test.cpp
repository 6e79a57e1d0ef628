#include "train/simulation/planar/integrator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/train/engines.h"
#include "tests/train/rollout.h"
#include "train/simulation/integration/rosenbrock.h"
#include "train/simulation/planar/engine.h"

namespace stride {
namespace {

using Row = integration::Rosenbrock::Row;

Row times(const integration::Rosenbrock::Square& m, const Row& v) {
  Row result{};
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) result[i] += m[i][j] * v[j];
  }
  return result;
}

double dot(const Row& a, const Row& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

TEST(Rosenbrock, MeetsTheConditionsOfThirdOrderForAnyJacobian) {
  const Row one{1, 1, 1, 1};
  const Row alpha = times(integration::Rosenbrock::kAlpha, one),
            gamma = times(integration::Rosenbrock::kGammas, one);
  const Row& b = integration::Rosenbrock::kWeight;
  Row squared;
  for (int i = 0; i < 4; ++i) squared[i] = alpha[i] * alpha[i];
  EXPECT_NEAR(dot(b, one), 1, 1e-15);
  EXPECT_NEAR(dot(b, alpha), 1.0 / 2, 1e-15);
  EXPECT_NEAR(dot(b, squared), 1.0 / 3, 1e-15);
  EXPECT_NEAR(dot(b, times(integration::Rosenbrock::kAlpha, alpha)), 1.0 / 6, 1e-15);
  // What the Jacobian brings in must cancel.
  EXPECT_NEAR(dot(b, gamma), 0, 1e-15);
  EXPECT_NEAR(dot(b, times(integration::Rosenbrock::kAlpha, gamma)), 0, 1e-15);
  EXPECT_NEAR(dot(b, times(integration::Rosenbrock::kGammas, alpha)), 0, 1e-15);
  EXPECT_NEAR(dot(b, times(integration::Rosenbrock::kGammas, gamma)), 0, 1e-15);
  EXPECT_NEAR(dot(integration::Rosenbrock::kEmbedded, one), 1, 1e-15);
  EXPECT_NEAR(dot(integration::Rosenbrock::kEmbedded, alpha), 1.0 / 2, 1e-15);
  EXPECT_NEAR(dot(integration::Rosenbrock::kEmbedded, gamma), 0, 1e-15);
}

class Integration : public ::testing::Test {
 protected:
  /// Coordinates every 0.01 s under the recorded random excitations, from equilibrium.
  std::vector<std::array<double, simulation::kCoordinates>> roll(
      const simulation::EngineOptions& options, double period_s,
      const std::string& scenario) const {
    const auto engine = planar::make_planar_engine(model_, options);
    engine->set_state(simulation::default_state(model_));
    engine->equilibrate_fibers();
    std::vector<std::array<double, simulation::kCoordinates>> all;
    const int pieces = static_cast<int>(std::lround(0.01 / period_s));
    for (const simulation::Excitations& e : recorded_excitations(scenario)) {
      for (int i = 0; i < std::max(pieces, 1); ++i) {
        const simulation::AdvanceReport report = engine->advance(e, period_s);
        EXPECT_TRUE(report.ok) << report.failure;
      }
      all.push_back(engine->state().q);
      if (engine->state().q[2] < 0.65) break;
    }
    return all;
  }
  static double difference(const std::vector<std::array<double, simulation::kCoordinates>>& a,
                           const std::vector<std::array<double, simulation::kCoordinates>>& b) {
    double worst = 0;
    for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n) {
      for (int i = 0; i < simulation::kCoordinates; ++i)
        worst = std::max(worst, std::abs(a[n][i] - b[n][i]));
    }
    return worst;
  }
  static simulation::EngineOptions accuracy(double a) {
    simulation::EngineOptions options;
    options.accuracy = a;
    return options;
  }
  const osim::Model model_ = osim::load_osim(osim::default_model_file());
};

TEST_F(Integration, ConvergesToTheReferenceByEitherMethod) {
  const auto reference = roll(accuracy(1e-8), 0.01, "random_seed1");
  EXPECT_LE(difference(roll(accuracy(1e-2), 0.01, "random_seed1"), reference), 1e-2);
  EXPECT_LE(difference(roll(accuracy(1e-3), 0.01, "random_seed1"), reference), 1e-3);
  EXPECT_LE(difference(roll(accuracy(1e-4), 0.01, "random_seed1"), reference), 2e-4);  // implicit
  EXPECT_LE(difference(roll(accuracy(9e-5), 0.01, "random_seed1"), reference), 1e-4);  // explicit
  EXPECT_LE(difference(roll(accuracy(1e-6), 0.01, "random_seed1"), reference), 1e-5);
}

TEST_F(Integration, FixedStepsConvergeToo) {
  const auto reference = roll(accuracy(1e-8), 0.01, "all005");
  simulation::EngineOptions options;
  options.fixed_step = true;
  options.fixed_step_s = 1e-3;
  const double coarse = difference(roll(options, 0.01, "all005"), reference);
  options.fixed_step_s = 1e-4;
  const double fine = difference(roll(options, 0.01, "all005"), reference);
  EXPECT_LE(coarse, 3e-2);
  EXPECT_LE(fine, coarse / 5);
}

TEST_F(Integration, DoesNotDependOnHowTheTimeIsCutIntoCalls) {
  const auto whole = roll(accuracy(1e-7), 0.01, "random_seed1");
  const auto parts = roll(accuracy(1e-7), 0.0025, "random_seed1");
  EXPECT_LE(difference(whole, parts), 1e-5);
}

TEST_F(Integration, AFailureIsAValueAndKeepsTheLastGoodState) {
  simulation::EngineOptions options;
  options.max_evaluations = 7;
  const auto engine = planar::make_planar_engine(model_, options);
  const simulation::RunnerState before = engine->state();
  const simulation::AdvanceReport report = engine->advance(simulation::Excitations{}, 0.01);
  EXPECT_FALSE(report.ok);
  EXPECT_EQ(report.failure, "the evaluations ran out");
  EXPECT_EQ(engine->state().q, before.q);
  EXPECT_EQ(engine->state().time_s, before.time_s);

  simulation::RunnerState broken = before;
  broken.u[4] = std::nan("");
  const auto other = planar::make_planar_engine(model_, simulation::EngineOptions{});
  other->set_state(broken);
  EXPECT_FALSE(other->advance(simulation::Excitations{}, 0.01).ok);
  other->set_state(before);
  EXPECT_TRUE(other->advance(simulation::Excitations{}, 0.01).ok);
}

TEST_F(Integration, StrangeStatesEndInAValueToo) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto engine = planar::make_planar_engine(model_, simulation::EngineOptions{});
  engine->set_obstacles({{0, 0, 0.3}, {0.5, 0, 0.1}});
  for (int n = 0; n < 100; ++n) {
    simulation::RunnerState s = simulation::default_state(model_);
    const double wild = std::pow(10, 3 * uniform(random));
    for (double& q : s.q) q += wild * uniform(random);
    for (double& u : s.u) u += 10 * wild * uniform(random);
    for (double& l : s.fiber_length_m) l = std::abs(0.3 * uniform(random));
    engine->set_state(s);
    simulation::Excitations e;
    for (double& x : e) x = uniform(random);
    for (int i = 0; i < 5 && engine->advance(e, 0.01).ok; ++i) {
      for (double q : engine->state().q) ASSERT_TRUE(std::isfinite(q));
    }
  }
}

}  // namespace
}  // namespace stride
