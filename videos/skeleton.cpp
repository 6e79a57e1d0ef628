#include "videos/skeleton.h"

#include <cmath>
#include <numbers>

#include "extract/skeleton/units.h"

namespace stride::videos {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMidStance = 0.16, kMidFlight = 0.42;  // phases of a run

/// `length` from hanging straight down, turned forward by `angle`.
Vector3d hanging(double angle, double length) {
  return {length * std::sin(angle), -length * std::cos(angle), 0};
}

/// A point of the foot, `forward` and `up` of the ankle along the sole.
Vector3d on_foot(double angle, double forward, double up) {
  return {forward * std::cos(angle) - up * std::sin(angle),
          forward * std::sin(angle) + up * std::cos(angle), 0};
}

std::array<Vector3d, 2> sole(const Skeleton& skeleton, const Proportions& p, int side) {
  const double angle = skeleton.foot_angle[side];
  return {skeleton.ankle[side] + on_foot(angle, -0.75 * p.heel_back, -p.sole_down),
          skeleton.ankle[side] + on_foot(angle, 0.72 * p.toe_forward, -p.sole_down)};
}

}  // namespace

const Vector3d& Skeleton::operator[](BodyPart part) const {
  switch (part) {
    case BodyPart::pelvis:
      return pelvis;
    case BodyPart::knee_r:
      return knee[0];
    case BodyPart::ankle_r:
      return ankle[0];
    case BodyPart::toe_r:
      return toe[0];
    case BodyPart::hip_r:
      return hip[0];
    case BodyPart::knee_l:
      return knee[1];
    case BodyPart::ankle_l:
      return ankle[1];
    case BodyPart::toe_l:
      return toe[1];
    case BodyPart::hip_l:
      return hip[1];
    case BodyPart::heel_r:
      return heel[0];
    case BodyPart::heel_l:
      return heel[1];
    case BodyPart::head:
      break;
  }
  return head;
}

Skeleton pose(const GaitCurves& gait, const Proportions& p, double phase, double x_m,
              double pelvis_height_m, const Deviation& deviation) {
  Posture posture;
  posture.phase = phase - std::floor(phase);
  posture.pelvis_tilt = kDegree * gait.pelvis_tilt_deg(phase);
  posture.trunk_lean = kDegree * gait.trunk_lean_deg(phase);
  posture.stretch = 1 - gait.squash * std::cos(4 * std::numbers::pi * (phase - kMidStance));
  for (int side : {0, 1}) {
    const double own = phase + 0.5 * side, sign = side == 0 ? 1 : -1;
    posture.hip_flexion[side] = kDegree * gait.hip_flexion_deg(own) + deviation.hip[side];
    posture.knee_angle[side] = kDegree * gait.knee_angle_deg(own) + deviation.knee[side];
    posture.ankle_angle[side] = kDegree * gait.ankle_angle_deg(own) + deviation.ankle[side];
    posture.hip_offset[side] = {sign * gait.hip_swing_m * std::cos(2 * std::numbers::pi * phase),
                                sign * gait.hip_drop_m * std::sin(2 * std::numbers::pi * phase)};
    posture.upper_arm[side] = kDegree * gait.shoulder_deg(own);
    posture.elbow[side] = kDegree * gait.elbow_deg(own);
    posture.shoulder_back_m[side] = gait.shoulder_swing_m * std::cos(2 * std::numbers::pi * own);
  }
  return stand(posture, p, x_m, pelvis_height_m);
}

