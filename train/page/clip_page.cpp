#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>

#include "calibrate/calibrate.h"
#include "calibrate/fitted.h"
#include "calibrate/report/report.h"
#include "calibrate/report/report_frames.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/video/overlay.h"
#include "extract/video/video.h"
#include "train/page/html.h"
#include "train/page/page.h"
#include "train/page/scratch.h"

namespace stride::page {
namespace fs = std::filesystem;
namespace {

constexpr int kShownOutliers = 12, kThumbnail_px = 260;

/// A clip with everything that is known about it.
struct Clip {
  fs::path video;
  Trajectory trajectory;
  SagittalModel model;
  Calibration calibration;
  std::map<int, cv::Mat> frames;  // by their number in the video: those that are shown
};

/// A mark that the fit does not believe.
struct Outlier {
  fit::Mark mark;
  double off_px = 0;
};

std::vector<Outlier> outliers(const Calibration& c) {
  std::vector<Outlier> marks;
  for (std::size_t i = 0; i < c.fit.marks.size(); ++i)
    if (c.fit.marks[i].outlier)
      marks.push_back({c.observations.points[i], c.fit.marks[i].r_px.norm()});
  std::ranges::sort(marks, std::ranges::greater{}, &Outlier::off_px);
  return marks;
}

/// Index into Trajectory::frames of the frame nearest to each moment at which `phase` of the
/// right leg's stride comes by, 0 being its foot strike.
std::vector<int> frames_at(const Calibration& c, double phase) {
  std::vector<int> found;
  const auto turns = [&](std::size_t i) {
    return phase_at(c.fit.runner.cadence.data(), c.observations.u_s[i]) - c.gait.foot_strike -
           phase;
  };
  for (std::size_t i = 1; i < c.observations.u_s.size(); ++i) {
    const double before = turns(i - 1), after = turns(i);
    if (std::floor(before) == std::floor(after)) continue;
    found.push_back(
        static_cast<int>(std::floor(after) - before < after - std::floor(after) ? i - 1 : i));
  }
  return found;
}

void read_frames(const std::set<int>& wanted, Clip& clip) {
  video::Video decoder(clip.video);
  video::VideoFrame frame;
  while (clip.frames.size() < wanted.size() && decoder.read(frame))
    if (wanted.contains(frame.index)) clip.frames[frame.index] = frame.image;
}

std::string jpeg_uri(const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, 80});
  return data_uri(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
                  "jpg");
}

/// A square window around a point, what lies outside the frame in grey.
cv::Mat window(const cv::Mat& image, const Eigen::Vector2d& middle_px, double side_px) {
  const double scale = kThumbnail_px / side_px;
  const cv::Matx23d map(scale, 0, 0.5 * kThumbnail_px - scale * middle_px.x(), 0, scale,
                        0.5 * kThumbnail_px - scale * middle_px.y());
  cv::Mat out;
  cv::warpAffine(image, out, map, {kThumbnail_px, kThumbnail_px}, cv::INTER_LINEAR,
                 cv::BORDER_CONSTANT, cv::Scalar(225, 225, 225));
  return out;
}

/// Frames side by side with the fitted legs, each with its moment.
std::string strip(const Clip& clip, const std::vector<int>& shown) {
  const Trajectory fitted = fitted_points(clip.trajectory, clip.model, clip.calibration);
  const double leg = leg_px(clip.calibration.fit.runner);
  std::string html = "<div class=\"strip\">";
  for (const int i : shown) {
    const TrajectoryFrame& at = clip.trajectory.frames[static_cast<std::size_t>(i)];
    if (!clip.frames.contains(at.frame)) continue;
    cv::Mat image = clip.frames.at(at.frame).clone();
    video::OverlayStyle style = video::overlay_style(clip.trajectory);
    style.trail_s = 0;
    video::draw_points(image, fitted, static_cast<std::size_t>(i), style);
    const Eigen::Vector2d pelvis =
        fit::image_px(clip.trajectory, clip.calibration.observations.to_left,
                      clip.calibration.fit.pelvis_px[static_cast<std::size_t>(i)]);
    html += picture(jpeg_uri(window(image, pelvis, 2.6 * leg)),
                    fmt::format("frame {}, {:.3f} s", at.frame, at.time_s));
  }
  return html + "</div>\n";
}

std::string period_section(const Clip& clip) {
  const CalibratedTrajectory& run = clip.calibration.run;
  const std::vector<int> strikes = frames_at(clip.calibration, 0);
  if (strikes.size() < 2) return "";
  return fmt::format(
             "<h2>The frames behind the period</h2>\n<p>A stride lasts {:.4f} ± {:.4f} s "
             "({:.0f} steps a minute). The right foot strikes at:</p>\n",
             run.period_s, 1.96 * run.period_sd_s, 120 / run.period_s) +
         strip(clip, strikes);
}

