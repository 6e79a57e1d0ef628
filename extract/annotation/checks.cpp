#include "extract/annotation/checks.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "extract/io/statistics.h"
#include "extract/skeleton/least_squares.h"
#include "extract/tracking/corrections.h"

namespace stride::annotation {
namespace {

constexpr double kBand = 0.12;

double length_px(const ClickedFrame& frame, BodyPart from, BodyPart to) {
  if (!frame.placed(from) || !frame.placed(to)) return 0;
  return (frame[from]->p_px - frame[to]->p_px).norm();
}

/// Stance positions of a foot: its lowest points, at least a third of a stride apart.
void add_stances(const Trajectory& trajectory, BodyPart part, double stride_frames,
                 std::vector<Eigen::Vector2d>& spots) {
  for (const TrajectoryFrame& candidate : trajectory.frames) {
    if (!candidate[part].present()) continue;
    const bool lowest = std::ranges::none_of(trajectory.frames, [&](const TrajectoryFrame& f) {
      return std::abs(f.frame - candidate.frame) < stride_frames / 3 && f[part].present() &&
             f[part].p_px.y() > candidate[part].p_px.y();
    });
    const bool inside = candidate.frame - trajectory.frames.front().frame > stride_frames / 6 &&
                        trajectory.frames.back().frame - candidate.frame > stride_frames / 6;
    if (lowest && inside) spots.push_back(candidate[part].p_px);
  }
}

}  // namespace

std::vector<BoneWarning> bone_warnings(const Keypoints& keypoints, int number) {
  const auto frame = keypoints.frames.find(number);
  std::vector<BoneWarning> warnings;
  if (frame == keypoints.frames.end()) return warnings;
  for (const auto& [from, to] : kBones) {
    const double here = length_px(frame->second, from, to);
    if (here == 0) continue;
    std::vector<double> lengths;
    for (const auto& [other, clicked] : keypoints.frames)
      for (const auto& [a, b] : {std::pair(from, to), std::pair(mirrored(from), mirrored(to))})
        if (const double length = length_px(clicked, a, b); length > 0) lengths.push_back(length);
    if (lengths.size() < 4) continue;
    const double usual = median(lengths);
    if (std::abs(here / usual - 1) > kBand) warnings.push_back({from, to, here, usual});
  }
  return warnings;
}

std::optional<int> worst_frame(const Trajectory& prediction, const Keypoints& keypoints,
                               const std::vector<BodyPart>& parts,
                               const std::vector<int>& passed_by) {
  std::optional<int> worst;
  double least = 1;
  for (const TrajectoryFrame& frame : prediction.frames) {
    const auto near = keypoints.frames.lower_bound(frame.frame - 2);
    if (near != keypoints.frames.end() && near->first <= frame.frame + 2) continue;
    if (std::ranges::find(passed_by, frame.frame) != passed_by.end()) continue;
    double sum = 0, worst_part = 1;
    for (const BodyPart part : parts) {
      sum += frame[part].confidence;
      worst_part = std::min(worst_part, frame[part].confidence);
    }
    const double mean = sum / static_cast<double>(parts.size());
    if (worst_part <= kPredictedConfidence && mean < least) {
      least = mean;
      worst = frame.frame;
    }
  }
  return worst;
}

std::optional<WorstPoint> worst_point(const Trajectory& prediction, const Keypoints& keypoints,
                                      const std::vector<BodyPart>& parts,
                                      const std::vector<WorstPoint>& passed_by) {
  constexpr int kNear = 3;  // frames over which a correction reaches
  constexpr double kGaitTakesOver_legs =
      0.06;  // noise at which tracking leaves a point to the gait
  // A potential has knees, ankles and pelvis.
  const auto share = [](BodyPart part) { return row(part).required ? 1.0 : 0.05; };
  const auto clicks_on = [&](BodyPart part) {  // either side
    int clicks = 0;
    for (const auto& [number, frame] : keypoints.frames)
      clicks += frame.placed(part) + (mirrored(part) != part && frame.placed(mirrored(part)));
    return clicks;
  };
  const auto is_done = [&](int number, BodyPart part) {
    const auto& frames = keypoints.frames;
    for (auto f = frames.lower_bound(number - kNear);
         f != frames.end() && f->first <= number + kNear; ++f)
      if (f->second[part]) return true;
    return std::ranges::any_of(passed_by, [&](const WorstPoint& p) {
      return p.part == part && std::abs(p.frame - number) <= kNear;
    });
  };
  std::optional<WorstPoint> worst;
  double greatest = 0;
  for (const BodyPart part : parts) {
    // What the clicks so far have left of the detector's own idea of the joint, on every frame.
    const double idea = std::pow(tracking::convention(part).along_legs, 2);
    const double points =
        static_cast<double>(prediction.frames.size()) * (1 + (mirrored(part) != part));
    const int clicks = clicks_on(part);
    for (const TrajectoryFrame& frame : prediction.frames) {
      if (!frame[part].present()) continue;
      const double own = tracking::detected_noise_legs(frame[part].confidence);
      const double unsure = own * own + tracking::kHand_legs * tracking::kHand_legs;
      const auto left = [&](int n) { return idea / (1 + n * idea / unsure); };
      const double expected =
          share(part) * (own * own / (1 + std::pow(own / kGaitTakesOver_legs, 2)) +
                         points * (left(clicks) - left(clicks + 1)));
      if (expected <= greatest || is_done(frame.frame, part)) continue;
      greatest = expected;
      worst = WorstPoint{frame.frame, part};
    }
  }
  return worst;
}

std::optional<double> clicked_leg_px(const Keypoints& keypoints) {
  std::vector<double> legs_px;
  for (const auto& [number, frame] : keypoints.frames)
    for (const auto& [knee, ankle] : {std::pair{BodyPart::knee_r, BodyPart::ankle_r},
                                      std::pair{BodyPart::knee_l, BodyPart::ankle_l}}) {
      const double thigh = length_px(frame, BodyPart::pelvis, knee),
                   shank = length_px(frame, knee, ankle);
      if (thigh > 0 && shank > 0) legs_px.push_back(thigh + shank);
    }
  if (legs_px.empty()) return std::nullopt;
  return median(legs_px);
}

std::optional<FloorLine> floor_from_feet(const Trajectory& trajectory, double stride_frames) {
  if (trajectory.frames.empty() || stride_frames <= 0) return std::nullopt;
  std::vector<Eigen::Vector2d> spots;
  for (const auto& [toe, ankle] : {std::pair(BodyPart::toe_r, BodyPart::ankle_r),
                                   std::pair(BodyPart::toe_l, BodyPart::ankle_l)}) {
    const bool has_toes = std::ranges::any_of(
        trajectory.frames, [toe = toe](const TrajectoryFrame& f) { return f[toe].present(); });
    add_stances(trajectory, has_toes ? toe : ankle, stride_frames, spots);
  }
  if (spots.size() < 2) return std::nullopt;
  Eigen::MatrixXd a(spots.size(), 2), y(spots.size(), 1);
  for (std::size_t i = 0; i < spots.size(); ++i) {
    a.row(static_cast<Eigen::Index>(i)) << 1, spots[i].x();
    y(static_cast<Eigen::Index>(i), 0) = spots[i].y();
  }
  const double left = a.col(1).minCoeff(), right = a.col(1).maxCoeff();
  if (right - left < 0.1 * trajectory.width_px) return std::nullopt;
  const Eigen::Vector2d line = least_squares(a, y);
  return FloorLine{{left, line[0] + line[1] * left}, {right, line[0] + line[1] * right}};
}

}  // namespace stride::annotation
