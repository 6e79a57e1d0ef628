#include "train/simulation/engine/engine.h"
#include "train/simulation/engine/runner_layout.h"
#include "train/simulation/make_engine.h"

#include <gtest/gtest.h>

#include "tests/support/throws.h"
#include "tests/train/engines.h"
#include "train/simulation/simbody/simbody_engine.h"

namespace stride {
namespace {

using EngineStatics = EachEngine;
INSTANTIATE_FOR_EACH_ENGINE(EngineStatics);

// OpenSim's figures have twelve digits; tolerances are what those leave.

TEST_P(EngineStatics, MassMatrixIsOpenSims) {
  const Reference poses("static_poses.csv"), recorded("static_massmatrix.csv");
  const auto engine = skeleton();
  for (std::size_t row = 0; row < recorded.rows.size(); ++row) {
    engine->set_state(recorded_pose(model_, poses, row));
    const auto found = engine->mass_matrix();
    for (int i = 0; i < simulation::kCoordinates; ++i)
      for (int j = 0; j < simulation::kCoordinates; ++j)
        EXPECT_TRUE(close(found[i * simulation::kCoordinates + j],
                          recorded.number(row, fmt::format("M_{}_{}", i, j)), 1e-9, 1e-10))
            << "pose " << row << ", element " << i << "," << j;
  }
}

TEST_P(EngineStatics, AccelerationsUnderGravityAreOpenSims) {
  const Reference poses("static_poses.csv"), recorded("static_bias.csv");
  const auto engine = skeleton();
  for (std::size_t row = 0; row < recorded.rows.size(); ++row) {
    engine->set_state(recorded_pose(model_, poses, row));
    const simulation::RunnerDerivative found = engine->derivative({});
    for (int i = 0; i < simulation::kCoordinates; ++i) {
      const std::string name =
          model_.coordinates[simulation::runner_layout(model_).coordinate[i]].name;
      EXPECT_TRUE(close(found.udot[i],
                        recorded.number(row, name + "_udot_gravity_only_rad_s2_or_m_s2"), 1e-9,
                        1e-8))
          << "pose " << row << ", " << name;
    }
  }
}

TEST_P(EngineStatics, BodiesAndCentreOfMassAreOpenSims) {
  const Reference poses("static_poses.csv"), recorded("static_bodies.csv");
  const auto engine = skeleton();
  int compared = 0;
  for (std::size_t row = 0; row < recorded.rows.size(); ++row) {
    engine->set_state(
        recorded_pose(model_, poses, static_cast<std::size_t>(recorded.number(row, "pose_id"))));
    const simulation::RunnerKinematics found = engine->kinematics();
    const std::string name = recorded.text(row, "body");
    simulation::RunnerKinematics::Frame frame{found.com, found.com_velocity, 0, 0};
    if (const int body = model_.body(name); body >= 0) frame = found.bodies[body];
    EXPECT_TRUE(close(frame.position.x, recorded.number(row, "x_m"), 1e-11, 1e-11)) << name;
    EXPECT_TRUE(close(frame.position.y, recorded.number(row, "y_m"), 1e-11, 1e-11)) << name;
    EXPECT_TRUE(close(frame.velocity.x, recorded.number(row, "vx_m_s"), 1e-11, 1e-10)) << name;
    EXPECT_TRUE(close(frame.velocity.y, recorded.number(row, "vy_m_s"), 1e-11, 1e-10)) << name;
    if (model_.body(name) >= 0) {
      const double turn = frame.angle_rad - recorded.number(row, "angle_z_rad");
      EXPECT_NEAR(std::remainder(turn, 2 * M_PI), 0, 2e-11) << name;
      EXPECT_TRUE(close(frame.omega_rad_s, recorded.number(row, "omega_z_rad_s"), 1e-11, 1e-11));
    }
    ++compared;
  }
  EXPECT_GT(compared, 500);
}

TEST_P(EngineStatics, MusclePathsAreOpenSims) {
  const Reference poses("static_poses.csv"), recorded("static_muscle.csv");
  const auto engine = skeleton();
  std::size_t pose = std::string::npos;
  simulation::RunnerKinematics found;
  for (std::size_t row = 0; row < recorded.rows.size(); ++row) {
    const auto wanted = static_cast<std::size_t>(recorded.number(row, "pose_id"));
    if (wanted != pose) {
      engine->set_state(recorded_pose(model_, poses, pose = wanted));
      found = engine->kinematics();
    }
    const auto& names = simulation::muscle_names();
    const auto muscle =
        std::find(names.begin(), names.end(), recorded.text(row, "muscle")) - names.begin();
    EXPECT_TRUE(
        close(found.muscle_length_m[muscle], recorded.number(row, "mtu_length_m"), 1e-11, 1e-11))
        << "pose " << pose << ", " << names[muscle];
  }
}

// The recorded cases drop the force of a foot's second contact when its first one pulls (O2).
void expect_recorded_reactions(simulation::Engine& engine, const osim::Model& model,
                               const char* file) {
  const Reference recorded(file);
  for (std::size_t row = 0; row < recorded.rows.size(); ++row) {
    engine.set_state(recorded_pose(model, recorded, row));
    const simulation::Planar force = engine.kinematics().ground_reaction_N[0];
    EXPECT_TRUE(close(force.x, recorded.number(row, "GRF_x_N"), 1e-9, 1e-7)) << "row " << row;
    EXPECT_TRUE(close(force.y, recorded.number(row, "GRF_y_N"), 1e-9, 1e-7)) << "row " << row;
  }
}

TEST_P(EngineStatics, GroundReactionIsOpenSimsWithEveryContact) {
  expect_recorded_reactions(*engine(), model_, "contact_foot_continue.csv");
}

TEST_P(EngineStatics, GroundReactionIsTheCompetitionsWithDroppedContacts) {
  simulation::EngineOptions options;
  options.drop_contacts = true;
  expect_recorded_reactions(*engine(options), model_, "contact_foot.csv");
}

TEST_P(EngineStatics, DerivativesAreTheLawsOfMotion) {
  // A muscle's strength scales the force it adds; at rest gravity alone moves the runner.
  const auto strong = engine(), weak = engine(), none = engine();
  simulation::RunnerState state = simulation::default_state(model_);
  state.q[2] = 3;  // in the air
  for (auto* each : {strong.get(), weak.get(), none.get()}) {
    each->set_state(state);
    each->equilibrate_fibers();
  }
  for (int i = 0; i < simulation::kMuscles; ++i)
    weak->set_strength(i, 0.5), none->set_strength(i, 0);
  const auto a = strong->derivative({}).udot, b = weak->derivative({}).udot,
             c = none->derivative({}).udot;
  for (int i = 0; i < simulation::kCoordinates; ++i) {
    EXPECT_NEAR(b[i], (a[i] + c[i]) / 2, 1e-9);
    EXPECT_NEAR(c[i], i == 2 ? -9.80665 : 0, 1e-9);
  }
}

TEST_P(EngineStatics, EquilibratedFibersStandStill) {
  const auto engine = this->engine();
  engine->set_state(simulation::default_state(model_));
  engine->equilibrate_fibers();
  for (double speed : engine->derivative({}).fiber_velocity_m_s) EXPECT_NEAR(speed, 0, 1e-9);
}

TEST(Engine, UnknownNameIsNamedWithTheKnownOnes) {
  const osim::Model model = osim::load_osim(osim::default_model_file());
  EXPECT_ERROR(simulation::make_engine("mujoco", model),
               "engine \"mujoco\": there is none of this name");
}

TEST(Engine, ModelWithoutTheRunnersPartsIsRefused) {
  osim::Model model = osim::load_osim(osim::default_model_file());
  model.muscles.pop_back();
  EXPECT_ERROR(simulation::make_engine("simbody", model), "has 17 muscles; a runner has 18");
  model = osim::load_osim(osim::default_model_file());
  model.coordinates[model.coordinate("lumbar_extension")].locked = false;
  EXPECT_ERROR(simulation::make_engine("simbody", model),
               "lumbar_extension is not one of the runner's");
  model = osim::load_osim(osim::default_model_file());
  model.joints[1].orientation_in_parent_rad = {0.1, 0, 0};
  EXPECT_ERROR(simulation::make_engine("simbody", model), "out of the sagittal plane");
}

// Debian's libsimbody is built without NDEBUG and lays out its state accordingly.
TEST(SimbodyEngine, IsCompiledWithoutNdebug) {
  EXPECT_FALSE(simbody::simbody_engine_defines_ndebug());
}

}  // namespace
}  // namespace stride
