#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "calibrate/osim/model.h"
#include "calibrate/osim/simm_spline.h"
#include "calibrate/runner/calibrated.h"

namespace stride {

template <typename T>
using Vector2 = Eigen::Matrix<T, 2, 1>;

/// A vector turned by `angle`, rad, counter-clockwise (x forward, y up: backward lean positive).
template <typename T, typename V>
Vector2<T> turned(const T& angle, const V& v) {
  using std::cos;
  using std::sin;
  const T c = cos(angle), s = sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// The sagittal geometry of the model, from its right side. Both legs are alike. p_AB is B from A
/// in A's frame, m.
struct SagittalModel {
  struct Range {
    double min = 0, max = 0;  // rad
  };
  struct Sphere {  // of the foot's contact
    Eigen::Vector2d p_talus_m;
    double radius_m = 0;
  };
  std::string name;
  Eigen::Vector2d p_pelvis_hip_m, p_pelvis_head_m;
  osim::SplineCoefficients knee_x_m, knee_y_m;  // p_femur_tibia against the knee angle
  Eigen::Vector2d p_tibia_talus_m, p_talus_toes_m, p_talus_heel_m;  // heel: calcn
  /// Range of motion of a joint: up to the end of the transition of its limit. Without a limit, the
  /// range of the coordinate, which nothing enforces.
  Range hip, knee, ankle;
  std::vector<Sphere> spheres;

  /// Hip to knee and knee to ankle at a straight knee.
  double thigh_m() const;
  double shank_m() const;
};

/// Throws Error if the model is not a planar runner with pelvis, femur, tibia, talus and toes.
SagittalModel sagittal_model(const osim::Model& model);

/// p_PK of a leg: from the pelvis origin, in axes of the ground.
template <typename T>
struct Leg {
  Vector2<T> hip, knee, ankle, toe, heel;
  T foot_angle;  // of the talus' frame
};

/// Where a part of a leg is in the chain: 0 hip, 1 knee, 2 ankle, 3 toe. A heel hangs from the
/// ankle.
inline int joints_below_hip(BodyPart part) {
  switch (part) {
    case BodyPart::pelvis:
    case BodyPart::head:
    case BodyPart::hip_r:
    case BodyPart::hip_l:
      return 0;
    case BodyPart::knee_r:
    case BodyPart::knee_l:
      return 1;
    case BodyPart::ankle_r:
    case BodyPart::ankle_l:
    case BodyPart::heel_r:
    case BodyPart::heel_l:
      return 2;
    case BodyPart::toe_r:
    case BodyPart::toe_l:
      return 3;
  }
  return 0;
}

/// Angles as OpenSim's coordinates, rad.
template <typename T>
Leg<T> place_leg(const SagittalModel& model, const T& tilt, const T& hip, const T& knee,
                 const T& ankle) {
  const T thigh_angle = tilt + hip, shank_angle = thigh_angle + knee;
  Leg<T> leg;
  leg.foot_angle = shank_angle + ankle;
  leg.hip = turned(tilt, model.p_pelvis_hip_m);
  leg.knee = leg.hip + turned(thigh_angle, Vector2<T>(osim::evaluate(model.knee_x_m, knee),
                                                      osim::evaluate(model.knee_y_m, knee)));
  leg.ankle = leg.knee + turned(shank_angle, model.p_tibia_talus_m);
  leg.toe = leg.ankle + turned(leg.foot_angle, model.p_talus_toes_m);
  leg.heel = leg.ankle + turned(leg.foot_angle, model.p_talus_heel_m);
  return leg;
}

/// Sets the points of a sample from its coordinates.
void place_parts(const SagittalModel& model, CalibratedSample& sample);

/// Height of the lowest point of a foot's contact spheres relative to the pelvis origin, m
/// (negative).
double lowest_point(const SagittalModel& model, const Leg<double>& leg);

}  // namespace stride
