#include "extract/tracking/corrections.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <vector>

#include "extract/io/statistics.h"
#include "extract/skeleton/least_squares.h"
#include "extract/tracking/limb_lengths.h"
#include "extract/video/decoded_clip.h"

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

constexpr double kDoubtful = 1.7;   // times the usual noise
constexpr double kMemory_s = 0.02;  // correlation time of the detector's noise
constexpr double kGross = 2.5;      // standard deviations: on another leg, or nonsense

const TrajectoryFrame* frame_of(const Trajectory& points, int frame) {
  const auto found = std::ranges::lower_bound(points.frames, frame, {}, &TrajectoryFrame::frame);
  return found != points.frames.end() && found->frame == frame ? &*found : nullptr;
}

/// (along, across) the limb that ends in a joint → the picture. Of a part without a limb: down.
std::optional<Eigen::Matrix2d> axes(const TrajectoryFrame& frame, BodyPart joint) {
  const BodyPart above = row(joint).parent;
  if (!frame[joint].present() || !frame[above].present()) return std::nullopt;
  Vector2d along(0, 1);
  if (above != joint) along = frame[joint].p_px - frame[above].p_px;
  if (along.norm() < 1) return std::nullopt;
  along.normalize();
  Eigen::Matrix2d axes;
  axes << along.x(), -along.y(), along.y(), along.x();
  return axes;
}

/// What a click says of the detector's point beneath it, in leg lengths along and across the limb.
struct Offset {
  BodyPart part{};
  double time_s = 0, noise_legs = 0;
  Vector2d legs = Vector2d::Zero();
};

/// Median over the clip.
double usual_noise_legs(BodyPart either, const Trajectory& detected) {
  std::vector<double> noises;
  for (const TrajectoryFrame& frame : detected.frames)
    for (const BodyPart part : std::set{either, mirrored(either)})
      if (frame[part].present()) noises.push_back(detected_noise_legs(frame[part].confidence));
  return noises.empty() ? 0 : median(std::move(noises));
}

/// Not of points that the detector is much less sure of than usual: these are wrong by themselves.
std::vector<Offset> offsets_on(BodyPart either, double leg_px, const Trajectory& clicks,
                               const Trajectory& detected) {
  const Convention known = convention(either);
  const double doubtful = kDoubtful * usual_noise_legs(either, detected);
  std::vector<Offset> offsets;
  for (const TrajectoryFrame& clicked : clicks.frames) {
    const TrajectoryFrame* frame = frame_of(detected, clicked.frame);
    if (frame == nullptr) continue;
    for (const BodyPart part : std::set{either, mirrored(either)}) {
      const auto to_px = axes(*frame, part);
      if (!to_px || !clicked[part].present()) continue;
      const double noise = detected_noise_legs((*frame)[part].confidence);
      const Vector2d legs =
          to_px->transpose() * (clicked[part].p_px - (*frame)[part].p_px) / leg_px;
      const double spread = std::hypot(known.along_legs, noise, kHand_legs);
      if (noise < doubtful && legs.norm() < kGross * spread)
        offsets.push_back({part, frame->time_s, noise, legs});
    }
  }
  return offsets;
}

/// Covariance of the offset of all frames in one axis, and of the noise at two points.
double covariance(const Offset& a, const Offset& b, double convention_legs) {
  const double together =
      a.part == b.part ? std::exp(-std::abs(a.time_s - b.time_s) / kMemory_s) : 0;
  return convention_legs * convention_legs + a.noise_legs * b.noise_legs * together;
}

/// Moves a part of both sides on every frame.
void teach(BodyPart either, double leg_px, const Trajectory& clicks, const Trajectory& detected,
           Trajectory& points) {
  const std::vector<Offset> offsets = offsets_on(either, leg_px, clicks, detected);
  if (offsets.empty()) return;
  const auto n = static_cast<Eigen::Index>(offsets.size());
  const auto at = [&](Eigen::Index i) -> const Offset& {
    return offsets[static_cast<std::size_t>(i)];
  };
  const Convention known = convention(either);
  const std::array sd{known.along_legs, known.across_legs};
  std::array<Eigen::VectorXd, 2> weights;
  for (const int axis : {0, 1}) {
    Eigen::MatrixXd covariances(n, n);
    Eigen::VectorXd seen(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      seen[i] = at(i).legs[axis];
      for (Eigen::Index j = 0; j < n; ++j)
        covariances(i, j) =
            covariance(at(i), at(j), sd[axis]) + (i == j ? kHand_legs * kHand_legs : 0);
    }
    weights[axis] = solve_positive(covariances, seen);
  }
  for (std::size_t k = 0; k < points.frames.size(); ++k)
    for (const BodyPart part : std::set{either, mirrored(either)}) {
      const TrajectoryFrame& frame = detected.frames[k];
      const auto to_px = axes(frame, part);
      if (!to_px) continue;
      const Offset here{part, frame.time_s, detected_noise_legs(frame[part].confidence)};
      Vector2d legs = Vector2d::Zero();
      for (const int axis : {0, 1})
        for (Eigen::Index i = 0; i < n; ++i)
          legs[axis] += covariance(here, at(i), sd[axis]) * weights[axis][i];
      points.frames[k][part].p_px += *to_px * legs * leg_px;
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

double detected_noise_legs(double confidence) {
  constexpr double kLeast = 0.05;
  return kDetectedNoise_legs / std::clamp(confidence, kLeast, 1.0);
}

Convention convention(BodyPart part) {
  switch (part) {
    case BodyPart::pelvis:
    case BodyPart::hip_r:
    case BodyPart::hip_l:
    case BodyPart::head:
      return {0.015, 0.015};
    case BodyPart::knee_r:
    case BodyPart::knee_l:
      return {0.012, 0.012};
    case BodyPart::ankle_r:
    case BodyPart::ankle_l:
      return {0.035, 0.012};
    case BodyPart::toe_r:
    case BodyPart::toe_l:
    case BodyPart::heel_r:
    case BodyPart::heel_l:
      return {0.07, 0.02};
  }
  return {};
}

Trajectory corrected(const Trajectory& detected, const Trajectory& clicks) {
  Trajectory points = detected;
  const double leg = leg_px(detected);
  for (const BodyPart part : kBodyParts)
    if (row(part).side != Side::left) teach(part, leg, clicks, detected, points);
  put(clicks, points);
  return points;
}

}  // namespace stride::tracking
