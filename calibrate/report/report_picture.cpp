// The picture of the report of a stride, drawn by gnuplot from data in the script.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "calibrate/gait/human_running.h"
#include "calibrate/report/report.h"
#include "calibrate/report/report_frames.h"
#include "calibrate/report/report_plot.h"
#include "extract/io/file.h"
#include "extract/io/gnuplot.h"
#include "extract/skeleton/units.h"

namespace stride::report {
namespace {

double percent(double phase) { return 100 * (phase - std::floor(phase)); }

/// Every labelled point of a part relative to the fitted pelvis, in axes of the ground, px at the
/// middle of the clip: time, % of the leg's own stride, x, y, outlier.
std::string marks(const Calibration& c, BodyPart part) {
  const Runner& r = c.fit.runner;
  DataBlock points(fmt::format("{}_marks", name(part)));
  for (std::size_t i = 0; i < c.fit.marks.size(); ++i) {
    const fit::Mark& mark = c.observations.points[i];
    if (mark.part != part) continue;
    const double scale = std::exp(r.camera[camera::drift_per_s] * mark.u_s);
    const Eigen::Vector2d p =
        turned(-r.camera[camera::roll], Eigen::Vector2d(mark.z_px - c.fit.pelvis_px[mark.frame])) /
        scale;
    const double phase = phase_at(r.cadence.data(), mark.u_s) - c.gait.foot_strike;
    points.row(mark.u_s + c.observations.middle_s, percent(phase + (side_of(part) > 0 ? 0.0 : 0.5)),
               p.x(), p.y(), c.fit.marks[i].outlier ? 1 : 0);
  }
  return points.end();
}

/// Position of a fitted part relative to the pelvis, in axes of the ground, px at the middle of the
/// clip; independent of the runner's size.
Eigen::Vector2d fitted(const fit::StrideFit& fit, const Directions& directions, BodyPart part,
                       double phase) {
  const Runner& r = fit.runner;
  const auto leg = leg_angles(r.hip.data(), r.knee.data(), r.ankle.data(), r.asymmetry.data(),
                              fit.harmonics, side_of(part), phase);
  return std::exp(r.camera[camera::log_px_per_m]) *
         place_part(part, directions, r.body.data(), r.sides.data(),
                    evaluate_series(r.tilt.data(), kTiltHarmonics, phase), leg, phase);
}

/// The fit over the clip (time, x) and over the leg's own stride with its 95 % band
/// (%, x, y, x low, x high, y low, y high).
std::string curves(const Calibration& c, const Directions& directions, BodyPart part) {
  DataBlock in_time(fmt::format("{}_time", name(part))), in_phase(std::string(name(part)));
  for (int i = 0; i <= 400; ++i) {
    const double u = (i / 400.0 - 0.5) * c.observations.duration_s;
    in_time.row(u + c.observations.middle_s,
                fitted(c.fit, directions, part, phase_at(c.fit.runner.cadence.data(), u)).x());
  }
  for (int i = 0; i <= 50; ++i) {
    const double phase = i / 50.0 + c.gait.foot_strike - (side_of(part) > 0 ? 0.0 : 0.5);
    const auto place = [&](const fit::StrideFit& fit) -> Eigen::VectorXd {
      return fitted(fit, directions, part, phase);
    };
    const Eigen::Vector2d p = place(c.fit), band = 1.96 * fit::propagated_sd(c.fit, place);
    in_phase.row(2 * i, p.x(), p.y(), p.x() - band.x(), p.x() + band.x(), p.y() - band.y(),
                 p.y() + band.y());
  }
  return in_time.end() + in_phase.end();
}

/// Stick figures of the model at eight phases, side by side.
std::string poses(const Calibration& c) {
  DataBlock right("right"), left("left"), trunk("trunk");
  for (int k = 0; k < kReportKeyframes; ++k) {
    const double phase = static_cast<double>(k) / kReportKeyframes;
    const auto nearest = std::ranges::min_element(c.run.samples, {}, [&](const auto& sample) {
      const double d = sample.phase - phase;
      return std::abs(d - std::round(d));
    });
    const Eigen::Vector2d at(1.15 * k, nearest->coordinates[2]);
    const auto joint = [&](DataBlock& block, BodyPart part) {
      const Eigen::Vector2d p = at + (*nearest)[part];
      const Eigen::Vector2d sd = nearest->sd_m[index(part)];
      block.row(p.x(), p.y(), 2 * sd.x(), 2 * sd.y());
    };
    const auto chain = [&](DataBlock& block, std::span<const Bone> bones) {
      BodyPart end = bones.front().from;
      joint(block, end);
      for (const auto& [from, to] : bones) {
        if (!(*nearest)[to].allFinite()) continue;
        if (from != end) block.gap(), joint(block, from);
        joint(block, end = to);
      }
      block.gap();
    };
    chain(right, kLegBones<Side::right>);
    chain(left, kLegBones<Side::left>);
    chain(trunk, std::array{Bone{BodyPart::hip_r, BodyPart::head}});
  }
  return right.end() + left.end() + trunk.end();
}

/// Hip, knee and ankle over the stride with 95 % bands, and the range of measured runners.
std::string angles(const Calibration& c) {
  const gait::HumanRunning human = gait::load_human_running();
  DataBlock mean("angles"), band("band");
  for (int i = 0; i <= 50; ++i) {
    const double at = i / 50.0 + c.gait.foot_strike;
    const auto values = [&](const fit::StrideFit& fit) -> Eigen::VectorXd {
      const auto value = [&](const auto& curve) {
        return evaluate_series(curve.data(), fit.harmonics, at) / kDegree;
      };
      return Eigen::Vector3d(value(fit.runner.hip), value(fit.runner.knee),
                             value(fit.runner.ankle));
    };
    const Eigen::Vector3d q = values(c.fit), sd = 1.96 * fit::propagated_sd(c.fit, values);
    mean.row(2 * i, q[0], q[0] - sd[0], q[0] + sd[0], q[1], q[1] - sd[1], q[1] + sd[1], q[2],
             q[2] - sd[2], q[2] + sd[2]);
  }
  for (std::size_t i = 0; i < human.phase.size(); ++i)
    band.row(100 * human.phase[i], human.hip.low[i] / kDegree, human.hip.high[i] / kDegree,
             human.knee.low[i] / kDegree, human.knee.high[i] / kDegree,
             human.ankle.low[i] / kDegree, human.ankle.high[i] / kDegree);
  return mean.end() + band.end();
}

/// The model at the keyframes, if there is no video.
constexpr const char* kPoses = R"(
unset key; unset tics; unset border; unset grid
set lmargin 2; set rmargin 1; set tmargin 0; set bmargin 1
set origin 0,0.795; set size 1,0.165
set size ratio -1; set xrange [-0.6:8.65]; set yrange [-0.05:1.65]
plot 0 w l lc rgb '#bbbbbb', $trunk u 1:2 w l ls 3, $left u 1:2 w lp ls 2 pt 7 ps 0.4,      $right u 1:2 w lp ls 1 pt 7 ps 0.4,      $left u 1:2:3:4 w xyerrorbars lc rgb left pt 0, $right u 1:2:3:4 w xyerrorbars lc rgb right pt 0
set size noratio; set border 3; set tics; set xrange [*:*]; set yrange [*:*]
set grid ytics lc rgb pale lt 1
set tmargin -1; set bmargin -1
)";

constexpr const char* kTime = R"(
set key at screen 0.985,0.782 right horizontal samplen 1.5 textcolor rgb letters
set lmargin 8; set rmargin 2; set origin 0,0.605; set size 1,0.165
set xlabel 'time, s' offset 0,0.7; set ylabel 'ankle forward, px' offset 1,0; set xrange [*:*] noextend
plot $ankle_r_marks u 1:($5==0?$3:1/0) w p pt 7 ps 0.3 lc rgb right_mark notitle,      $ankle_l_marks u 1:($5==0?$3:1/0) w p pt 7 ps 0.3 lc rgb left_mark notitle,      $ankle_r_time u 1:2 w l ls 1 t 'right leg', $ankle_l_time u 1:2 w l ls 2 t 'left leg',      $ankle_r_marks u 1:($5==1?$3:1/0) w p pt 2 ps 0.6 lc rgb outlier t 'outlier',      $ankle_l_marks u 1:($5==1?$3:1/0) w p pt 2 ps 0.6 lc rgb outlier notitle
unset key
set xtics 0,25,100 nomirror; set xrange [0:100]; set yrange [*:*]
)";

