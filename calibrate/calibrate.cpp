#include "calibrate/calibrate.h"

#include <cmath>

#include "calibrate/aperiodic/passage_fit.h"
#include "calibrate/aperiodic/verdict.h"
#include "calibrate/fit/ground_slope.h"
#include "extract/skeleton/movement.h"

namespace stride {
namespace {

/// Seconds from the middle of the clip to a frame, which may lie before the first or after the
/// last.
double moment_s(const Trajectory& trajectory, const fit::Marks& marks, int frame) {
  const TrajectoryFrame& first = trajectory.frames.front();
  for (std::size_t i = 0; i < trajectory.frames.size(); ++i)
    if (trajectory.frames[i].frame == frame) return marks.u_s[i];
  return marks.u_s.front() + (frame - first.frame) / trajectory.rate_hz;
}

/// With a calibration line as the scale, unless the runner's size was given.
fit::FitOptions with_line(const Trajectory& trajectory, const fit::Marks& marks,
                          fit::FitOptions options) {
  const auto& line = trajectory.calibration_line;
  if (line && !options.size_given)
    options.measured_scale = {line->metres_per_pixel(), line->relative_sd(),
                              moment_s(trajectory, marks, line->frame)};
  return options;
}

/// A line that sets the scale is held against the usual leg; else against the one that was given.
void judge_line(const Trajectory& trajectory, const fit::FitOptions& options, Calibration& result) {
  if (!trajectory.calibration_line) return;
  result.scaled_by_line = !options.size_given;
  if (result.aperiodic) {
    const AperiodicCalibration& own = *result.aperiodic;
    if (!own.flight.ok) return;
    const fit::Prior leg =
        options.metres_per_pixel ? fit::Prior{own.scale.leg_m, 0} : options.leg_m;
    return gait::judge_line(*trajectory.calibration_line, own.fit.passage.leg_px(), leg,
                            options.size_given ? "given" : "usual", result.verdict);
  }
  if (!result.fit.ok) return;
  const Runner& r = result.fit.runner;
  const double u_s = moment_s(trajectory, result.observations, trajectory.calibration_line->frame);
  const double leg_px = stride::leg_px(r) * std::exp(r.camera[camera::drift_per_s] * u_s);
  const fit::Prior leg = options.metres_per_pixel
                             ? fit::Prior{r.body[body::thigh] + r.body[body::shank], 0}
                             : options.leg_m;
  gait::judge_line(*trajectory.calibration_line, leg_px, leg,
                   options.size_given ? "given" : "usual", result.verdict);
}

void fit_facing(const Trajectory& trajectory, bool to_left, const SagittalModel& model,
                const fit::FitOptions& options, Calibration& result) {
  result.observations = fit::observe(trajectory, to_left);
  result.fit = fit::fit_stride(result.observations, model,
                               with_line(trajectory, result.observations, options));
  if (!result.fit.ok) return;
  gait::fill_unseen_ankles(result.fit);
  result.gait = gait::analyse_gait(result.fit, model);
}

void fit_passage_facing(const Trajectory& trajectory, bool to_left, const SagittalModel& model,
                        const fit::FitOptions& options, Calibration& result) {
  AperiodicCalibration& own = result.aperiodic.emplace();
  result.observations = fit::observe(trajectory, to_left, fit::Heels::left_out);
  const Directions directions(model);
  own.fit = aperiodic::fit_passage(result.observations, model, movement(trajectory.movement).legs);
  if (!own.fit.ok) return;
  fit::Prior roll = options.roll_rad;
  if (to_left) roll.mean = -roll.mean;
  own.path = aperiodic::ground_path(trajectory, result.observations, own.fit, directions, roll);
  own.flight = aperiodic::find_flight(own.path, own.fit);
  if (own.flight.ok)
    own.scale = aperiodic::scale_of(own.fit, own.flight,
                                    with_line(trajectory, result.observations, options));
}

/// A movement with a beginning and an end.
void calibrate_passage(const Trajectory& trajectory, const SagittalModel& model,
                       const fit::FitOptions& options, Calibration& result) {
  fit_passage_facing(trajectory, trajectory.direction == Facing::left, model, options, result);
  if (!trajectory.direction && result.aperiodic->fit.ok && result.aperiodic->fit.backward)
    fit_passage_facing(trajectory, true, model, options, result);
  const AperiodicCalibration& own = *result.aperiodic;
  judge_line(trajectory, options, result);
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

  judge_line(trajectory, options, result);
  gait::judge_fit(trajectory, result.observations, result.fit, result.gait, result.verdict);
  if (!result.fit.ok) return result;
  result.run = gait::retarget(result.fit, result.gait, model, result.observations);
  describe();
  return result;
}

}  // namespace stride
