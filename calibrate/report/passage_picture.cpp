// The picture of the report of a movement that does not repeat.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "calibrate/report/report_frames.h"
#include "calibrate/report/report_plot.h"
#include "extract/io/file.h"
#include "extract/io/gnuplot.h"
#include "extract/skeleton/units.h"

namespace stride::report {
namespace {

using Eigen::Vector2d;

constexpr int kCurvePoints = 300;

/// From an image's to the ground's axes, m.
Vector2d on_ground(const AperiodicCalibration& own, const Vector2d& px) {
  return turned(-own.path.roll_rad, px) / own.scale.px_per_m;
}

/// Labelled points of a part from the fitted pelvis, in axes of the ground: time, x, y, outlier.
std::string passage_marks(const Calibration& c, BodyPart part) {
  const AperiodicCalibration& own = *c.aperiodic;
  DataBlock points(fmt::format("{}_marks", name(part)));
  for (std::size_t i = 0; i < own.fit.marks.size(); ++i) {
    const fit::Mark& mark = c.observations.points[i];
    if (mark.part != part) continue;
    const auto frame = static_cast<std::size_t>(mark.frame);
    const Vector2d p = on_ground(own, mark.z_px - own.fit.passage.pelvis_px[frame]);
    points.row(mark.u_s + c.observations.middle_s, p.x(), p.y(), own.fit.marks[i].outlier ? 1 : 0);
  }
  return points.end();
}

/// A time of the clip, u_s, of the curve's point i.
double moment_s(const Calibration& c, int i) {
  return std::lerp(c.observations.u_s.front(), c.observations.u_s.back(),
                   static_cast<double>(i) / kCurvePoints);
}

/// The fit of a part from the pelvis: time, x, y.
std::string curve(const Calibration& c, const Directions& directions, BodyPart part) {
  const AperiodicCalibration& own = *c.aperiodic;
  DataBlock block{std::string(name(part))};
  for (int i = 0; i <= kCurvePoints; ++i) {
    const double u = moment_s(c, i);
    const Vector2d p =
        on_ground(own, aperiodic::about_pelvis(part, directions, own.fit.passage.limbs.data(),
                                               own.fit.passage.angles(u)));
    block.row(u + c.observations.middle_s, p.x(), p.y());
  }
  return block.end();
}

/// Standard deviation of an angle at a time, from its four control points.
double angle_sd(const aperiodic::PassageFit& fit, double u_s, aperiodic::Angle angle) {
  const aperiodic::SplinePlace at = fit.passage.place(u_s);
  const auto place = [&](int j) {
    return aperiodic::limb::size + aperiodic::kAngles * (at.first + j) + angle;
  };
  double variance = 0;
  for (int j = 0; j < 4; ++j)
    for (int k = 0; k < 4; ++k)
      variance += at.weight[static_cast<std::size_t>(j)] * at.weight[static_cast<std::size_t>(k)] *
                  fit.covariance(place(j), place(k));
  return std::sqrt(std::max(0.0, variance));
}

/// A joint, the right leg's angle and the left one's: time, then each with the ends of its 95 %
/// band, degrees.
std::string joint(const Calibration& c, const char* name, aperiodic::Angle right,
                  aperiodic::Angle left) {
  const aperiodic::PassageFit& fit = c.aperiodic->fit;
  DataBlock block(name);
  for (int i = 0; i <= kCurvePoints; ++i) {
    const double u = moment_s(c, i);
    const aperiodic::Angles angles = fit.passage.angles(u);
    const auto deg = [&](aperiodic::Angle angle) {
      return angles[static_cast<std::size_t>(angle)] / kDegree;
    };
    const double r = deg(right), r_sd = 1.96 * angle_sd(fit, u, right) / kDegree;
    const double l = deg(left), l_sd = 1.96 * angle_sd(fit, u, left) / kDegree;
    block.row(u + c.observations.middle_s, r, r - r_sd, r + r_sd, l, l - l_sd, l + l_sd);
  }
  return block.end();
}

/// How far pelvis and centre of mass are above where they are in the first frame, and the lower
/// foot above where it stands, m; and free fall through the centre of mass in flight.
std::string heights(const Calibration& c) {
  const AperiodicCalibration& own = *c.aperiodic;
  const double px_per_m = own.scale.px_per_m;
  DataBlock block("heights"), fall("fall");
  const auto risen = [&](const std::vector<Vector2d>& points_px, std::size_t i) {
    return (points_px[i] - points_px.front()).y() / px_per_m;
  };
  for (std::size_t i = 0; i < own.path.u_s.size(); ++i)
    block.row(own.path.u_s[i] + c.observations.middle_s, risen(own.path.pelvis_px, i),
              risen(own.path.com_px, i), own.path.clearance_px[i] / px_per_m);
  // Through the centre of mass at the frames in flight, by least squares of height alone.
  const double up_m_s = own.flight.velocity_px_s.y() / px_per_m;
  const auto rise = [&](double t) { return up_m_s * t - 0.5 * kGravity_m_s2 * t * t; };
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < own.path.u_s.size(); ++i) {
    const double u = own.path.u_s[i];
    if (u < own.flight.take_off_s || u > own.flight.landing_s) continue;
    sum += risen(own.path.com_px, i) - rise(u - own.flight.take_off_s);
    ++count;
  }
  constexpr int kPoints = 40;
  for (int i = 0; i <= kPoints && count > 0; ++i) {
    const double t =
        (own.flight.landing_s - own.flight.take_off_s) * static_cast<double>(i) / kPoints;
    fall.row(c.run.take_off_s + t, sum / count + rise(t));
  }
  return block.end() + fall.end();
}

/// Height over the clip; the flight is shaded in every panel.
constexpr const char* kHeights = R"(
set key at screen 0.985,0.782 right horizontal samplen 1.5 textcolor rgb letters
set lmargin 8; set rmargin 2; set origin 0,0.605; set size 1,0.165
set xlabel 'time, s' offset 0,0.7; set ylabel 'rise, m' offset 1,0
set xrange [*:*] noextend; set yrange [*:*]
plot $heights u 1:3 w lp pt 7 ps 0.3 lc rgb '#333333' lw 1.4 t 'centre of mass', $heights u 1:2 w lp pt 7 ps 0.3 lc rgb pelvis lw 1.4 t 'pelvis', $heights u 1:4 w lp pt 7 ps 0.3 lc rgb foot lw 1.4 t 'lower foot', $fall u 1:2 w l dt 2 lc rgb fall lw 2 t 'free fall, 9.81 m/s²'
unset key; unset xlabel
)";

