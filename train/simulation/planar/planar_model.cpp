#include "train/simulation/planar/planar_model.h"

#include <algorithm>
#include <cmath>

#include "extract/io/error.h"
#include "train/simulation/engine/runner_layout.h"
#include "train/simulation/laws/muscle.h"
#include "train/simulation/planar/paths.h"

namespace stride::planar {
namespace {

using simd::V2;
using simd::V4;

/// Throws Error with the reason for refusing the model.
template <typename... Args>
void need(bool condition, const osim::Model& model, fmt::format_string<Args...> reason,
          Args&&... args) {
  require(condition, "model {}: the planar engine cannot represent it: {}; use --engine simbody",
          model.name, condition ? std::string() : fmt::format(reason, std::forward<Args>(args)...));
}

class Builder {
 public:
  explicit Builder(const osim::Model& model)
      : model_(model), layout_(simulation::runner_layout(model)) {
    planar_.bodies.resize(model_.bodies.size());
    for (auto& joint : joint_coordinate_) joint = {-1, -1};
  }

  PlanarModel build() {
    for (const osim::Joint& joint : model_.joints) place_child(joint);
    need(legs_ == PlanarModel::kLegs, model_, "it has {} legs, not two", legs_);
    for (int joint = 0; joint < PlanarModel::kJoints; ++joint) {
      for (int leg = 0; leg < PlanarModel::kLegs; ++leg) {
        need(joint_coordinate_[joint][leg] >= 0, model_, "a leg has fewer than three joints");
      }
    }
    sum_masses();
    set_contacts();
    set_limits();
    set_muscles();
    build_planar_paths(model_, layout_, joint_coordinate_, knee_x_, knee_y_, planar_);
    planar_.gravity_x = model_.gravity_m_s2[0];
    planar_.gravity_y = model_.gravity_m_s2[1];
    need(model_.gravity_m_s2[2] == 0, model_, "gravity has a component along z");
    return planar_;
  }

 private:
  /// Index in the engine's order of Model::coordinates[c]; -1 if it is locked.
  int engine_index(int c) const {
    const auto at = std::find(layout_.coordinate.begin(), layout_.coordinate.end(), c);
    return at == layout_.coordinate.end() ? -1 : static_cast<int>(at - layout_.coordinate.begin());
  }

  /// Stores the interleaved index of the coordinate Model::coordinates[c].
  void assign(int c, int interleaved) {
    const int index = engine_index(c);
    need(index >= 0, model_, "coordinate {} is locked where a joint must move",
         model_.coordinates[c].name);
    planar_.coordinate[index] = interleaved;
  }

  void place_child(const osim::Joint& joint) {
    for (const osim::Vec3& v : {joint.orientation_in_parent_rad, joint.orientation_in_child_rad}) {
      need(v == osim::Vec3{}, model_, "joint {} is turned against its bodies", joint.name);
    }
    if (joint.type == osim::Joint::Type::planar) return place_root(joint);
    need(joint.parent >= 0, model_, "joint {} to the ground is not planar", joint.name);
    const PlanarModel::Place parent = planar_.bodies[joint.parent];
    PlanarModel::Place at = offset(parent, joint.location_in_parent_m);
    const bool fixed =
        joint.type == osim::Joint::Type::weld ||
        (joint.type == osim::Joint::Type::pin && model_.coordinates[joint.coordinates[0]].locked);
    if (joint.type == osim::Joint::Type::pin && fixed) {
      at.angle_rad += model_.coordinates[joint.coordinates[0]].default_value;
    }
    if (!fixed) at = next_segment(joint, at);
    osim::Vec3 back = joint.location_in_child_m;
    for (double& x : back) x = -x;
    planar_.bodies[joint.child] = offset(at, back);
  }

  void place_root(const osim::Joint& joint) {
    need(joint.parent < 0 && joint.location_in_parent_m == osim::Vec3{} &&
             joint.location_in_child_m == osim::Vec3{},
         model_, "planar joint {} does not carry the origin of a body on that of the ground",
         joint.name);
    for (int i = 0; i < 3; ++i) assign(joint.coordinates[i], 6 + i);
    planar_.bodies[joint.child] = {};
  }

  static PlanarModel::Place offset(PlanarModel::Place place, const osim::Vec3& v) {
    const double c = std::cos(place.angle_rad), s = std::sin(place.angle_rad);
    place.x_m += c * v[0] - s * v[1];
    place.y_m += s * v[0] + c * v[1];
    place.z_m += v[2];
    return place;
  }

