#include "train/page/clip_moments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "calibrate/fitted.h"
#include "extract/video/overlay.h"
#include "train/page/html.h"

namespace stride::page {
namespace {

constexpr int kThumbnail_px = 260;

const std::vector<Eigen::Vector2d>& pelvises_of(const Calibration& c) {
  return c.aperiodic ? c.aperiodic->fit.passage.pelvis_px : c.fit.pelvis_px;
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

/// The frames nearest to take-off, the middle of the flight and landing.
std::vector<int> flight_frames(const CalibratedClip& clip) {
  const CalibratedTrajectory& run = clip.calibration.run;
  std::vector<int> found;
  for (const double time_s :
       {run.take_off_s, 0.5 * (run.take_off_s + run.landing_s), run.landing_s}) {
    const auto nearest = std::ranges::min_element(
        clip.trajectory.frames, {},
        [&](const TrajectoryFrame& frame) { return std::abs(frame.time_s - time_s); });
    found.push_back(static_cast<int>(nearest - clip.trajectory.frames.begin()));
  }
  return found;
}

/// Frames side by side with the fitted legs, each with its moment.
std::string strip(const CalibratedClip& clip, const std::vector<int>& shown) {
  const Trajectory fitted = fitted_points(clip.trajectory, clip.model, clip.calibration);
  const double leg = leg_of(clip.calibration);
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
                      pelvises_of(clip.calibration)[static_cast<std::size_t>(i)]);
    html += picture(jpeg_uri(window(image, pelvis, 2.6 * leg)),
                    fmt::format("frame {}, {:.3f} s", at.frame, at.time_s));
  }
  return html + "</div>\n";
}

std::string period_section(const CalibratedClip& clip) {
  const CalibratedTrajectory& run = clip.calibration.run;
  const std::vector<int> strikes = frames_at(clip.calibration, 0);
  if (strikes.size() < 2) return "";
  return fmt::format(
             "<h2>The frames behind the period</h2>\n<p>A stride lasts {:.4f} ± {:.4f} s "
             "({:.0f} steps a minute). The right foot strikes at:</p>\n",
             run.period_s, 1.96 * run.period_sd_s, 120 / run.period_s) +
         strip(clip, strikes);
}

std::string speed_section(const CalibratedClip& clip) {
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

std::string flight_section(const CalibratedClip& clip) {
  const Calibration& c = clip.calibration;
  return fmt::format(
             "<h2>The flight</h2>\n<p>Both feet are off the ground for {:.3f} s, from {:.3f} s to "
             "{:.3f} s. The frames nearest to take-off, the middle of the flight and "
             "landing:</p>\n",
             c.run.landing_s - c.run.take_off_s, c.run.take_off_s, c.run.landing_s) +
         strip(clip, flight_frames(clip));
}

}  // namespace

double leg_of(const Calibration& c) {
  return c.aperiodic ? c.aperiodic->fit.passage.leg_px() : leg_px(c.fit.runner);
}

std::string jpeg_uri(const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, 80});
  return data_uri(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
                  "jpg");
}

cv::Mat window(const cv::Mat& image, const Eigen::Vector2d& middle_px, double side_px) {
  const double scale = kThumbnail_px / side_px;
  const cv::Matx23d map(scale, 0, 0.5 * kThumbnail_px - scale * middle_px.x(), 0, scale,
                        0.5 * kThumbnail_px - scale * middle_px.y());
  cv::Mat out;
  cv::warpAffine(image, out, map, {kThumbnail_px, kThumbnail_px}, cv::INTER_LINEAR,
                 cv::BORDER_CONSTANT, cv::Scalar(225, 225, 225));
  return out;
}

std::vector<int> shown_moments(const CalibratedClip& clip) {
  const Calibration& c = clip.calibration;
  if (c.aperiodic) return flight_frames(clip);
  std::vector<int> all;
  for (const double phase : {0.0, 0.05, std::max(c.gait.duty - 0.05, 0.1)})
    std::ranges::copy(frames_at(c, phase), std::back_inserter(all));
  return all;
}

std::string moments_section(const CalibratedClip& clip) {
  return clip.calibration.aperiodic ? flight_section(clip)
                                    : period_section(clip) + speed_section(clip);
}

}  // namespace stride::page