Skeleton stand(const Posture& posture, const Proportions& p, double x_m, double pelvis_height_m) {
  Skeleton s;
  s.phase = posture.phase;
  s.pelvis = {x_m, pelvis_height_m, 0};
  s.pelvis_tilt = posture.pelvis_tilt;
  s.trunk_lean = posture.trunk_lean;
  s.hip_flexion = posture.hip_flexion;
  s.knee_angle = posture.knee_angle;
  s.ankle_angle = posture.ankle_angle;
  const Vector3d up(std::sin(s.trunk_lean), std::cos(s.trunk_lean), 0);
  s.shoulders = s.pelvis + posture.stretch * p.trunk * up;
  s.head_pitch = 0.3 * s.trunk_lean;
  s.head =
      s.shoulders + p.neck * Vector3d(std::sin(s.trunk_lean + 0.12), std::cos(s.trunk_lean), 0);
  for (int side : {0, 1}) {
    const double sign = side == 0 ? 1 : -1;
    s.thigh_angle[side] = s.pelvis_tilt + s.hip_flexion[side];
    s.shank_angle[side] = s.thigh_angle[side] + s.knee_angle[side];
    s.foot_angle[side] = s.shank_angle[side] + s.ankle_angle[side];
    s.hip[side] = s.pelvis + Vector3d(posture.hip_offset[side].x(), posture.hip_offset[side].y(),
                                      sign * p.hip_half_width);
    s.knee[side] = s.hip[side] + hanging(s.thigh_angle[side], p.thigh);
    s.knee[side].z() = sign * 0.5 * (p.hip_half_width + p.ankle_half_width);
    s.ankle[side] = s.knee[side] + hanging(s.shank_angle[side], p.shank);
    s.ankle[side].z() = sign * p.ankle_half_width;
    s.heel[side] = s.ankle[side] + on_foot(s.foot_angle[side], -p.heel_back, -p.toe_down);
    s.toe[side] = s.ankle[side] + on_foot(s.foot_angle[side], p.toe_forward, -p.toe_down);

    s.upper_arm_angle[side] = posture.upper_arm[side];
    s.forearm_angle[side] = s.upper_arm_angle[side] + posture.elbow[side];
    s.shoulder[side] = s.shoulders - posture.shoulder_back_m[side] * Vector3d(1, 0, 0) - 0.035 * up;
    s.shoulder[side].z() = sign * p.shoulder_half_width;
    s.elbow[side] = s.shoulder[side] + hanging(s.upper_arm_angle[side], p.upper_arm);
    s.wrist[side] = s.elbow[side] + hanging(s.forearm_angle[side], p.forearm);
  }
  return s;
}

double clearance(const Skeleton& skeleton, const Proportions& proportions, int side) {
  const auto points = sole(skeleton, proportions, side);
  return std::min({points[0].y(), points[1].y(), skeleton.toe[side].y() - 0.02});
}

Grounding ground(const GaitCurves& gait, const Proportions& p) {
  constexpr int kSteps = 400;
  Grounding result;
  const auto at = [&](double phase) {
    return pose(gait, p, phase, 0, gait.pelvis_height_m(phase));
  };
  double lowest = 1;
  for (int i = 0; i < kSteps; ++i)
    lowest = std::min(lowest, clearance(at(static_cast<double>(i) / kSteps), p, 0));
  result.mean_height_m = gait.pelvis_height_m.mean - lowest;

  double travelled = 0;
  int count = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double phase = static_cast<double>(i) / kSteps, step = 1.0 / kSteps;
    const Skeleton now = at(phase);
    if (clearance(now, p, 0) > lowest + 0.015 || clearance(now, p, 0) > clearance(now, p, 1))
      continue;
    const auto before = sole(at(phase - step), p, 0), after = sole(at(phase + step), p, 0);
    const auto points = sole(now, p, 0);
    const int standing = points[0].y() < points[1].y() ? 0 : 1;
    travelled -= (after[standing].x() - before[standing].x()) / (2 * step);
    ++count;
  }
  result.speed_m_s = travelled / count / gait.period_s;
  return result;
}

GaitCurves standing(GaitCurves gait, const Proportions& p, double hop_m) {
  constexpr int kSteps = 200, kEven = 4;
  std::vector<double> height(kSteps);
  for (int i = 0; i < kSteps; ++i) {
    const double phase = static_cast<double>(i) / kSteps;
    const Skeleton s = pose(gait, p, phase, 0, 0);
    const double flight = std::max(0.0, std::cos(4 * std::numbers::pi * (phase - kMidFlight)));
    height[i] = -std::min(clearance(s, p, 0), clearance(s, p, 1)) + hop_m * flight * flight;
  }
  // Both steps of a stride are alike: even harmonics only.
  gait.pelvis_height_m = {0, std::vector<Harmonics::Term>(2 * kEven)};
  for (int i = 0; i < kSteps; ++i) {
    const double phase = static_cast<double>(i) / kSteps;
    gait.pelvis_height_m.mean += height[i] / kSteps;
    for (int h = 2; h <= 2 * kEven; h += 2) {
      auto& term = gait.pelvis_height_m.terms[h - 1];
      term.cosine += 2 * height[i] / kSteps * std::cos(2 * std::numbers::pi * h * phase);
      term.sine += 2 * height[i] / kSteps * std::sin(2 * std::numbers::pi * h * phase);
    }
  }
  return gait;
}

}  // namespace stride::videos
