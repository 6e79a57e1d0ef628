#include "train/simulation/laws/muscle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/train/reference.h"

namespace stride {
namespace {

// Of what OpenSim wrote with twelve digits.
constexpr double kDigits = 1e-11;

class MuscleLaws : public ::testing::Test {
 protected:
  const laws::MuscleLaw law(const std::string& name) const {
    return laws::MuscleLaw(model_.muscles[model_.muscle(name)]);
  }
  osim::Model model_ = osim::load_osim(osim::default_model_file());
};

TEST_F(MuscleLaws, ForceLengthIsOpenSims) {
  const Reference r("muscle_force_length.csv");
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    const laws::MuscleLaw m = law(r.text(i, "muscle"));
    const double l = r.number(i, "norm_fiber_length");
    const laws::Slope fal = laws::active_force_length(m, l), fpe = laws::passive_force_length(m, l);
    ASSERT_TRUE(close(fal.value, r.number(i, "fal"), kDigits)) << i;
    ASSERT_TRUE(close(fal.derivative, r.number(i, "dfal"), kDigits, 1e-15)) << i;
    ASSERT_TRUE(close(fpe.value, r.number(i, "fpe"), kDigits, 1e-15)) << i;
    ASSERT_TRUE(close(fpe.derivative, r.number(i, "dfpe"), kDigits)) << i;
    const double cosine = laws::cos_pennation(m, l * m.optimal_length_m);
    ASSERT_TRUE(close(cosine, std::cos(r.number(i, "pennation_rad")), 0, kDigits)) << i;
  }
}

TEST_F(MuscleLaws, TendonIsOpenSims) {
  const Reference r("muscle_tendon.csv");
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    const laws::Slope f =
        laws::tendon_force(law(r.text(i, "muscle")), r.number(i, "tendon_strain"));
    // OpenSim forms (1 + strain) - 1 first: 1e-16 absolute in strain, 2e-15 in force.
    ASSERT_TRUE(close(f.value, r.number(i, "norm_tendon_force"), kDigits, 1e-14)) << i;
    ASSERT_TRUE(close(f.derivative, r.number(i, "d_norm_tendon_force"), kDigits)) << i;
  }
}

TEST_F(MuscleLaws, ForceVelocityIsOpenSimsInBothDirections) {
  const Reference r("muscle_force_velocity.csv");
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    const double a = r.number(i, "activation"), fal = r.number(i, "fal");
    const double speed = laws::fiber_speed(law(r.text(i, "muscle")), a, fal,
                                           r.number(i, "fv_multiplier_in") * a * fal)
                             .value;
    ASSERT_TRUE(close(speed, r.number(i, "norm_fiber_velocity_from_calcdlceN"), kDigits, 1e-15));
  }
  const Reference inverse("muscle_force_velocity_inv.csv");
  for (std::size_t i = 0; i < inverse.rows.size(); ++i) {
    const double fv =
        laws::force_velocity(law(inverse.text(i, "muscle")), inverse.number(i, "activation"),
                             inverse.number(i, "fal"), inverse.number(i, "norm_fiber_velocity_in"));
    // OpenSim inverts with Newton steps up to a tolerance.
    ASSERT_TRUE(close(fv, inverse.number(i, "fv_multiplier_from_calcfvInv"), 1e-8, 1e-8)) << i;
  }
}

TEST_F(MuscleLaws, ActivationRateIsOpenSims) {
  const Reference r("muscle_activation_rate.csv");
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    const double rate = laws::activation_rate(
        law(r.text(i, "muscle")), r.number(i, "raw_activation"), r.number(i, "excitation"));
    ASSERT_TRUE(close(rate, r.number(i, "dadt_1_s"), kDigits, 1e-14)) << i;
  }
}

TEST_F(MuscleLaws, FiberVelocityAndTendonForceAreOpenSims) {
  const Reference r("muscle_fiber_velocity.csv");
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    const laws::MuscleLaw m = law(r.text(i, "muscle"));
    const laws::MuscleForces f = laws::muscle_forces(
        m, r.number(i, "activation"), r.number(i, "fiber_length_m"), r.number(i, "mtu_length_m"));
    // The file rounds lengths to 5e-13 m, and a tendon of slack length ls turns that into
    // stiffness/ls · 5e-13 of force; a fibre at low activation into up to 500 times that of speed.
    const double force = m.linear_stiffness / m.tendon_slack_m * 1e-12;
    const double active = r.number(i, "activation") * f.fal;
    const double speed = 5 / active * (force / f.cos_pennation + 1e-12 * (1 + f.fpe * 20));
    ASSERT_TRUE(
        close(f.tendon_force_N, r.number(i, "tendon_force_N"), kDigits, force * m.max_force_N));
    ASSERT_TRUE(close(f.fiber_velocity_m_s, r.number(i, "fiber_velocity_m_s"), kDigits,
                      speed * m.max_speed_m_s))
        << i << " " << r.text(i, "muscle");
    ASSERT_EQ(f.clamped, r.number(i, "fiber_clamped") != 0);
  }
}

TEST_F(MuscleLaws, EquilibriumIsOpenSims) {
  const Reference r("muscle_equilibrium.csv");
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    const laws::MuscleLaw m = law(r.text(i, "muscle"));
    const double a = r.number(i, "activation"), path = r.number(i, "mtu_length_m");
    const double length = laws::equilibrium_fiber_length(m, a, path);
    const laws::MuscleForces f = laws::muscle_forces(m, a, length, path);
    ASSERT_NEAR(f.fiber_velocity_m_s, 0, 1e-9) << i;
    // OpenSim's Newton steps end at 1e-8 of the maximum force; on the flattest part of the curves
    // that is 5e-8 of the length.
    ASSERT_TRUE(close(length, r.number(i, "fiber_length_m"), 1e-7))
        << i << r.text(i, "muscle") << a;
    ASSERT_TRUE(close(f.tendon_force_N, r.number(i, "tendon_force_N"), 0, 1e-7 * m.max_force_N));
  }
}

TEST_F(MuscleLaws, ForceVelocityInvertsFiberSpeed) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const laws::MuscleLaw m(model_.muscles[i % model_.muscles.size()]);
    const double a = 0.01 + 0.99 * uniform(random), fal = 0.05 + 0.95 * uniform(random);
    const double fv = 2.5 * uniform(random) - 0.5;
    const laws::Slope speed = laws::fiber_speed(m, a, fal, fv * a * fal);
    EXPECT_TRUE(close(laws::force_velocity(m, a, fal, speed.value), fv, 1e-12, 1e-12));
    const double h = 1e-6 * a * fal;
    const double slope = (laws::fiber_speed(m, a, fal, fv * a * fal + h).value -
                          laws::fiber_speed(m, a, fal, fv * a * fal - h).value) /
                         (2 * h);
    EXPECT_TRUE(close(speed.derivative, slope, 1e-4)) << fv;
  }
}

}  // namespace
}  // namespace stride
