#include "calibrate/calibrate.h"

#include "calibrate/fit/ground_slope.h"

namespace stride {
namespace {

void fit_facing(const Trajectory& trajectory, bool to_left, const SagittalModel& model,
                const fit::FitOptions& options, Calibration& result) {
  result.observations = fit::observe(trajectory, to_left);
  result.fit = fit::fit_stride(result.observations, model, options);
  if (!result.fit.ok) return;
  gait::fill_unseen_ankles(result.fit);
  result.gait = gait::analyse_gait(result.fit, model);
}

}  // namespace

Calibration calibrate(const Trajectory& trajectory, const SagittalModel& model,
                      const fit::FitOptions& given) {
  Calibration result;
  result.verdict = gait::judge_marks(trajectory);
  if (result.verdict.refused) return result;

  fit::FitOptions options = given;
  if (const auto roll = fit::ground_roll(trajectory)) options.roll_rad = *roll;
  fit_facing(trajectory, trajectory.direction == Facing::left, model, options, result);
  if (!trajectory.direction && result.fit.ok && result.fit.backward)
    fit_facing(trajectory, true, model, options, result);

  gait::judge_fit(trajectory, result.observations, result.fit, result.gait, result.verdict);
  if (!result.fit.ok) return result;
  result.run = gait::retarget(result.fit, result.gait, model, result.observations);
  result.run.source = trajectory.video;
  result.run.source_sha256 = trajectory.video_sha256;
  result.run.verdict = result.verdict.text();
  return result;
}

}  // namespace stride
