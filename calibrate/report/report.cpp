#include "calibrate/report/report.h"

#include <fmt/format.h>

#include <cmath>

#include "calibrate/gait/human_running.h"
#include "calibrate/osim/storage.h"
#include "extract/io/csv.h"
#include "extract/io/file.h"
#include "extract/skeleton/units.h"

namespace stride::report {
namespace {

/// Intervals of the stride in which an angle is outside the range of measured runners.
std::string outside_band(const fit::StrideFit& fit, const gait::Gait& gait) {
  const gait::HumanRunning human = gait::load_human_running();
  const Runner& r = fit.runner;
  std::string text;
  const auto compare = [&](const char* joint, const auto& curve,
                           const gait::HumanRunning::AngleBand& band) {
    int outside = 0, since = -1;
    double farthest = 0, where = 0;
    std::string spans;
    for (int i = 0; i < 100; ++i) {
      const double phase = i / 100.0,
                   angle = evaluate_series(curve.data(), fit.harmonics, phase + gait.foot_strike);
      const double low = human.at(band.low, phase), high = human.at(band.high, phase);
      const double out = angle < low ? angle - low : angle > high ? angle - high : 0;
      outside += out != 0 ? 1 : 0;
      if (out != 0 && since < 0) since = i;
      if (since >= 0 && (out == 0 || i == 99)) {
        const int last = out == 0 ? i - 1 : i;
        spans += spans.empty() ? "" : ", ";
        spans += since == last ? fmt::format("{}", last) : fmt::format("{}-{}", since, last);
        since = -1;
      }
      if (std::abs(out) > std::abs(farthest)) farthest = out, where = phase;
    }
    text += fmt::format("  {:<6} {:3} % of the stride outside", joint, outside);
    if (outside > 0)
      text += fmt::format(" (at {} %), farthest {:+.0f} deg at {:.0f} %", spans, farthest / kDegree,
                          100 * where);
    text += "\n";
  };
  compare("hip", r.hip, human.hip);
  compare("knee", r.knee, human.knee);
  if (fit.toes_seen)
    compare("ankle", r.ankle, human.ankle);
  else
    text += "  ankle  not seen (no toes): the mean of measured runners is used\n";
  return text;
}

std::string residuals_by_part(const Calibration& c) {
  std::array<double, kBodyPartCount> sum{}, marks{}, outliers{};
  for (std::size_t i = 0; i < c.fit.marks.size(); ++i) {
    const int part = index(c.observations.points[i].part);
    ++marks[part];
    if (c.fit.marks[i].outlier)
      ++outliers[part];
    else
      sum[part] += c.fit.marks[i].r_px.squaredNorm();
  }
  std::string text;
  for (const BodyPart part : kBodyParts) {
    const int i = index(part);
    if (marks[i] == 0) continue;
    const double rms = std::sqrt(sum[i] / std::max(marks[i] - outliers[i], 1.0));
    text += fmt::format("  {:<8} {:5.0f} marks  {:6.2f} px rms  {:5.1f} cm  {:4.0f} outliers\n",
                        name(part), marks[i], rms, 100 * rms * c.run.metres_per_pixel, outliers[i]);
  }
  return text;
}

/// What the calibration line did.
std::string line_text(const Trajectory& trajectory, const Calibration& c) {
  return fmt::format("{} the calibration line, {}",
                     c.scaled_by_line ? "from" : "from the size that was given; as a check",
                     text_of(*trajectory.calibration_line));
}

/// Of a movement that does not repeat.
std::string passage_text(const Trajectory& trajectory, const SagittalModel& model,
                         const Calibration& c) {
  const AperiodicCalibration& own = *c.aperiodic;
  if (!own.flight.ok) return {};
  const aperiodic::Passage& p = own.fit.passage;
  const double px_per_m = own.scale.px_per_m;
  std::string text;
  const auto line = [&]<typename... A>(fmt::format_string<A...> format, A&&... args) {
    text += fmt::format(format, std::forward<A>(args)...) + "\n";
  };
  line("movement  {}: {} frames in {:.2f} s, the runner faces {}", trajectory.movement,
       trajectory.frames.size(), c.observations.duration_s,
       c.observations.to_left ? "left" : "right");
  line(
      "flight    from {:.3f} s to {:.3f} s, {:.3f} s long; take-off at {:.2f} m/s forward and "
      "{:.2f} m/s upward",
      c.run.take_off_s, c.run.landing_s, c.run.landing_s - c.run.take_off_s,
      own.flight.velocity_px_s.x() / px_per_m, own.flight.velocity_px_s.y() / px_per_m);
  line("length    the pelvis moves by {:.2f} m",
       (own.path.pelvis_px.back() - own.path.pelvis_px.front()).x() / px_per_m);
  line("scale     {:.3f} mm per pixel +- {:.1f} %", 1000 / px_per_m, 100 * own.scale.relative_sd);
  line("          by free fall {:.3f} +- {:.1f} %; {} would fall with {:.2f} g",
       1000 / own.flight.px_per_m, 100 * own.flight.relative_sd,
       c.scaled_by_line ? "a runner of the line's size" : "a usual leg", own.scale.fall_factor);
  if (trajectory.calibration_line) line("          {}", line_text(trajectory, c));
  line("roll      {:+.2f} deg +- {:.2f} (the ground rises to the right)",
       c.run.camera_roll_rad / kDegree, own.path.roll_sd_rad / kDegree);
  line("runner    thigh {:.3f} m, shank {:.3f} m, together {:.3f} m; the model's {:.3f} and {:.3f}",
       p.limbs[aperiodic::limb::thigh] / px_per_m, p.limbs[aperiodic::limb::shank] / px_per_m,
       own.scale.leg_m, model.thigh_m(), model.shank_m());
  line(
      "fit       control points every {:.2f} s, {:.2f} px rms ({:.1f} cm), {:.1f} % of the marks "
      "are outliers",
      p.knot_s, own.fit.rms_px, 100 * c.run.rms_m, 100 * own.fit.outlier_fraction);
  return text;
}

}  // namespace

std::string report_text(const Trajectory& trajectory, const SagittalModel& model,
                        const Calibration& c) {
  std::string text =
      fmt::format("clip      {}\nverdict   {}\n", one_line(trajectory.video), c.verdict.text());
  if (c.aperiodic) return text + passage_text(trajectory, model, c);
  if (!c.fit.ok) return text;
  const Runner& r = c.fit.runner;
  const double leg = r.body[body::thigh] + r.body[body::shank];
  const auto line = [&]<typename... A>(fmt::format_string<A...> format, A&&... args) {
    text += fmt::format(format, std::forward<A>(args)...) + "\n";
  };
  line("frames    {} in {:.2f} s, {:.2f} strides, the runner faces {}", trajectory.frames.size(),
       c.observations.duration_s, c.observations.duration_s / c.run.period_s,
       c.observations.to_left ? "left" : "right");
  line("period    {:.4f} s +- {:.4f}, cadence {:.0f} steps a minute", c.run.period_s,
       c.run.period_sd_s, 120 / c.run.period_s);
  line("speed     {:.2f} m/s, a foot stands for {:.0f} % of the stride", c.run.speed_m_s,
       100 * c.gait.duty);
  line("scale     {:.3f} mm per pixel +- {:.1f} %, drift {:+.1f} % a second",
       1000 * c.run.metres_per_pixel, 100 * c.fit.scale_relative_sd(),
       -100 * r.camera[camera::drift_per_s]);
  if (!trajectory.calibration_line)
    line(
        "          from the length of the runner's legs; a calibration line (' in stride "
        "annotate), "
        "--height, --leg or --scale say it better");
  else
    line("          {} +- {:.1f} %", line_text(trajectory, c),
         100 * trajectory.calibration_line->relative_sd());
  line("roll      {:+.2f} deg +- {:.2f} (the ground rises to the right)",
       c.run.camera_roll_rad / kDegree, c.fit.roll_sd_rad() / kDegree);
  line("runner    thigh {:.3f} m, shank {:.3f} m, together {:.3f} m; the model's {:.3f} and {:.3f}",
       r.body[body::thigh], r.body[body::shank], leg, model.thigh_m(), model.shank_m());
  line("pelvis    {:.3f} m high on the model, rises and falls by {:.0f} mm", c.gait.pelvis_height_m,
       1000 * c.gait.vertical_oscillation_m);
  line("fit       {} harmonics, {:.2f} px rms ({:.1f} cm), {:.1f} % of the marks are outliers",
       c.fit.harmonics, c.fit.rms_px, 100 * c.run.rms_m, 100 * c.fit.outlier_fraction);
  text += "marks\n" + residuals_by_part(c);
  text += "angles against measured runners at 3.8 to 4 m/s";
  if (c.gait.walks)
    text += " (this is walking)";
  else if (c.run.speed_m_s < 3.6)
    text += fmt::format(" ({:.1f} m/s: slower runners lift thigh and heel less)", c.run.speed_m_s);
  text += "\n" + outside_band(c.fit, c.gait);
  return text;
}

void save_mot(const CalibratedTrajectory& run, const std::filesystem::path& file) {
  osim::Storage storage{.name = run.source, .in_degrees = true, .columns = {}, .rows = {}};
  storage.columns.assign(kCoordinateNames.begin(), kCoordinateNames.end());
  for (const CalibratedSample& sample : run.samples) {
    osim::Storage::Row& row = storage.rows.emplace_back();
    row.time_s = sample.time_s;
    for (std::size_t i = 0; i < sample.coordinates.size(); ++i) {
      const bool metres = i == 1 || i == 2;
      row.values.push_back(sample.coordinates[i] / (metres ? 1 : kDegree));
    }
  }
  write_file_atomically(file, osim::to_text(storage));
}

}  // namespace stride::report
