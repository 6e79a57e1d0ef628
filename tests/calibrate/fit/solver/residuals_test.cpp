#include "calibrate/fit/solver/residuals.h"

#include <gtest/gtest.h>

#include "calibrate/fit/solver/point_cost.h"
#include "tests/calibrate/synthetic.h"

namespace stride {
namespace {

/// Derivatives against central differences. (ceres::GradientChecker hands Eigen objects across the
/// border of a library that was compiled for another alignment.)
void check(const ceres::CostFunction& cost, const std::vector<const double*>& blocks) {
  const int rows = cost.num_residuals();
  const auto& sizes = cost.parameter_block_sizes();
  std::vector<std::vector<double>> at, jacobian;
  for (std::size_t block = 0; block < sizes.size(); ++block) {
    at.emplace_back(blocks[block], blocks[block] + sizes[block]);
    jacobian.emplace_back(rows * sizes[block]);
  }
  const auto evaluate = [&](std::vector<double*>* derivatives) {
    std::vector<const double*> pointers;
    for (const auto& each : at) pointers.push_back(each.data());
    std::vector<double> residuals(rows);
    EXPECT_TRUE(cost.Evaluate(pointers.data(), residuals.data(),
                              derivatives == nullptr ? nullptr : derivatives->data()));
    return residuals;
  };
  std::vector<double*> derivatives;
  for (auto& each : jacobian) derivatives.push_back(each.data());
  evaluate(&derivatives);
  for (std::size_t block = 0; block < sizes.size(); ++block)
    for (int k = 0; k < sizes[block]; ++k) {
      const double h = 1e-6, value = at[block][k];
      at[block][k] = value + h;
      const auto more = evaluate(nullptr);
      at[block][k] = value - h;
      const auto less = evaluate(nullptr);
      at[block][k] = value;
      for (int row = 0; row < rows; ++row) {
        const double slope = (more[row] - less[row]) / (2 * h);
        EXPECT_NEAR(jacobian[block][row * sizes[block] + k], slope, 1e-6 * (1 + std::abs(slope)))
            << "block " << block << " entry " << k;
      }
    }
}

TEST(Residuals, HaveTheDerivativesOfFiniteDifferences) {
  const SagittalModel model = default_sagittal_model();
  const Runner r = synthetic_runner();
  const double pelvis[2] = {3, 4}, ground[1] = {-0.9};
  const Directions directions(model);
  for (const BodyPart part : kBodyParts) {
    if (part == BodyPart::pelvis) continue;
    std::vector<const double*> blocks{
        r.camera.data(), r.cadence.data(), r.body.data(),  r.sides.data(),     r.tilt.data(),
        r.hip.data(),    r.knee.data(),    r.ankle.data(), r.asymmetry.data(), pelvis};
    if (is_heel(part)) {
      const double heel[2] = {-0.06, -0.05};
      blocks.push_back(heel);
      check(fit::HeelCost({part, directions, 4, 0.37, {20, -60}, 1.7}), blocks);
    } else {
      check(fit::PointCost({part, directions, 4, 0.37, {20, -60}, 1.7}), blocks);
    }
  }
  check(fit::AutomaticCost<fit::PelvisResidual>(new fit::PelvisResidual{{1, 2}, 1.5}), {pelvis});
  check(fit::AutomaticCost<fit::LegLengthResidual>(new fit::LegLengthResidual{0.85, 0.05}),
        {r.body.data()});
  check(fit::AutomaticCost<fit::ProportionResidual>(
            new fit::ProportionResidual{body::thigh, body::shank, 1, 0.15}),
        {r.body.data()});
  check(fit::AutomaticCost<fit::HipsResidual>(new fit::HipsResidual{0.01}), {r.body.data()});
  check(fit::AutomaticCost<fit::StanceResidual>(
            new fit::StanceResidual{BodyPart::toe_l, directions, 4, 0.2, 0.01, 0.02}),
        {r.body.data(), r.sides.data(), r.tilt.data(), r.hip.data(), r.knee.data(), r.ankle.data(),
         r.asymmetry.data(), ground});
}

TEST(Residuals, OfAJointLimitAreZeroInsideAndSlopeOutside) {
  const Runner r = synthetic_runner();
  const SagittalModel::Range narrow{-0.9, -0.5};  // the knee leaves it on both sides
  for (const double phase : {0.0, 0.25, 0.7}) {
    const double knee = evaluate_series(r.knee.data(), 3, phase);
    const fit::JointLimitResidual residual{3, phase, narrow, 0.1};
    double value = 0;
    residual(r.knee.data(), &value);
    EXPECT_NEAR(value, std::max({0.0, narrow.min - knee, knee - narrow.max}) / 0.1, 1e-12);
    check(fit::AutomaticCost<fit::JointLimitResidual>(new fit::JointLimitResidual(residual)),
          {r.knee.data()});
  }
}

TEST(Residuals, OfAPointAreTheSameWithAndWithoutTheChainRule) {
  const Runner r = synthetic_runner();
  const double pelvis[2] = {3, 4};
  const fit::PointResidual residual{
      BodyPart::toe_l, Directions(default_sagittal_model()), 5, -0.8, {20, -60}, 1.7};
  const std::vector<const double*> blocks{
      r.camera.data(), r.cadence.data(), r.body.data(),  r.sides.data(),     r.tilt.data(),
      r.hip.data(),    r.knee.data(),    r.ankle.data(), r.asymmetry.data(), pelvis};
  const fit::AutomaticCost<fit::PointResidual> automatic(new fit::PointResidual(residual));
  const fit::PointCost chained(residual);
  std::vector<std::vector<double>> a, b;
  std::vector<double*> to_a, to_b;
  for (const int size : automatic.parameter_block_sizes()) {
    a.emplace_back(2 * size);
    b.emplace_back(2 * size);
  }
  for (auto& each : a) to_a.push_back(each.data());
  for (auto& each : b) to_b.push_back(each.data());
  double ra[2], rb[2];
  automatic.Evaluate(blocks.data(), ra, to_a.data());
  chained.Evaluate(blocks.data(), rb, to_b.data());
  EXPECT_NEAR(ra[0], rb[0], 1e-12);
  for (std::size_t block = 0; block < a.size(); ++block)
    for (std::size_t k = 0; k < a[block].size(); ++k)
      EXPECT_NEAR(a[block][k], b[block][k], 1e-9 * (1 + std::abs(a[block][k])))
          << "block " << block << " entry " << k;
}

}  // namespace
}  // namespace stride
