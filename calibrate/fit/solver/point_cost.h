#pragma once

#include "calibrate/fit/solver/residuals.h"

namespace stride::fit {

/// PointResidual with its derivatives, for Ceres. The residual depends on the 74 parameters through
/// 24 numbers (camera, body, hips, four angles, phase, pelvis). Those are differentiated
/// automatically, and the angles' series, which are linear in their coefficients, by the chain
/// rule. Four times faster than AutoDiffCostFunction on all 74.
class PointCost final : public PointResidual::DependsOn::Sized {
 public:
  explicit PointCost(PointResidual residual) : residual_(std::move(residual)) {}

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  PointResidual residual_;
};

}  // namespace stride::fit