  /// The frame of the segment that `joint` starts; its origin is the joint's in the child.
  PlanarModel::Place next_segment(const osim::Joint& joint, const PlanarModel::Place& at) {
    need(at.angle_rad == 0, model_, "joint {} hangs on a body turned against its segment",
         joint.name);
    PlanarModel::Place child = {at.leg, at.segment + 1, 0, 0, 0, at.z_m};
    if (at.segment == 0) child.leg = legs_++;
    need(child.leg < PlanarModel::kLegs, model_, "it has more than two legs: joint {}", joint.name);
    need(child.segment < PlanarModel::kSegments, model_, "joint {} is the fourth of its leg",
         joint.name);
    const int number = child.segment - 1, leg = child.leg;
    need(joint_coordinate_[number][leg] < 0, model_, "joint {} makes its leg branch", joint.name);
    joint_coordinate_[number][leg] = joint.coordinates[0];
    assign(joint.coordinates[0], 2 * number + leg);
    if (number == 0) planar_.hip_x_m[leg] = at.x_m, planar_.hip_y_m[leg] = at.y_m;
    if (number == 2) planar_.ankle_x_m[leg] = at.x_m, planar_.ankle_y_m[leg] = at.y_m;
    if (number == 1) {
      knee_x_[leg] = translation(joint, 0, at.x_m);
      knee_y_[leg] = translation(joint, 1, at.y_m);
    } else {
      need(joint.type == osim::Joint::Type::pin, model_, "joint {} is neither a pin nor the knee",
           joint.name);
    }
    if (joint.type == osim::Joint::Type::custom) child.z_m += check_knee(joint);
    return child;
  }

  /// Its rotation is the coordinate itself, about z; returns its constant translation along z.
  double check_knee(const osim::Joint& joint) const {
    const osim::TransformAxis& turn = joint.transform[0];
    need(turn.kind == osim::TransformAxis::Kind::linear && turn.slope == 1 && turn.intercept == 0 &&
             turn.axis == osim::Vec3{0, 0, 1} && turn.coordinate == joint.coordinates[0],
         model_, "joint {} does not turn about z by its coordinate", joint.name);
    for (int i : {1, 2, 5}) {
      const osim::TransformAxis& axis = joint.transform[i];
      need(axis.kind == osim::TransformAxis::Kind::constant && (i == 5 || axis.constant == 0),
           model_, "joint {} moves out of the sagittal plane", joint.name);
    }
    return joint.transform[5].constant * joint.transform[5].axis[2];
  }

  /// Location of the hinge along x or y of the thigh as a function of the knee angle.
  osim::SplineCoefficients translation(const osim::Joint& joint, int i, double location) const {
    osim::SplineCoefficients f{{0}, {location}, {0}, {0}, {0}};
    if (joint.type == osim::Joint::Type::pin) return f;
    need(joint.type == osim::Joint::Type::custom, model_, "knee {} is neither pin nor custom joint",
         joint.name);
    const osim::TransformAxis& axis = joint.transform[3 + i];
    osim::Vec3 along{};
    along[i] = 1;
    need(axis.axis == along, model_, "joint {} does not move along x and y", joint.name);
    need(
        axis.kind == osim::TransformAxis::Kind::constant || axis.coordinate == joint.coordinates[0],
        model_, "joint {} moves with another coordinate than its own", joint.name);
    if (axis.kind == osim::TransformAxis::Kind::spline) {
      f = osim::spline_coefficients(axis.spline);
      for (double& y : f.y) y += location;
    } else if (axis.kind == osim::TransformAxis::Kind::linear) {
      f.y[0] += axis.intercept;
      f.b[0] = axis.slope;
    } else {
      f.y[0] += axis.constant;
    }
    return f;
  }

  void sum_masses() {
    // First mass and centre, then the moments about it (Steiner).
    for (const bool second : {false, true}) {
      for (std::size_t b = 0; b < model_.bodies.size(); ++b) {
        const osim::Body& body = model_.bodies[b];
        const PlanarModel::Place c = offset(planar_.bodies[b], body.mass_center_m);
        for (int leg = 0; leg < PlanarModel::kLegs; ++leg) {
          if (c.leg >= 0 && c.leg != leg) continue;  // both lanes of segment 0 hold the base
          const int s = c.segment;
          if (second) {
            const double dx = c.x_m - planar_.center_x_m[s][leg];
            const double dy = c.y_m - planar_.center_y_m[s][leg];
            planar_.inertia_kg_m2[s][leg] += body.inertia[2] + body.mass_kg * (dx * dx + dy * dy);
          } else {
            const double m = planar_.mass_kg[s][leg] += body.mass_kg;
            const double share = m > 0 ? body.mass_kg / m : 0;
            planar_.center_x_m[s][leg] += share * (c.x_m - planar_.center_x_m[s][leg]);
            planar_.center_y_m[s][leg] += share * (c.y_m - planar_.center_y_m[s][leg]);
          }
        }
        if (second) planar_.total_mass_kg += body.mass_kg;
      }
    }
  }

