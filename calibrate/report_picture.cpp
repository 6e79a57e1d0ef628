// The picture of the report, drawn by gnuplot from data given in its script.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "calibrate/human_running.h"
#include "calibrate/report.h"
#include "extract/error.h"

namespace stride {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kPoses = 8;

/// A block of data of a gnuplot script.
class Block {
 public:
  explicit Block(const char* name) : text_(fmt::format("${} << EOD\n", name)) {}
  template <typename... Numbers>
  void row(Numbers... numbers) {
    ((text_ += std::isnan(static_cast<double>(numbers))
                   ? "? "
                   : fmt::format("{:.6g} ", static_cast<double>(numbers))),
     ...);
    text_ += "\n";
  }
  void gap() { text_ += "\n"; }
  std::string end() { return text_ + "EOD\n"; }

 private:
  std::string text_;
};

/// Marks of a part from the fitted pelvis, in axes of the ground, m of the runner; and the fit.
std::string tracks(const Calibration& c, BodyPart part, const char* marks, const char* curve) {
  const Runner& r = c.fit.runner;
  Block points(marks), line(curve);
  for (std::size_t i = 0; i < c.fit.marks.size(); ++i) {
    const Mark& mark = c.observations.points[i];
    if (mark.part != part) continue;
    const double scale =
        std::exp(r.camera[camera::log_px_per_m] + r.camera[camera::drift_per_s] * mark.u_s);
    const Eigen::Vector2d p =
        turned(-r.camera[camera::roll], Eigen::Vector2d(mark.z_px - c.fit.pelvis_px[mark.frame])) /
        scale;
    points.row(mark.u_s + c.observations.middle_s, p.x(), p.y(), c.fit.marks[i].outlier ? 1 : 0);
  }
  for (int i = 0; i <= 400; ++i) {
    const double u = (i / 400.0 - 0.5) * c.observations.duration_s,
                 phase = phase_at(r.cadence.data(), u);
    const auto leg = leg_angles(r.hip.data(), r.knee.data(), r.ankle.data(), r.asymmetry.data(),
                                c.fit.harmonics, side_of(part), phase);
    const double tilt = evaluate_series(r.tilt.data(), 2, phase);
    const Eigen::Vector2d thigh = turned(tilt + leg.hip, Eigen::Vector2d(0, -r.body[body::thigh]));
    const Eigen::Vector2d shank =
        turned(tilt + leg.hip + leg.knee, Eigen::Vector2d(0, -r.body[body::shank]));
    const bool knee = part == BodyPart::knee_r || part == BodyPart::knee_l;
    const Eigen::Vector2d p = Eigen::Vector2d(r.body[body::hip_x], r.body[body::hip_y]) + thigh +
                              (knee ? Eigen::Vector2d::Zero() : shank);
    line.row(u + c.observations.middle_s, p.x(), p.y());
  }
  return points.end() + line.end();
}

/// Stick figures of the model at eight phases, side by side.
std::string poses(const Calibration& c) {
  Block right("right"), left("left"), trunk("trunk");
  for (int k = 0; k < kPoses; ++k) {
    const double phase = static_cast<double>(k) / kPoses;
    const auto nearest = std::ranges::min_element(c.run.samples, {}, [&](const auto& sample) {
      const double d = sample.phase - phase;
      return std::abs(d - std::round(d));
    });
    const Eigen::Vector2d at(1.15 * k, nearest->coordinates[2]);
    const auto chain = [&](Block& block, std::initializer_list<BodyPart> parts) {
      for (const BodyPart part : parts) {
        const Eigen::Vector2d p = at + (*nearest)[part];
        const Eigen::Vector2d sd = nearest->sd_m[index(part)];
        block.row(p.x(), p.y(), 2 * sd.x(), 2 * sd.y());
      }
      block.gap();
    };
    chain(right, {BodyPart::hip_r, BodyPart::knee_r, BodyPart::ankle_r, BodyPart::toe_r});
    chain(left, {BodyPart::hip_l, BodyPart::knee_l, BodyPart::ankle_l, BodyPart::toe_l});
    chain(trunk, {BodyPart::hip_r, BodyPart::head});
  }
  return right.end() + left.end() + trunk.end();
}

std::string angles(const Calibration& c) {
  const HumanRunning human = load_human_running();
  const Runner& r = c.fit.runner;
  Block fitted("angles"), band("band");
  for (int i = 0; i <= 100; ++i) {
    const double phase = i / 100.0, at = phase + c.gait.foot_strike;
    const auto value = [&](const auto& curve) {
      return evaluate_series(curve.data(), c.fit.harmonics, at) / kDegree;
    };
    fitted.row(i, value(r.hip), value(r.knee), value(r.ankle));
  }
  for (std::size_t i = 0; i < human.phase.size(); ++i)
    band.row(100 * human.phase[i], human.hip.low[i] / kDegree, human.hip.high[i] / kDegree,
             human.knee.low[i] / kDegree, human.knee.high[i] / kDegree,
             human.ankle.low[i] / kDegree, human.ankle.high[i] / kDegree);
  return fitted.end() + band.end();
}

constexpr const char* kStyle = R"(
set style line 1 lc rgb '#c23b22' lw 2
set style line 2 lc rgb '#1f5fa8' lw 2
set style line 3 lc rgb '#444444' lw 2
set border 3 lc rgb '#888888'
set tics nomirror textcolor rgb '#444444'
set key top right samplen 1.5 textcolor rgb '#444444'
set multiplot
)";