/// Panel of one coordinate of a part over the leg's own stride: {0} origin, {1} part, {2} its
/// column among the marks, {3} among the curves, {4} of the band's low end, {5} labels.
constexpr const char* kPart = R"(
set origin {0}; set size 0.335,0.20; {5}
plot ${1}_r u 1:{4}:(column({4}+1)) w filledcurves lc rgb right_band,      ${1}_l u 1:{4}:(column({4}+1)) w filledcurves lc rgb left_band,      ${1}_r_marks u 2:($5==0?column({2}):1/0) w p pt 7 ps 0.25 lc rgb right_mark,      ${1}_l_marks u 2:($5==0?column({2}):1/0) w p pt 7 ps 0.25 lc rgb left_mark,      ${1}_r u 1:{3} w l ls 1, ${1}_l u 1:{3} w l ls 2
)";

constexpr const char* kAngles = R"(
set xlabel '% of the stride from its own foot strike' offset 0,0.7
set origin 0,0; set size 0.335,0.205; set ylabel 'hip flexion, deg' offset 1,0
plot $band u 1:2:3 w filledcurves lc rgb '#dcdcdc', $angles u 1:3:4 w filledcurves lc rgb '#b9b0d8', $angles u 1:2 w l lc rgb '#4b3b8f' lw 1.8
set origin 0.332,0; set ylabel 'knee angle, deg'
plot $band u 1:4:5 w filledcurves lc rgb '#dcdcdc', $angles u 1:6:7 w filledcurves lc rgb '#b9b0d8', $angles u 1:5 w l lc rgb '#4b3b8f' lw 1.8
set origin 0.664,0; set ylabel 'ankle angle, deg'
plot $band u 1:6:7 w filledcurves lc rgb '#dcdcdc', $angles u 1:9:10 w filledcurves lc rgb '#b9b0d8', $angles u 1:8 w l lc rgb '#4b3b8f' lw 1.8
unset multiplot
)";

