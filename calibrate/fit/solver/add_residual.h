#pragma once

#include <ceres/problem.h>

#include <utility>

#include "calibrate/fit/solver/residuals.h"

namespace stride::fit {

/// The same residuals with central differences for derivatives. Takes ownership.
ceres::CostFunction* numeric_derivatives_of(ceres::CostFunction* cost);

/// Adds a residual on the blocks that it depends on; `others` are those beside the runner's.
template <typename Residual, typename... Pointers>
void add_residual(ceres::Problem& ceres, bool numeric_derivatives, Runner& runner,
                  Residual residual, ceres::LossFunction* loss, Pointers... others) {
  ceres::CostFunction* cost = new AutomaticCost<Residual>(new Residual(std::move(residual)));
  ceres.AddResidualBlock(numeric_derivatives ? numeric_derivatives_of(cost) : cost, loss,
                         Residual::DependsOn::of(runner, others...));
}

}  // namespace stride::fit
