#include "extract/annotation/points_of_video.h"

#include <fmt/format.h>

#include <algorithm>

#include "extract/annotation/journal.h"
#include "extract/annotation/points_on_video.h"
#include "extract/io/error.h"
#include "extract/pose/network_points.h"
#include "extract/pose/weights.h"
#include "extract/tracking/corrections.h"
#include "extract/tracking/leg_identity.h"
#include "extract/video/decoded_clip.h"
#include "extract/video/video.h"

namespace stride::tracking {
namespace fs = std::filesystem;
namespace {

void tell(const std::string& video, const pose::NetworkPoints& points) {
  const auto& [frames, lost, doubtful] = points.followed;
  fmt::print(stderr, "{}: the pose network follows person {} of {} on {} of {} frames{}\n", video,
             points.detections.person, points.detections.people.size(), frames - lost, frames,
             doubtful > 0 ? fmt::format(", unsure of the legs on {}", doubtful) : "");
  for (const int other : points.also_running)
    fmt::print(stderr, "warning: {}: person {} makes strides too; --person {} takes that one\n",
               video, other, other);
}

}  // namespace

LabelledClip points_of_network(const fs::path& video, const PointsOptions& options) {
  pose::NetworkOptions network;
  network.landmarks = options.landmarks;
  network.person = options.person;
  network.progress = options.progress;
  const pose::NetworkPoints points = pose::network_points(video, network);
  tell(video.string(), points);
  const double slow_motion = options.slow_motion > 0 ? options.slow_motion : 1;
  LabelledClip seen = points_on(video, points.detections, {slow_motion, options.repair_legs, {}});
  seen.points = "network";
  return seen;
}

namespace {

/// How much farther knees and ankles are from the clicks with the legs as they are than exchanged,
/// in sizes of the runner. A point that the network is unsure of says little: it may be on the
/// wrong leg on its frame alone, and such points are corrected first.
double exchange_gain(const Trajectory& seen, const Trajectory& clicks) {
  constexpr double kMost = 0.3;  // of one point
  const double size_px = video::body_size_px(seen);
  double gain = 0;
  for (const TrajectoryFrame& clicked : clicks.frames)
    for (const TrajectoryFrame& frame : seen.frames) {
      if (frame.frame != clicked.frame) continue;
      for (const BodyPart part :
           {BodyPart::knee_r, BodyPart::knee_l, BodyPart::ankle_r, BodyPart::ankle_l}) {
        const Point &click = clicked[part], &own = frame[part], &other = frame[mirrored(part)];
        if (click.present() && own.present() && other.present())
          gain += own.confidence *
                  std::clamp(
                      ((own.p_px - click.p_px).norm() - (other.p_px - click.p_px).norm()) / size_px,
                      -kMost, kMost);
      }
    }
  return gain;
}

}  // namespace

LabelledClip mixed(LabelledClip network, const LabelledClip& clicks) {
  LabelledClip result = std::move(network);
  constexpr double kClearly = 0.25;  // as two points that the network is sure of
  if (exchange_gain(result.marks, clicks.marks) > kClearly)
    for (TrajectoryFrame& frame : result.marks.frames) swap_legs(frame);
  result.marks = corrected(result.marks, clicks.marks);
  if (!clicks.marks.frames.empty()) result.points = "mixed";
  result.slow_motion = clicks.slow_motion;
  if (clicks.marks.direction) result.marks.direction = clicks.marks.direction;
  result.marks.movement = clicks.marks.movement;
  result.marks.treadmill = clicks.marks.treadmill;
  result.marks.floor_roll_rad = clicks.marks.floor_roll_rad;
  result.marks.calibration_line = clicks.marks.calibration_line;
  return result;
}

namespace {

fs::path clicks_file(const fs::path& video, const PointsOptions& options) {
  return options.keypoints.empty() ? keypoints_file_of(video) : options.keypoints;
}

bool is_clicked(const fs::path& video, const PointsOptions& options) {
  return !options.keypoints.empty() || fs::exists(clicks_file(video, options));
}

}  // namespace

bool is_seen_by_network(const fs::path& video, const PointsOptions& options) {
  return options.network || !is_clicked(video, options) ||
         load_keypoints(clicks_file(video, options)).corrects_network;
}

LabelledClip points_of_video(const fs::path& video, const PointsOptions& options) {
  video::require_video_file(video);
  const fs::path file = clicks_file(video, options);
  annotation::fold_left_over_journal(file);
  const bool clicked = is_clicked(video, options);
  if (!is_seen_by_network(video, options)) return clicks_on(video, file, options.slow_motion);
  require(options.network || pose::installed_weights().has_value(),
          "{}: {}; click points with 'stride annotate {}', import them with 'stride track "
          "--import', or "
          "let a network find them: {}",
          video.string(),
          clicked ? fmt::format("its clicks correct a pose network, which is not installed")
                  : fmt::format("not clicked: {} is missing", file.string()),
          video.string(), pose::how_to_install_weights());
  if (!clicked) return points_of_network(video, options);

  const LabelledClip clicks = clicks_on(video, file, options.slow_motion);
  PointsOptions as_clicked = options;
  as_clicked.slow_motion = clicks.slow_motion;
  return mixed(points_of_network(video, as_clicked), clicks);
}

}  // namespace stride::tracking