/// Knees, ankles and toes, forward and up.
std::string part_panels() {
  std::string text;
  for (const int axis : {0, 1})
    for (int i = 0; i < 3; ++i) {
      const std::string part = std::array{"knee", "ankle", "toe"}[i];
      const std::string labels = fmt::format("set ylabel '{} {}, px' offset 1,0; unset xlabel",
                                             part, axis == 0 ? "forward" : "up");
      text += fmt::format(fmt::runtime(kPart),
                          fmt::format("{},{}", 0.332 * i, axis == 0 ? 0.405 : 0.21), part, 3 + axis,
                          2 + axis, 4 + 2 * axis, labels);
    }
  return text;
}

}  // namespace

void draw_report(const Trajectory& trajectory, const SagittalModel& model, const Calibration& c,
                 const std::filesystem::path& video, const std::filesystem::path& file) {
  if (c.aperiodic) return draw_passage(trajectory, model, c, video, file);
  const Directions directions(model);
  Labels labels;
  std::string script = page_style(kHeight_px);
  labels.title(
      fmt::format(
          "{}: stride {:.3f} ± {:.3f} s, {:.2f} m/s, {} harmonics, {:.2f} px rms ({:.1f} cm)",
          trajectory.video, c.run.period_s, 1.96 * c.run.period_sd_s, c.run.speed_m_s,
          c.fit.harmonics, c.fit.rms_px, 100 * c.run.rms_m),
      "bands: 95 %; points: marks; grey: measured runners at 3.8 to 4 m/s");
  for (int k = 0; k < kReportKeyframes; ++k)
    labels.below_frame(k, fmt::format("{:.0f} %", 100.0 * k / kReportKeyframes), kHeight_px);
  script += labels.text();
  for (const BodyPart part : kTraced) script += marks(c, part) + curves(c, directions, part);
  script += poses(c) + angles(c) + (video.empty() ? kPoses : "") + kTime;
  script += "unset label\n";
  script += part_panels() + kAngles;
  write_file_atomically(
      file, with_strip(run_gnuplot(script), video, trajectory, model, c, keyframes_of_stride(c)));
}

}  // namespace stride::report