  void set_contacts() {
    if (model_.contacts.empty()) return;
    planar_.contact = laws::contact_law(model_.contacts[0]);
    planar_.sphere_radius_m = simd::all(0.01);
    planar_.sphere_y_m = simd::all(1e6);  // a missing second sphere never touches
    for (std::size_t n = 0; n < model_.contacts.size(); ++n) {
      const osim::ContactForce& force = model_.contacts[n];
      const laws::ContactLaw law = laws::contact_law(force);
      need(law.plane_strain_modulus == planar_.contact.plane_strain_modulus &&
               law.dissipation == planar_.contact.dissipation &&
               law.static_friction == planar_.contact.static_friction &&
               law.dynamic_friction == planar_.contact.dynamic_friction &&
               law.viscous_friction == planar_.contact.viscous_friction &&
               law.transition_velocity_m_s == planar_.contact.transition_velocity_m_s,
           model_, "contact {} is of another material", force.name);
      need(!force.spheres.empty() && force.spheres.size() <= 2 && force.plane >= 0, model_,
           "contact {} is not between a plane and one or two spheres", force.name);
      const double height = model_.planes[force.plane].height_m;
      need(n == 0 || height == planar_.ground_height_m, model_, "it has grounds of two heights");
      planar_.ground_height_m = height;
      int lane = 0;
      for (const int s : force.spheres) {
        const osim::ContactSphere& sphere = model_.spheres[s];
        const PlanarModel::Place at = offset(planar_.bodies[sphere.body], sphere.location_m);
        need(at.segment == 3, model_, "contact sphere {} is not on a foot", sphere.name);
        int& contact = planar_.contact_of_leg[at.leg];
        need(contact < 0 || contact == static_cast<int>(n), model_,
             "contact {} is the second of its foot", force.name);
        contact = static_cast<int>(n);
        const int i = 2 * lane++ + at.leg;
        planar_.sphere_x_m[i] = at.x_m;
        planar_.sphere_y_m[i] = at.y_m;
        planar_.sphere_z_m[i] = at.z_m;
        planar_.sphere_radius_m[i] = sphere.radius_m;
      }
      planar_.spheres_of_foot = std::max(planar_.spheres_of_foot, lane);
    }
  }

  void set_limits() {
    for (const osim::CoordinateLimit& limit : model_.limits) {
      const int index = engine_index(limit.coordinate);
      if (index < 0) continue;  // of a locked coordinate
      need(planar_.coordinate[index] < 6, model_, "limit {} is not on a joint of a leg",
           limit.name);
      planar_.limits.push_back(
          {planar_.coordinate[index],
           laws::limit_law(limit, model_.coordinates[limit.coordinate].rotational)});
    }
  }

  void set_muscles() {
    for (int g = 0; g < PlanarModel::kMuscleGroups; ++g) {
      for (int lane = 0; lane < 4; ++lane) {
        const int i = std::min(4 * g + lane, PlanarModel::kMuscles - 1);  // interleaved
        set_muscle(laws::MuscleLaw(
                       model_.muscles[layout_.muscle[i / 2 + i % 2 * PlanarModel::kMusclesOfLeg]]),
                   planar_.muscles[g], lane);
      }
    }
  }

  static void set_muscle(const laws::MuscleLaw& m, PlanarModel::Muscles& to, int i) {
    to.max_force[i] = m.max_force_N;
    to.optimal_inverse[i] = 1 / m.optimal_length_m;
    to.slack_inverse[i] = 1 / m.tendon_slack_m;
    to.max_speed[i] = m.max_speed_m_s;
    to.width2[i] = m.width_m * m.width_m;
    to.minimum_length[i] = m.minimum_length_m;
    to.cos_max_pennation[i] = m.cos_max_pennation;
    to.minimum_activation[i] = m.minimum_activation;
    to.tau_activation_inverse[i] = 1 / m.tau_activation_s;
    to.tau_deactivation_inverse[i] = 1 / m.tau_deactivation_s;
    to.active_shape_inverse[i] = 1 / m.active_shape;
    to.passive_rate[i] = m.passive_rate;
    to.passive_scale[i] = m.passive_scale;
    to.toe_strain[i] = m.toe_strain;
    to.toe_rate[i] = m.toe_rate;
    to.toe_scale[i] = m.toe_scale;
    to.linear_stiffness[i] = m.linear_stiffness;
    to.af_inverse[i] = 1 / m.af;
    to.flen[i] = m.flen;
    to.straight_from[i] = m.linear_from * m.flen;
    to.lengthening[i] = (2 + 2 * to.af_inverse[i]) / (1 - m.flen);
  }

  const osim::Model& model_;
  simulation::RunnerLayout layout_;
  PlanarModel planar_;
  int legs_ = 0;
  JointCoordinates joint_coordinate_;
  std::array<osim::SplineCoefficients, 2> knee_x_, knee_y_;
};

}  // namespace

PlanarModel planar_model(const osim::Model& model) { return Builder(model).build(); }

}  // namespace stride::planar
