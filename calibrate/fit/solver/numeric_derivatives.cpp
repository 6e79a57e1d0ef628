#include <ceres/dynamic_numeric_diff_cost_function.h>

#include <memory>

#include "calibrate/fit/solver/add_residual.h"

namespace stride::fit {
namespace {

struct Values {
  std::unique_ptr<ceres::CostFunction> cost;

  bool operator()(double const* const* parameters, double* residuals) const {
    return cost->Evaluate(parameters, residuals, nullptr);
  }
};

}  // namespace

ceres::CostFunction* numeric_derivatives_of(ceres::CostFunction* cost) {
  auto* numeric = new ceres::DynamicNumericDiffCostFunction<Values, ceres::CENTRAL>(
      new Values{std::unique_ptr<ceres::CostFunction>(cost)});
  for (const int size : cost->parameter_block_sizes()) numeric->AddParameterBlock(size);
  numeric->SetNumResiduals(cost->num_residuals());
  return numeric;
}

}  // namespace stride::fit
