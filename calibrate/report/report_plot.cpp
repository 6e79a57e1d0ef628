#include "calibrate/report/report_plot.h"

#include "calibrate/report/report_frames.h"
#include "extract/io/file.h"
#include "extract/io/gnuplot.h"

namespace stride::report {
namespace {

/// The colours of both pictures, as variables of gnuplot, and what every panel has.
constexpr const char* kStyle = R"(
set encoding utf8
right = '#c23b22'; right_mark = '#dd8877'; right_band = '#f3cfc8'
left = '#1f5fa8'; left_mark = '#7fa5d4'; left_band = '#cddcf0'
trunk = '#555555'; outlier = '#222222'; letters = '#444444'; pale = '#eeeeee'
set style line 1 lc rgb right lw 1.8
set style line 2 lc rgb left lw 1.8
set style line 3 lc rgb trunk lw 1.8
set style fill solid 1 noborder
set border 3 lc rgb '#999999'
set tics nomirror scale 0.5 textcolor rgb letters
set grid ytics lc rgb pale lt 1
set multiplot
)";

}  // namespace

void Labels::write(const std::string& text, double x, double y, const char* how) {
  script_ += fmt::format("set label {} {} at screen {},{} {} noenhanced\n", ++count_,
                         gnuplot_string(text), x, y, how);
}

void Labels::title(const std::string& text, const std::string& aside) {
  write(text, 0.02, 0.985, "font ',13'");
  write(aside, 0.98, 0.985, "right font ',10' textcolor rgb '#777777'");
}

void Labels::below_frame(int k, const std::string& text, int height_px) {
  constexpr int kBelow_px = kStripTop_px + kStripHeight_px + 11;
  write(text, (kStripLeft_px + (k + 0.5) * kStrip_px / kReportKeyframes) / kWidth_px,
        1 - static_cast<double>(kBelow_px) / height_px, "center textcolor rgb letters");
}

std::string page_style(int height_px) {
  return fmt::format("set terminal svg size {},{} background rgb 'white' font 'DejaVu Sans,11'\n{}",
                     kWidth_px, height_px, kStyle);
}

std::string with_strip(std::string svg, const std::filesystem::path& video,
                       const Trajectory& trajectory, const SagittalModel& model,
                       const Calibration& c, const std::vector<int>& frames) {
  const std::size_t end = svg.rfind("</svg>");
  if (video.empty() || end == std::string::npos) return svg;
  svg.insert(end, fmt::format("<image x='{}' y='{}' width='{}' height='{}' "
                              "href='data:image/jpeg;base64,{}'/>\n",
                              kStripLeft_px, kStripTop_px, kStrip_px, kStripHeight_px,
                              base64_of(keyframe_strip(video, trajectory, model, c, frames,
                                                       2 * kStrip_px, 2 * kStripHeight_px))));
  return svg;
}

}  // namespace stride::report
