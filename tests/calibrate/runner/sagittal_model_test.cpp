#include "calibrate/runner/sagittal_model.h"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <array>

#include "extract/io/table.h"
#include "tests/calibrate/synthetic.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

TEST(SagittalModel, PlacesEveryPartWhereOpenSimDoes) {
  const SagittalModel model = default_sagittal_model();
  const Table poses = load_csv(STRIDE_TEST_DATA "/opensim_bodies.csv");
  ASSERT_EQ(poses.rows.size(), 40u);
  for (const auto& row : poses.rows) {
    CalibratedSample sample;
    for (std::size_t i = 0; i < kCoordinateNames.size(); ++i)
      sample.coordinates[i] = row[poses.column(kCoordinateNames[i])];
    place_parts(model, sample);
    const Eigen::Vector2d p_pelvis(sample.coordinates[1], sample.coordinates[2]);
    for (const BodyPartRow& part : kBodyPartRows) {
      const auto at = [&](const std::string& body) {
        return Eigen::Vector2d(row[poses.column(body + "_x")], row[poses.column(body + "_y")]);
      };
      // calcn was not recorded: beside the line from talus to toes, as in the model's file.
      const auto calcn = [&](const std::string& side) -> Eigen::Vector2d {
        const Eigen::Vector2d toes = at("toes" + side) - at("talus" + side),
                              own = model.p_talus_toes_m;
        const double c = own.dot(toes) / own.squaredNorm(),
                     s = (own.x() * toes.y() - own.y() * toes.x()) / own.squaredNorm();
        return at("talus" + side) +
               Eigen::Vector2d(c * -0.04877 + s * 0.04195, s * -0.04877 - c * 0.04195);
      };
      const std::string body(part.osim_body);
      const Eigen::Vector2d opensim = body == "pelvis"     ? p_pelvis
                                      : is_heel(part.part) ? calcn(body.substr(5))
                                                           : at(body);
      EXPECT_LT((p_pelvis + sample[part.part] - opensim).norm(), 1e-9)
          << part.name;  // 12 digits recorded
    }
  }
}

TEST(SagittalModel, DifferentiatesLikeFiniteDifferences) {
  using Jet = ceres::Jet<double, 4>;
  const SagittalModel model = default_sagittal_model();
  const std::array<double, 4> q{-0.1, 0.6, -1.3, 0.2};
  const auto toe = [&](std::array<double, 4> at) {
    return place_leg(model, at[0], at[1], at[2], at[3]).toe;
  };
  const Leg<Jet> leg = place_leg(model, Jet(q[0], 0), Jet(q[1], 1), Jet(q[2], 2), Jet(q[3], 3));
  EXPECT_EQ(leg.toe.x().a, toe(q).x());
  for (int i = 0; i < 4; ++i) {
    const double h = 1e-6;
    auto more = q, less = q;
    more[i] += h;
    less[i] -= h;
    const Eigen::Vector2d slope = (toe(more) - toe(less)) / (2 * h);
    EXPECT_NEAR(leg.toe.x().v[i], slope.x(), 1e-8);
    EXPECT_NEAR(leg.toe.y().v[i], slope.y(), 1e-8);
  }
}

TEST(SagittalModel, KnowsTheLimitsAndTheSoleOfTheModel) {
  const SagittalModel model = default_sagittal_model();
  const double degree = M_PI / 180;
  EXPECT_NEAR(model.hip.min, -40 * degree, 1e-6);
  EXPECT_NEAR(model.hip.max, 130 * degree, 1e-6);  // the limits, not the narrower ranges
  EXPECT_NEAR(model.knee.min, -150 * degree, 1e-6);
  EXPECT_NEAR(model.knee.max, 20 * degree, 1e-6);
  EXPECT_NEAR(model.ankle.min, -50 * degree, 1e-6);
  EXPECT_NEAR(model.ankle.max, 30 * degree, 1e-6);
  ASSERT_EQ(model.spheres.size(), 2u);
  // The competition's start, whose heels are 2.8 cm and whose toes are 3.9 cm in the floor.
  const auto leg = place_leg(model, -0.05, 0.0, 0.0, 0.0);
  EXPECT_NEAR(0.91 + lowest_point(model, leg), -0.039, 0.001);
}

TEST(SagittalModel, SaysWhatAModelLacks) {
  osim::Model model = osim::load_osim(osim::default_model_file());
  model.bodies[model.body("talus_r")].name = "hoof";
  EXPECT_ERROR(sagittal_model(model), "model gait9dof18musc: body 'talus_r' is missing");
}

}  // namespace
}  // namespace stride
