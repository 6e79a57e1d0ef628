#include "extract/tracking/limb_lengths.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "extract/io/statistics.h"
#include "extract/video/decoded_clip.h"

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

constexpr double kAround_s = 1;          // in which a limb keeps its length in the picture
constexpr double kForeshortened = 0.08;  // of its length: a limb out of the picture's plane
constexpr double kLeastConfidence = 0.05;
constexpr int kFewestLimbs = 8;  // limbs that say how long it is
constexpr int kIterations = 3;

constexpr bool is_limb(const Bone& bone) { return row(bone.to).required; }

/// A limb on a frame, weighted by how sure both ends are.
struct Length {
  double time_s = 0, px = 0, weight = 0;
};

double weighted_median(std::vector<Length>& lengths) {
  std::ranges::sort(lengths, {}, &Length::px);
  double half = 0;
  for (const Length& each : lengths) half += each.weight / 2;
  for (const Length& each : lengths)
    if ((half -= each.weight) <= 0) return each.px;
  return lengths.back().px;
}

/// The lengths of a limb of either side over the clip.
std::vector<Length> lengths_of(const Trajectory& points, const Bone& bone) {
  std::vector<Length> lengths;
  for (const TrajectoryFrame& frame : points.frames)
    for (const auto& [from, to] : {bone, Bone{mirrored(bone.from), mirrored(bone.to)}}) {
      const Point &a = frame[from], &b = frame[to];
      if (a.present() && b.present())
        lengths.push_back({frame.time_s, (b.p_px - a.p_px).norm(),
                           std::pow(std::min(a.confidence, b.confidence), 2)});
    }
  return lengths;
}

std::optional<double> usual_px(const std::vector<Length>& lengths, double time_s) {
  std::vector<Length> near;
  for (const Length& each : lengths)
    if (std::abs(each.time_s - time_s) < kAround_s) near.push_back(each);
  if (near.size() < kFewestLimbs) return std::nullopt;
  return weighted_median(near);
}

/// A limb of a frame that should have a length.
struct Limb {
  Bone bone;
  double usual_px = 0;
};

/// Of the parts that a person can be asked for: the others end no limb of a known length.
constexpr int kParts = static_cast<int>(kAskedParts.size());
using Places = Eigen::Matrix<double, 2 * kParts, 1>;

/// How far each point has to move until the limbs have their lengths: Gauss–Newton.
Places needed_px(const TrajectoryFrame& frame, const std::vector<Limb>& limbs,
                 const std::array<double, kParts>& sd_px) {
  constexpr int kSize = 2 * kParts;
  Places moved = Places::Zero();
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::Matrix<double, kSize, kSize> normal = Eigen::Matrix<double, kSize, kSize>::Zero();
    Places right = Places::Zero();
    for (int i = 0; i < kParts; ++i)
      for (int axis = 0; axis < 2; ++axis)
        normal(2 * i + axis, 2 * i + axis) = std::pow(sd_px[i], -2);
    for (const auto& [bone, length] : limbs) {
      const int a = 2 * index(bone.from), b = 2 * index(bone.to);
      const Vector2d limb =
          frame[bone.to].p_px + moved.segment<2>(b) - frame[bone.from].p_px - moved.segment<2>(a);
      const double now = std::max(limb.norm(), 1e-6),
                   weight = std::pow(kForeshortened * length, -2);
      const Vector2d along = limb / now;
      // Of the length linearised at the present places, as a function of the whole displacement.
      const double wanted = length - now + along.dot(moved.segment<2>(b) - moved.segment<2>(a));
      Places gradient = Places::Zero();
      gradient.segment<2>(a) = -along;
      gradient.segment<2>(b) = along;
      normal += weight * gradient * gradient.transpose();
      right += weight * wanted * gradient;
    }
    moved = normal.ldlt().solve(right);
  }
  return moved;
}

}  // namespace

double leg_px(const Trajectory& points) {
  std::vector<double> legs;
  for (const TrajectoryFrame& frame : points.frames)
    for (const auto& [knee, ankle] : {std::pair(BodyPart::knee_r, BodyPart::ankle_r),
                                      std::pair(BodyPart::knee_l, BodyPart::ankle_l)}) {
      const double leg = (frame[knee].p_px - frame[BodyPart::pelvis].p_px).norm() +
                         (frame[ankle].p_px - frame[knee].p_px).norm();
      if (std::isfinite(leg)) legs.push_back(leg);
    }
  return legs.empty() ? video::body_size_px(points) : median(std::move(legs));
}

int doubt_broken_limbs(Trajectory& points, double standard_deviation_legs) {
  struct Known {
    Bone bone;
    std::vector<Length> lengths;
  };
  std::vector<Known> known;
  for (const Bone& bone : kBones)
    if (is_limb(bone)) known.push_back({bone, lengths_of(points, bone)});
  int broken = 0;
  for (TrajectoryFrame& frame : points.frames) {
    std::vector<Limb> limbs;
    double leg_px = 0;
    for (const auto& [bone, lengths] : known) {
      const std::optional<double> px = usual_px(lengths, frame.time_s);
      if (!px) continue;
      leg_px += *px / 2;  // of both legs
      if (frame[bone.from].present() && frame[bone.to].present()) limbs.push_back({bone, *px});
    }
    if (limbs.empty()) continue;
    std::array<double, kParts> sd_px;
    for (int i = 0; i < kParts; ++i)
      sd_px[i] = standard_deviation_legs * leg_px /
                 std::clamp(frame.points[i].confidence, kLeastConfidence, 1.0);
    const Places moved = needed_px(frame, limbs, sd_px);
    bool is_broken = false;
    for (int i = 0; i < kParts; ++i) {
      Point& point = frame.points[i];
      const double squared = moved.segment<2>(2 * i).squaredNorm() / (2 * sd_px[i] * sd_px[i]);
      is_broken = is_broken || (point.present() && squared > 1);
      point.confidence =
          std::min(point.confidence, std::max(kLeastConfidence, point.confidence / (1 + squared)));
    }
    broken += is_broken;
  }
  return broken;
}

}  // namespace stride::tracking
