#include "extract/annotation/points_of_video.h"

#include <fmt/format.h>

#include "extract/annotation/journal.h"
#include "extract/annotation/points_on_video.h"
#include "extract/io/error.h"
#include "extract/pose/network_points.h"
#include "extract/pose/weights.h"
#include "extract/tracking/corrections.h"
#include "extract/tracking/leg_identity.h"
#include "extract/video/video.h"

namespace stride::tracking {
namespace fs = std::filesystem;
namespace {

void tell(const std::string& video, const pose::NetworkPoints& points) {
  const auto& [frames, lost, doubtful] = points.followed;
  fmt::print(stderr, "{}: the pose network follows person {} of {} on {} of {} frames{}\n", video,
             points.detections.person, points.detections.people.size(), frames - lost, frames,
             doubtful > 0 ? fmt::format(", unsure of the legs on {}", doubtful) : "");
}

LabelledClip seen_by_network(const fs::path& video, const PointsOptions& options) {
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

/// How much farther knees and ankles are from the clicks with the legs as they are than exchanged,
/// px.
double exchange_gain(const Trajectory& seen, const Trajectory& clicks) {
  double gain = 0;
  for (const TrajectoryFrame& clicked : clicks.frames)
    for (const TrajectoryFrame& frame : seen.frames) {
      if (frame.frame != clicked.frame) continue;
      for (const BodyPart part :
           {BodyPart::knee_r, BodyPart::knee_l, BodyPart::ankle_r, BodyPart::ankle_l}) {
        const Point &click = clicked[part], &own = frame[part], &other = frame[mirrored(part)];
        if (click.present() && own.present() && other.present())
          gain += (own.p_px - click.p_px).norm() - (other.p_px - click.p_px).norm();
      }
    }
  return gain;
}

}  // namespace

LabelledClip points_of_video(const fs::path& video, const PointsOptions& options) {
  video::require_video_file(video);
  const fs::path file = options.keypoints.empty() ? keypoints_file_of(video) : options.keypoints;
  annotation::fold_left_over_journal(file);
  const bool clicked = fs::exists(file) || !options.keypoints.empty();
  if (clicked && !options.network) return clicks_on(video, file, options.slow_motion);
  require(
      options.network || pose::installed_weights().has_value(),
      "{}: not clicked: {} is missing; click points with 'stride annotate {}', import them with "
      "'stride track --import', or let a network find them: {}",
      video.string(), file.string(), video.string(), pose::how_to_install_weights());
  if (!clicked) return seen_by_network(video, options);

  const LabelledClip clicks = clicks_on(video, file, options.slow_motion);
  PointsOptions network = options;
  network.slow_motion = clicks.slow_motion;
  LabelledClip mixed = seen_by_network(video, network);
  if (exchange_gain(mixed.marks, clicks.marks) > 0)
    for (TrajectoryFrame& frame : mixed.marks.frames) swap_legs(frame);
  mixed.marks = corrected(mixed.marks, clicks.marks);
  mixed.points = "mixed";
  if (clicks.marks.direction) mixed.marks.direction = clicks.marks.direction;
  mixed.marks.treadmill = clicks.marks.treadmill;
  mixed.marks.floor_roll_rad = clicks.marks.floor_roll_rad;
  return mixed;
}

}  // namespace stride::tracking