/// Panel of one coordinate of a part: {0} origin, {1} part, {2} column, {3} label.
constexpr const char* kPassagePart = R"(
set origin {0}; set size 0.335,0.20; set ylabel '{3}' offset 1,0
plot ${1}_l_marks u 1:($4==0?column({2}):1/0) w p pt 7 ps 0.3 lc rgb left_mark, ${1}_r_marks u 1:($4==0?column({2}):1/0) w p pt 7 ps 0.3 lc rgb right_mark, ${1}_l u 1:{2} w l ls 2, ${1}_r u 1:{2} w l ls 1, ${1}_r_marks u 1:($4==1?column({2}):1/0) w p pt 2 ps 0.6 lc rgb outlier, ${1}_l_marks u 1:($4==1?column({2}):1/0) w p pt 2 ps 0.6 lc rgb outlier
)";

/// Panel of a joint: {0} origin, {1} its block, {2} label.
constexpr const char* kJoint = R"(
set origin {0}; set size 0.335,0.205; set ylabel '{2}, deg' offset 1,0; set xlabel 'time, s' offset 0,0.7
plot ${1} u 1:6:7 w filledcurves lc rgb left_band, ${1} u 1:3:4 w filledcurves lc rgb right_band, ${1} u 1:5 w l ls 2, ${1} u 1:2 w l ls 1
)";

std::string panels() {
  std::string text;
  for (const int axis : {0, 1})
    for (int i = 0; i < 3; ++i) {
      const std::string part = std::array{"knee", "ankle", "toe"}[static_cast<std::size_t>(i)];
      text += fmt::format(fmt::runtime(kPassagePart),
                          fmt::format("{},{}", 0.332 * i, axis == 0 ? 0.405 : 0.21), part, 2 + axis,
                          fmt::format("{} {}, m", part, axis == 0 ? "forward" : "up"));
    }
  constexpr std::array kLabels{std::pair{"hip", "hip flexion"},
                               std::pair{"knee_angle", "knee angle"},
                               std::pair{"ankle_angle", "ankle angle"}};
  for (std::size_t i = 0; i < kLabels.size(); ++i)
    text += fmt::format(fmt::runtime(kJoint), fmt::format("{},0", 0.332 * static_cast<double>(i)),
                        kLabels[i].first, kLabels[i].second);
  return text + "unset multiplot\n";
}

}  // namespace

void draw_passage(const Trajectory& trajectory, const SagittalModel& model, const Calibration& c,
                  const std::filesystem::path& video, const std::filesystem::path& file) {
  const AperiodicCalibration& own = *c.aperiodic;
  const Directions directions(model);
  const std::vector<int> shown = keyframes_of_passage(trajectory);
  Labels labels;
  labels.title(
      fmt::format(
          "{}: {}, in the air {:.3f} s, pelvis moves by {:.2f} m, {:.2f} px rms ({:.1f} cm)",
          trajectory.video, trajectory.movement, c.run.landing_s - c.run.take_off_s,
          (own.path.pelvis_px.back() - own.path.pelvis_px.front()).x() / own.scale.px_per_m,
          own.fit.rms_px, 100 * c.run.rms_m),
      "right leg red, left blue; points: marks; bands: 95 %; grey: flight");
  for (int k = 0; k < kReportKeyframes && !video.empty(); ++k)
    labels.below_frame(
        k,
        fmt::format(
            "{:.2f} s",
            trajectory.frames[static_cast<std::size_t>(shown[static_cast<std::size_t>(k)])].time_s),
        kHeight_px);
  std::string script = page_style(kHeight_px) + labels.text();
  script += fmt::format(
      "set object 1 rectangle from {0},graph 0 to {1},graph 1 behind fc rgb pale fs solid "
      "noborder\n",
      c.run.take_off_s, c.run.landing_s);
  for (const BodyPart part : kTraced) script += passage_marks(c, part) + curve(c, directions, part);
  script += joint(c, "hip", aperiodic::hip_r, aperiodic::hip_l) +
            joint(c, "knee_angle", aperiodic::knee_r, aperiodic::knee_l) +
            joint(c, "ankle_angle", aperiodic::ankle_r, aperiodic::ankle_l);
  script += fmt::format("pelvis = '{}'; foot = '{}'; fall = '{}'\n", kLineColours[2],
                        kLineColours[7], kLineColours[1]);
  script += heights(c) + kHeights + "unset label\n" + panels();
  write_file_atomically(file, with_strip(run_gnuplot(script), video, trajectory, model, c, shown));
}

}  // namespace stride::report
