#include "calibrate/runner/sagittal_model.h"

#include <algorithm>

#include "extract/io/error.h"
#include "extract/skeleton/units.h"

namespace stride {
namespace {

Eigen::Vector2d flat(const osim::Vec3& p) { return {p[0], p[1]}; }

/// The joint of a body. Its frames must be parallel to those of the bodies.
const osim::Joint& joint_of(const osim::Model& model, const std::string& body) {
  const int child = model.body(body);
  require(child >= 0, "model {}: body '{}' is missing: a runner has it", model.name, body);
  for (const osim::Joint& joint : model.joints) {
    if (joint.child != child) continue;
    const bool plain = joint.orientation_in_parent_rad == osim::Vec3{} &&
                       joint.orientation_in_child_rad == osim::Vec3{} &&
                       joint.location_in_child_m == osim::Vec3{};
    require(plain, "model {}: joint '{}': its frame in the child and its axes must be the body's",
            model.name, joint.name);
    return joint;
  }
  throw Error(fmt::format("model {}: body '{}' has no joint", model.name, body));
}

SagittalModel::Range range(const osim::Model& model, const char* name) {
  const int index = model.coordinate(name);
  require(index >= 0, "model {}: coordinate '{}' is missing: a runner has it", model.name, name);
  const osim::Coordinate& coordinate = model.coordinates[index];
  for (const osim::CoordinateLimit& limit : model.limits)
    if (limit.coordinate == index)
      return {kDegree * (limit.lower_limit - limit.transition),
              kDegree * (limit.upper_limit + limit.transition)};
  return {coordinate.range_min, coordinate.range_max};
}

/// The axis of a knee's translation: 0 x, 1 y.
osim::SplineCoefficients knee_translation(const osim::Model& model, const osim::Joint& knee,
                                          int axis) {
  require(knee.type == osim::Joint::Type::custom, "model {}: joint '{}' must be a CustomJoint",
          model.name, knee.name);
  const osim::TransformAxis& transform = knee.transform[3 + axis];
  switch (transform.kind) {
    case osim::TransformAxis::Kind::spline:
      return osim::spline_coefficients(transform.spline);
    case osim::TransformAxis::Kind::constant:
      return osim::spline_coefficients({{0}, {transform.constant}});
    case osim::TransformAxis::Kind::linear:
      break;
  }
  throw Error(fmt::format("model {}: joint '{}': translation must be a spline or a constant",
                          model.name, knee.name));
}

Eigen::Vector2d head_from_pelvis(const osim::Model& model) {
  const osim::Joint& back = joint_of(model, "torso");
  double angle = 0;
  if (!back.coordinates.empty()) angle = model.coordinates[back.coordinates[0]].default_value;
  return flat(back.location_in_parent_m) +
         turned(angle, flat(joint_of(model, "head").location_in_parent_m));
}

}  // namespace

double SagittalModel::thigh_m() const {
  return std::hypot(osim::evaluate(knee_x_m, 0.0), osim::evaluate(knee_y_m, 0.0));
}

double SagittalModel::shank_m() const { return p_tibia_talus_m.norm(); }

SagittalModel sagittal_model(const osim::Model& model) {
  const osim::Joint& knee = joint_of(model, "tibia_r");
  SagittalModel result;
  result.name = model.name;
  result.p_pelvis_hip_m = flat(joint_of(model, "femur_r").location_in_parent_m);
  result.p_pelvis_head_m = head_from_pelvis(model);
  result.knee_x_m = knee_translation(model, knee, 0);
  result.knee_y_m = knee_translation(model, knee, 1);
  result.p_tibia_talus_m = flat(joint_of(model, "talus_r").location_in_parent_m);
  result.p_talus_heel_m = flat(joint_of(model, "calcn_r").location_in_parent_m);
  result.p_talus_toes_m =
      result.p_talus_heel_m + flat(joint_of(model, "toes_r").location_in_parent_m);
  result.hip = range(model, "hip_flexion_r");
  result.knee = range(model, "knee_angle_r");
  result.ankle = range(model, "ankle_angle_r");
  for (const osim::ContactSphere& sphere : model.spheres) {
    if (sphere.body == model.body("calcn_r"))
      result.spheres.push_back({result.p_talus_heel_m + flat(sphere.location_m), sphere.radius_m});
    if (sphere.body == model.body("toes_r"))
      result.spheres.push_back({result.p_talus_toes_m + flat(sphere.location_m), sphere.radius_m});
  }
  require(!result.spheres.empty(),
          "model {}: no contact sphere on calcn_r or toes_r: a runner "
          "stands on them",
          model.name);
  return result;
}

void place_parts(const SagittalModel& model, CalibratedSample& sample) {
  const auto& q = sample.coordinates;
  const auto right = place_leg(model, q[0], q[3], q[4], q[5]);
  const auto left = place_leg(model, q[0], q[6], q[7], q[8]);
  const auto place = [&](BodyPart part) -> Eigen::Vector2d {
    switch (part) {
      case BodyPart::pelvis:
        return Eigen::Vector2d::Zero();
      case BodyPart::knee_r:
        return right.knee;
      case BodyPart::ankle_r:
        return right.ankle;
      case BodyPart::toe_r:
        return right.toe;
      case BodyPart::hip_r:
        return right.hip;
      case BodyPart::knee_l:
        return left.knee;
      case BodyPart::ankle_l:
        return left.ankle;
      case BodyPart::toe_l:
        return left.toe;
      case BodyPart::hip_l:
        return left.hip;
      case BodyPart::heel_r:
        return right.heel;
      case BodyPart::heel_l:
        return left.heel;
      case BodyPart::head:
        break;
    }
    return turned(q[0], model.p_pelvis_head_m);
  };
  for (const BodyPart part : kBodyParts) sample.p_m[index(part)] = place(part);
}

double lowest_point(const SagittalModel& model, const Leg<double>& leg) {
  double lowest = leg.ankle.y();
  for (const SagittalModel::Sphere& sphere : model.spheres) {
    const Eigen::Vector2d center = leg.ankle + turned(leg.foot_angle, sphere.p_talus_m);
    lowest = std::min(lowest, center.y() - sphere.radius_m);
  }
  return lowest;
}

}  // namespace stride
