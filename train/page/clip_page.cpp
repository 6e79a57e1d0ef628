#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "calibrate/fitted.h"
#include "calibrate/report/report.h"
#include "calibrate/report/report_frames.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/video/overlay.h"
#include "extract/video/video.h"
#include "train/page/clip_moments.h"
#include "train/page/html.h"
#include "train/page/page.h"
#include "train/page/scratch.h"

namespace stride::page {
namespace fs = std::filesystem;
namespace {

constexpr int kShownOutliers = 12;

/// A mark that the fit does not believe.
struct Outlier {
  fit::Mark mark;
  double off_px = 0;
};

/// Of every mark against the fit, whichever it is.
const std::vector<fit::MarkResidual>& residuals_of(const Calibration& c) {
  return c.aperiodic ? c.aperiodic->fit.marks : c.fit.marks;
}

std::vector<Outlier> outliers(const Calibration& c) {
  std::vector<Outlier> marks;
  const std::vector<fit::MarkResidual>& residuals = residuals_of(c);
  for (std::size_t i = 0; i < residuals.size(); ++i)
    if (residuals[i].outlier) marks.push_back({c.observations.points[i], residuals[i].r_px.norm()});
  std::ranges::sort(marks, std::ranges::greater{}, &Outlier::off_px);
  return marks;
}

void read_frames(const std::set<int>& wanted, CalibratedClip& clip) {
  video::Video decoder(clip.video);
  video::VideoFrame frame;
  while (clip.frames.size() < wanted.size() && decoder.read(frame))
    if (wanted.contains(frame.index)) clip.frames[frame.index] = frame.image;
}

std::string outlier_section(const CalibratedClip& clip, const std::vector<Outlier>& marks) {
  const Calibration& c = clip.calibration;
  std::string html = fmt::format(
      "<h2>Outliers</h2>\n<p>{} of {} marks lie too far from the fit "
      "and do not count{}</p>\n",
      marks.size(), residuals_of(c).size(),
      marks.empty() ? "." : ". The farthest (circle: the mark; cross: the fit):");
  if (marks.empty()) return html;
  const Directions directions(clip.model);
  html += "<div class=\"strip\">";
  for (std::size_t k = 0; k < std::min<std::size_t>(kShownOutliers, marks.size()); ++k) {
    const fit::Mark& mark = marks[k].mark;
    const TrajectoryFrame& at = clip.trajectory.frames[static_cast<std::size_t>(mark.frame)];
    if (!clip.frames.contains(at.frame)) continue;
    const auto in_image = [&](const Eigen::Vector2d& z_px) {
      return fit::image_px(clip.trajectory, c.observations.to_left, z_px);
    };
    const Eigen::Vector2d marked = in_image(mark.z_px),
                          fitted = in_image(c.aperiodic
                                                ? aperiodic::predicted_px(c.aperiodic->fit.passage,
                                                                          directions, mark.part,
                                                                          mark.frame, mark.u_s)
                                                : fit::predicted_px(c.fit, directions, mark.part,
                                                                    mark.frame, mark.u_s));
    cv::Mat image = clip.frames.at(at.frame).clone();
    const auto point = [](const Eigen::Vector2d& p) {
      return cv::Point(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
    };
    cv::circle(image, point(marked), 4, {60, 60, 230}, 1, cv::LINE_AA);
    cv::drawMarker(image, point(fitted), {60, 200, 60}, cv::MARKER_TILTED_CROSS, 8, 1, cv::LINE_AA);
    html += picture(
        jpeg_uri(window(image, 0.5 * (marked + fitted), 1.5 * leg_of(c))),
        fmt::format("frame {}: {}, {:.1f} px off", at.frame, name(mark.part), marks[k].off_px));
  }
  return html + "</div>\n";
}

/// The figures of the fit.
std::string figures(const Calibration& c) {
  if (c.aperiodic)
    return table({{"in the air", "take-off forward", "upward", "scale", "residual"},
                  {fmt::format("{:.3f} s", c.run.landing_s - c.run.take_off_s),
                   fmt::format("{:.2f} m/s",
                               c.aperiodic->flight.velocity_px_s.x() / c.aperiodic->scale.px_per_m),
                   fmt::format("{:.2f} m/s",
                               c.aperiodic->flight.velocity_px_s.y() / c.aperiodic->scale.px_per_m),
                   fmt::format("{:.2f} mm/px ± {:.1f} %", 1000 / c.aperiodic->scale.px_per_m,
                               196 * c.aperiodic->scale.relative_sd),
                   fmt::format("{:.1f} px", c.aperiodic->fit.rms_px)}});
  return table(
      {{"stride", "cadence", "speed", "stands", "residual"},
       {fmt::format("{:.3f} ± {:.3f} s", c.run.period_s, 1.96 * c.run.period_sd_s),
        fmt::format("{:.0f} /min", 120 / c.run.period_s),
        fmt::format("{:.2f} m/s", c.run.speed_m_s), fmt::format("{:.0f} %", 100 * c.gait.duty),
        fmt::format("{:.1f} px", c.fit.rms_px)}});
}

/// The points that the tracker has without having seen them, by part.
std::string unseen_section(const Trajectory& trajectory) {
  std::vector<std::vector<std::string>> rows{
      {"part", "clicked", "seen", "only predicted", "absent"}};
  for (const BodyPart part : kBodyParts) {
    int clicked = 0, seen = 0, predicted = 0, absent = 0;
    for (const TrajectoryFrame& frame : trajectory.frames) {
      const Point& point = frame[part];
      ++(!point.present()                  ? absent
         : point.source == Source::clicked ? clicked
         : point.seen()                    ? seen
                                           : predicted);
    }
    if (clicked + seen + predicted > 0)
      rows.push_back({std::string(name(part)), fmt::format("{}", clicked), fmt::format("{}", seen),
                      fmt::format("{}", predicted), fmt::format("{}", absent)});
  }
  return "<h2>Where the points come from</h2>\n<p>Frames in which each part was clicked, seen in "
         "the picture, or only predicted by the gait.</p>\n" +
         table(rows);
}

}  // namespace

std::string clip_page(const fs::path& trajectory, const fs::path& video) {
  CalibratedClip clip;
  clip.video = video;
  clip.trajectory = load_trajectory(trajectory);
  clip.model = sagittal_model(osim::load_osim(osim::default_model_file()));
  if (clip.video.empty())
    clip.video = report::video_in(fs::absolute(trajectory).parent_path(), clip.trajectory);
  require(!clip.video.empty(),
          "{}: its video {} does not lie beside it, or is not the one that was tracked; give it by "
          "--video",
          trajectory.string(), clip.trajectory.video);
  require(sha256_of_file(clip.video) == clip.trajectory.video_sha256,
          "--video {}: is not the video that was tracked ({})", clip.video.string(),
          clip.trajectory.video);
  clip.calibration = calibrate(clip.trajectory, clip.model);
  const Calibration& c = clip.calibration;
  const std::string text = report::report_text(clip.trajectory, clip.model, c);
  const Scratch scratch;
  std::string body =
      fmt::format("<p class=\"verdict\">Verdict: {}.</p>\n", escaped(c.verdict.text()));
  if (c.ok()) body += figures(c);
  const Trajectory drawn = c.ok() ? fitted_points(clip.trajectory, clip.model, c) : clip.trajectory;
  video::write_overlay(clip.video, drawn, scratch.folder / "film.mp4");
  body += film(data_uri(scratch.folder / "film.mp4"),
               c.ok() ? "The clip with the fitted runner." : "The clip with the tracked points.");
  if (c.ok()) {
    const std::vector<Outlier> marks = outliers(c);
    std::set<int> wanted;
    const auto want = [&](int i) {
      wanted.insert(clip.trajectory.frames[static_cast<std::size_t>(i)].frame);
    };
    std::ranges::for_each(shown_moments(clip), want);
    for (std::size_t k = 0; k < std::min<std::size_t>(kShownOutliers, marks.size()); ++k)
      want(marks[k].mark.frame);
    read_frames(wanted, clip);
    body += moments_section(clip);
    report::draw_report(clip.trajectory, clip.model, c, clip.video, scratch.folder / "report.svg");
    body += "<h2>The fit</h2>\n" +
            picture(data_uri(scratch.folder / "report.svg"),
                    c.aperiodic
                        ? "Moments of the movement on the frames of the video; heights; marks "
                          "against the fit; joint angles with their 95 % bands."
                        : "Keyframes on the frames of the video; marks against the fit with its 95 "
                          "% bands; joint angles against the band of measured runners.");
    body += outlier_section(clip, marks);
  }
  body += unseen_section(clip.trajectory);
  body += folded("The report in words", text);
  return document(fmt::format("CalibratedClip {}", clip.trajectory.video), body);
}

}  // namespace stride::page
