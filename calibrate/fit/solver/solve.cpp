#include "calibrate/fit/solver/solve.h"

#include <ceres/solver.h>

namespace stride::fit {

Solution solve(const FitProblem& problem, StrideFit& fit, Loss loss, double tolerance) {
  double ground_m = first_ground_m(fit.runner);
  ceres::Problem ceres;
  build(problem, fit, loss, &ground_m, ceres);
  auto* order = new ceres::ParameterBlockOrdering;
  for (Eigen::Vector2d& pelvis : fit.pelvis_px) order->AddElementToGroup(pelvis.data(), 0);
  for_each_block(fit.runner, [&](auto& block) { order->AddElementToGroup(block.data(), 1); });
  if (fit.heels_seen) order->AddElementToGroup(fit.heel.data(), 1);
  if (!problem.stance.phases.empty()) order->AddElementToGroup(&ground_m, 1);
  ceres::Solver::Options options;
  options.linear_solver_ordering.reset(order);
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = 60;
  options.function_tolerance = tolerance;
  options.parameter_tolerance = 1e-11;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres, &summary);
  fit.ok = summary.IsSolutionUsable();
  if (!fit.ok) fit.failure = "the fit does not converge: " + summary.message;
  fit.iterations += static_cast<int>(summary.iterations.size());
  return {summary.final_cost};
}

}  // namespace stride::fit