constexpr const char* kPanels = R"(
set origin 0,0.70; set size 1,0.27; set lmargin 9; set rmargin 2
set xlabel 'time, s' offset 0,0.6; set ylabel 'forward of the pelvis, m'
plot $ankle_r_marks u 1:($4==0?$2:1/0) w p pt 7 ps 0.35 lc rgb '#e39a8c' t 'right ankle: marks', \
     $ankle_r u 1:2 w l ls 1 t 'fit', \
     $ankle_l_marks u 1:($4==0?$2:1/0) w p pt 7 ps 0.35 lc rgb '#93b4dc' t 'left ankle: marks', \
     $ankle_l u 1:2 w l ls 2 t 'fit', \
     $ankle_r_marks u 1:($4==1?$2:1/0) w p pt 2 ps 0.6 lc rgb '#222222' t 'not believed', \
     $ankle_l_marks u 1:($4==1?$2:1/0) w p pt 2 ps 0.6 lc rgb '#222222' notitle
unset key
set origin 0,0.36; set size 1,0.32
set xlabel 'the model at eight phases from the right foot strike (right leg red; bars: 95 %)' offset 0,0.6
set ylabel 'm'; set size ratio -1; set xrange [-0.7:8.75]; set yrange [-0.05:1.65]; unset xtics
plot 0 w l lc rgb '#bbbbbb', $trunk u 1:2 w l ls 3, $left u 1:2 w lp ls 2 pt 7 ps 0.4, \
     $right u 1:2 w lp ls 1 pt 7 ps 0.4, \
     $left u 1:2:3:4 w xyerrorbars lc rgb '#1f5fa8' pt 0, $right u 1:2:3:4 w xyerrorbars lc rgb '#c23b22' pt 0
set size noratio; set xtics 0,25,100 nomirror; set xrange [0:100]; set yrange [*:*]
set xlabel '% of the stride' offset 0,0.6
set origin 0,0; set size 0.34,0.34; set ylabel 'hip flexion, deg'
plot $band u 1:2:3 w filledcurves lc rgb '#d8d8d8' notitle, $angles u 1:2 w l ls 1
set origin 0.33,0; set size 0.34,0.34; set ylabel 'knee angle, deg'
plot $band u 1:4:5 w filledcurves lc rgb '#d8d8d8' notitle, $angles u 1:3 w l ls 1
set origin 0.66,0; set size 0.34,0.34; set ylabel 'ankle angle, deg'
plot $band u 1:6:7 w filledcurves lc rgb '#d8d8d8' notitle, $angles u 1:4 w l ls 1
unset multiplot
)";

/// Runs gnuplot on a script; its complaints become the error.
void run_gnuplot(const std::string& script) {
  std::FILE* pipe = ::popen("gnuplot 2>/dev/null", "w");
  require(pipe != nullptr, "gnuplot cannot be started: install the package gnuplot-nox");
  std::fwrite(script.data(), 1, script.size(), pipe);
  const int status = ::pclose(pipe);
  require(status == 0,
          "gnuplot failed (status {}): install the package gnuplot-nox, or leave the "
          "picture out with --no-picture",
          status);
}

}  // namespace

void draw_report(const Trajectory& trajectory, const Calibration& c,
                 const std::filesystem::path& file) {
  const bool png = file.extension() == ".png";
  std::string name = file.string();
  require(name.find('\'') == std::string::npos, "{}: a picture's name must not hold a quote", name);
  std::string script =
      fmt::format("set terminal {} size 1100,900 {} font 'DejaVu Sans,11'\nset output '{}'\n{}",
                  png ? "pngcairo" : "svg", png ? "" : "background rgb 'white'", name, kStyle);
  script += fmt::format(
      "set label 1 '{}: period {:.3f} s, {:.2f} m/s, {:.2f} px rms' at screen "
      "0.02,0.98 noenhanced\n",
      trajectory.video, c.run.period_s, c.run.speed_m_s, c.fit.rms_px);
  script += tracks(c, BodyPart::ankle_r, "ankle_r_marks", "ankle_r");
  script += tracks(c, BodyPart::ankle_l, "ankle_l_marks", "ankle_l");
  script += poses(c) + angles(c) + kPanels;
  run_gnuplot(script);
}

}  // namespace stride
