#include "calibrate/calibrate.h"

#include "calibrate/aperiodic/passage_fit.h"
#include "calibrate/aperiodic/verdict.h"
#include "calibrate/fit/ground_slope.h"
#include "extract/skeleton/movement.h"

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

void fit_passage_facing(const Trajectory& trajectory, bool to_left, const SagittalModel& model,
                        const fit::FitOptions& options, Calibration& result) {
  AperiodicCalibration& own = result.aperiodic.emplace();
  result.observations = fit::observe(trajectory, to_left);
  const Directions directions(model);
  own.fit = aperiodic::fit_passage(result.observations, model, movement(trajectory.movement).legs);
  if (!own.fit.ok) return;
  fit::Prior roll = options.roll_rad;
  if (to_left) roll.mean = -roll.mean;
  own.path = aperiodic::ground_path(trajectory, result.observations, own.fit, directions, roll);
  own.flight = aperiodic::find_flight(own.path, own.fit);
  if (own.flight.ok) own.scale = aperiodic::scale_of(own.fit, own.flight, options);
}

/// A movement with a beginning and an end.
void calibrate_passage(const Trajectory& trajectory, const SagittalModel& model,
                       const fit::FitOptions& options, Calibration& result) {
  fit_passage_facing(trajectory, trajectory.direction == Facing::left, model, options, result);
  if (!trajectory.direction && result.aperiodic->fit.ok && result.aperiodic->fit.backward)
    fit_passage_facing(trajectory, true, model, options, result);
  const AperiodicCalibration& own = *result.aperiodic;
  aperiodic::judge_passage(trajectory, result.observations, own.fit, own.path, own.flight,
                           own.scale, result.verdict);
  if (own.flight.ok)
    result.run =
        aperiodic::retarget(own.fit, own.path, own.flight, own.scale, model, result.observations);
}

}  // namespace

Calibration calibrate(const Trajectory& trajectory, const SagittalModel& model,
                      const fit::FitOptions& given) {
  Calibration result;
  result.verdict = gait::judge_marks(trajectory);
  if (result.verdict.refused) return result;

  fit::FitOptions options = given;
  if (const auto roll = fit::ground_roll(trajectory)) options.roll_rad = *roll;
  const auto describe = [&] {
    result.run.movement = trajectory.movement;
    result.run.source = trajectory.video;
    result.run.source_sha256 = trajectory.video_sha256;
    result.run.verdict = result.verdict.text();
  };
  if (!movement(trajectory.movement).repeats) {
    calibrate_passage(trajectory, model, options, result);
    describe();
    return result;
  }
  fit_facing(trajectory, trajectory.direction == Facing::left, model, options, result);
  if (!trajectory.direction && result.fit.ok && result.fit.backward)
    fit_facing(trajectory, true, model, options, result);

  gait::judge_fit(trajectory, result.observations, result.fit, result.gait, result.verdict);
  if (!result.fit.ok) return result;
  result.run = gait::retarget(result.fit, result.gait, model, result.observations);
  describe();
  return result;
}

}  // namespace stride
