#include "extract/tracking/corrections.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "extract/video/decoded_clip.h"

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

constexpr double kClicksAsPrior = 1.5;    // that no offset is expected weighs as much as these
constexpr double kReach_s = 0.04;         // over which the rest of a correction fades
constexpr double kFarthestSpread = 0.15;  // of the runner's size

const TrajectoryFrame* frame_of(const Trajectory& points, int frame) {
  const auto found = std::ranges::lower_bound(points.frames, frame, {}, &TrajectoryFrame::frame);
  return found != points.frames.end() && found->frame == frame ? &*found : nullptr;
}

/// (along, across) in units of the limb → pixels: its columns are the limb and that turned by 90°.
std::optional<Eigen::Matrix2d> axes(const TrajectoryFrame& frame, BodyPart joint, BodyPart above) {
  if (!frame[joint].present() || !frame[above].present()) return std::nullopt;
  const Vector2d limb = frame[joint].p_px - frame[above].p_px;
  if (limb.norm() < 1) return std::nullopt;
  Eigen::Matrix2d axes;
  axes << limb.x(), -limb.y(), limb.y(), limb.x();
  return axes;
}

/// Moves a joint of both legs on every frame by what the clicks say of it on average, in the axes
/// of the limb above it.
void move_along_limb(BodyPart right, const Trajectory& clicks, Trajectory& points) {
  const std::array joints{right, mirrored(right)};
  Vector2d sum = Vector2d::Zero();
  double count = kClicksAsPrior;
  for (const TrajectoryFrame& clicked : clicks.frames) {
    const TrajectoryFrame* detected = frame_of(points, clicked.frame);
    if (detected == nullptr) continue;
    for (const BodyPart joint : joints) {
      const auto to_px = axes(*detected, joint, row(joint).parent);
      if (!to_px || !clicked[joint].present()) continue;
      const Vector2d offset = to_px->inverse() * (clicked[joint].p_px - (*detected)[joint].p_px);
      if (offset.norm() > 0.5) continue;  // another leg, or nonsense
      // What the detector was unsure of is wrong by itself, and says little of the other frames.
      const double sure = std::min(1.0, (*detected)[joint].confidence / kPredictedConfidence);
      sum += sure * sure * offset;
      count += sure * sure;
    }
  }
  for (TrajectoryFrame& frame : points.frames)
    for (const BodyPart joint : joints)
      if (const auto to_px = axes(frame, joint, row(joint).parent))
        frame[joint].p_px += *to_px * sum / count;
}

/// The rest of the corrections of a part: each fades with the distance in time. A large one is of
/// a point on the other leg, and says nothing of the frames beside it.
void move_near_clicks(BodyPart part, double size_px, const Trajectory& clicks, Trajectory& points) {
  struct Rest {
    double time_s;
    Vector2d px;
  };
  std::vector<Rest> rests;
  for (const TrajectoryFrame& clicked : clicks.frames) {
    const TrajectoryFrame* detected = frame_of(points, clicked.frame);
    if (detected == nullptr || !clicked[part].present() || !(*detected)[part].present()) continue;
    const Vector2d rest_px = clicked[part].p_px - (*detected)[part].p_px;
    if (rest_px.norm() < kFarthestSpread * size_px) rests.push_back({detected->time_s, rest_px});
  }
  for (TrajectoryFrame& frame : points.frames) {
    Vector2d moved = Vector2d::Zero();
    double weights = 0;
    for (const Rest& rest : rests) {
      const double weight = std::exp(-0.5 * std::pow((frame.time_s - rest.time_s) / kReach_s, 2));
      moved += weight * rest.px;
      weights += weight;
    }
    if (frame[part].present()) frame[part].p_px += moved / std::max(weights, 1.0);
  }
}

void put(const Trajectory& clicks, Trajectory& points) {
  for (const TrajectoryFrame& clicked : clicks.frames) {
    auto at = std::ranges::lower_bound(points.frames, clicked.frame, {}, &TrajectoryFrame::frame);
    if (at == points.frames.end() || at->frame != clicked.frame) {
      at = points.frames.insert(at, TrajectoryFrame{});
      at->frame = clicked.frame;
      at->time_s = clicked.time_s;
    }
    for (const BodyPart part : kBodyParts)
      if (clicked[part].source != Source::unknown) (*at)[part] = clicked[part];
  }
}

}  // namespace

Trajectory corrected(const Trajectory& detected, const Trajectory& clicks) {
  Trajectory points = detected;
  for (const Bone& bone : kBones)
    if (row(bone.to).side == Side::right) move_along_limb(bone.to, clicks, points);
  const double size_px = video::body_size_px(points);
  for (const BodyPart part : kBodyParts) move_near_clicks(part, size_px, clicks, points);
  put(clicks, points);
  return points;
}

}  // namespace stride::tracking