std::string speed_section(const Clip& clip) {
  const Calibration& c = clip.calibration;
  std::vector<int> stance = frames_at(c, 0.05),
                   end = frames_at(c, std::max(c.gait.duty - 0.05, 0.1));
  if (stance.empty() || end.empty()) return "";
  const auto last = std::ranges::find_if(end, [&](int i) { return i > stance.front(); });
  if (last == end.end()) return "";
  return fmt::format(
             "<h2>The frames behind the speed</h2>\n<p>{:.2f} m/s is how fast the foot that stands "
             "goes back under the pelvis; a foot stands for {:.0f} % of the stride. The right foot "
             "soon after its strike and soon before it leaves the ground:</p>\n",
             c.run.speed_m_s, 100 * c.gait.duty) +
         strip(clip, {stance.front(), *last});
}

std::string outlier_section(const Clip& clip, const std::vector<Outlier>& marks) {
  const Calibration& c = clip.calibration;
  std::string html = fmt::format(
      "<h2>Outliers</h2>\n<p>{} of {} marks lie too far from the fitted "
      "stride "
      "and do not count{}</p>\n",
      marks.size(), c.fit.marks.size(),
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
                          fitted = in_image(fit::predicted_px(c.fit, directions, mark.part,
                                                              mark.frame, mark.u_s));
    cv::Mat image = clip.frames.at(at.frame).clone();
    const auto point = [](const Eigen::Vector2d& p) {
      return cv::Point(static_cast<int>(std::lround(p.x())), static_cast<int>(std::lround(p.y())));
    };
    cv::circle(image, point(marked), 4, {60, 60, 230}, 1, cv::LINE_AA);
    cv::drawMarker(image, point(fitted), {60, 200, 60}, cv::MARKER_TILTED_CROSS, 8, 1, cv::LINE_AA);
    html += picture(
        jpeg_uri(window(image, 0.5 * (marked + fitted), 1.5 * leg_px(c.fit.runner))),
        fmt::format("frame {}: {}, {:.1f} px off", at.frame, name(mark.part), marks[k].off_px));
  }
  return html + "</div>\n";
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
  Clip clip;
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
  if (c.fit.ok)
    body += table(
        {{"stride", "cadence", "speed", "stands", "residual"},
         {fmt::format("{:.3f} ± {:.3f} s", c.run.period_s, 1.96 * c.run.period_sd_s),
          fmt::format("{:.0f} /min", 120 / c.run.period_s),
          fmt::format("{:.2f} m/s", c.run.speed_m_s), fmt::format("{:.0f} %", 100 * c.gait.duty),
          fmt::format("{:.1f} px", c.fit.rms_px)}});
  const Trajectory drawn =
      c.fit.ok ? fitted_points(clip.trajectory, clip.model, c) : clip.trajectory;
  video::write_overlay(clip.video, drawn, scratch.folder / "film.mp4");
  body += film(data_uri(scratch.folder / "film.mp4"),
               c.fit.ok ? "The clip with the fitted runner." : "The clip with the tracked points.");
  if (c.fit.ok) {
    const std::vector<Outlier> marks = outliers(c);
    std::set<int> wanted;
    const auto want = [&](const std::vector<int>& indices) {
      for (const int i : indices)
        wanted.insert(clip.trajectory.frames[static_cast<std::size_t>(i)].frame);
    };
    want(frames_at(c, 0)), want(frames_at(c, 0.05));
    want(frames_at(c, std::max(c.gait.duty - 0.05, 0.1)));
    for (std::size_t k = 0; k < std::min<std::size_t>(kShownOutliers, marks.size()); ++k)
      want({marks[k].mark.frame});
    read_frames(wanted, clip);
    body += period_section(clip) + speed_section(clip);
    report::draw_report(clip.trajectory, clip.model, c, clip.video, scratch.folder / "report.svg");
    body += "<h2>The fit</h2>\n" +
            picture(data_uri(scratch.folder / "report.svg"),
                    "Keyframes on the frames of the video; marks against the fit with its 95 % "
                    "bands; joint angles against the band of measured runners.");
    body += outlier_section(clip, marks);
  }
  body += unseen_section(clip.trajectory);
  body += folded("The report in words", text);
  return document(fmt::format("Clip {}", clip.trajectory.video), body);
}

}  // namespace stride::page
