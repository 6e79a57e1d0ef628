#include "train/simulation/simbody/simbody_skeleton.h"

#include <algorithm>
#include <cmath>

#include "extract/io/error.h"

namespace stride::simbody {
namespace {

SimTK::Vec3 vec(const osim::Vec3& v) { return {v[0], v[1], v[2]}; }

/// A frame on a body; only turned about z.
SimTK::Transform frame(const osim::Joint& joint, const osim::Vec3& location,
                       const osim::Vec3& orientation) {
  require(orientation[0] == 0 && orientation[1] == 0,
          "joint {}: its frame is turned out of the sagittal plane, which no engine can represent",
          joint.name);
  return {SimTK::Rotation(orientation[2], SimTK::ZAxis), vec(location)};
}

SimTK::Transform frame_in_parent(const osim::Joint& joint) {
  return frame(joint, joint.location_in_parent_m, joint.orientation_in_parent_rad);
}

SimTK::Transform frame_in_child(const osim::Joint& joint) {
  return frame(joint, joint.location_in_child_m, joint.orientation_in_child_rad);
}

SimTK::MassProperties mass_properties(const osim::Body& body) {
  const auto& i = body.inertia;
  const SimTK::Inertia central(i[0], i[1], i[2], i[3], i[4], i[5]);
  const SimTK::Vec3 com = vec(body.mass_center_m);
  return {body.mass_kg, com, central.shiftFromMassCenter(com, body.mass_kg)};
}

SimTK::MassProperties together(const SimTK::MassProperties& a, const SimTK::MassProperties& b) {
  const double mass = a.getMass() + b.getMass();
  const SimTK::Vec3 com =
      mass > 0 ? (a.getMass() * a.getMassCenter() + b.getMass() * b.getMassCenter()) / mass
               : SimTK::Vec3(0);
  return {mass, com, SimTK::Inertia(a.calcInertia() + b.calcInertia())};
}

/// A joint of one coordinate as Simbody's mobilizer.
class PlanarMobilizer : public SimTK::MobilizedBody::Custom::Implementation {
 public:
  PlanarMobilizer(SimTK::SimbodyMatterSubsystem& matter, const PlanarMotion& motion, int slot)
      : Implementation(matter, 1, 1, 0), motion_(motion), slot_(slot) {}

  Implementation* clone() const override { return new PlanarMobilizer(*this); }

  SimTK::Transform calcMobilizerTransformFromQ(const SimTK::State&, int,
                                               const SimTK::Real* q) const override {
    const PlanarMotion::At at = motion_.at(q[0]);
    return {SimTK::Rotation(at.angle.value, SimTK::ZAxis), SimTK::Vec3(at.x.value, at.y.value, 0)};
  }
  SimTK::SpatialVec multiplyByHMatrix(const SimTK::State& s, int,
                                      const SimTK::Real* u) const override {
    return u[0] * h(s);
  }
  void multiplyByHTranspose(const SimTK::State& s, const SimTK::SpatialVec& force, int,
                            SimTK::Real* f) const override {
    f[0] = ~h(s) * force;
  }
  SimTK::SpatialVec multiplyByHDotMatrix(const SimTK::State& s, int,
                                         const SimTK::Real* u) const override {
    return u[0] * h_dot(s);
  }
  void multiplyByHDotTranspose(const SimTK::State& s, const SimTK::SpatialVec& force, int,
                               SimTK::Real* f) const override {
    f[0] = ~h_dot(s) * force;
  }

 private:
  SimTK::SpatialVec h(const SimTK::State& s) const {
    const PlanarMotion::At at = motion_.at(s.getQ()[slot_]);
    return {SimTK::Vec3(0, 0, at.angle.first), SimTK::Vec3(at.x.first, at.y.first, 0)};
  }
  SimTK::SpatialVec h_dot(const SimTK::State& s) const {
    const PlanarMotion::At at = motion_.at(s.getQ()[slot_]);
    return s.getU()[slot_] * SimTK::SpatialVec(SimTK::Vec3(0, 0, at.angle.second),
                                               SimTK::Vec3(at.x.second, at.y.second, 0));
  }

  PlanarMotion motion_;
  int slot_;
};

bool stands_still(const osim::Model& model, const osim::Joint& joint) {
  return std::all_of(joint.coordinates.begin(), joint.coordinates.end(),
                     [&](int i) { return model.coordinates[i].locked; });
}

/// X_FM of a joint whose coordinates have their default values.
SimTK::Transform default_transform(const osim::Model& model, const osim::Joint& joint) {
  const auto q = [&](int i) { return model.coordinates[joint.coordinates[i]].default_value; };
  switch (joint.type) {
    case osim::Joint::Type::weld:
      return {};
    case osim::Joint::Type::pin:
      return {SimTK::Rotation(q(0), SimTK::ZAxis), SimTK::Vec3(0)};
    case osim::Joint::Type::planar:
      return {SimTK::Rotation(q(0), SimTK::ZAxis), SimTK::Vec3(q(1), q(2), 0)};
    case osim::Joint::Type::custom:
      break;
  }
  const PlanarMotion::At at = PlanarMotion(model, joint).at(q(0));
  return {SimTK::Rotation(at.angle.value, SimTK::ZAxis), SimTK::Vec3(at.x.value, at.y.value, 0)};
}

}  // namespace

PlanarMotion::PlanarMotion(const osim::Model& model, const osim::Joint& joint) {
  require(joint.coordinates.size() == 1,
          "joint {}: has {} coordinates; engines understand custom joints of one", joint.name,
          joint.coordinates.size());
  for (int i = 0; i < 6; ++i) {
    const osim::TransformAxis& axis = joint.transform[i];
    const bool nothing = axis.kind == osim::TransformAxis::Kind::constant && axis.constant == 0;
    if (nothing) continue;
    Part part;
    part.axis = axis;
    if (axis.kind == osim::TransformAxis::Kind::spline)
      part.spline = osim::spline_coefficients(axis.spline);
    const osim::Vec3& a = axis.axis;
    const double length = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    const bool in_plane = i < 3 ? a[0] == 0 && a[1] == 0 : a[2] == 0;
    require(in_plane && length > 0,
            "joint {}: coordinate {} moves it out of the sagittal plane, which no engine can "
            "represent",
            joint.name, model.coordinates[joint.coordinates[0]].name);
    part.direction =
        i < 3 ? osim::Vec3{a[2] / length, 0, 0} : osim::Vec3{0, a[0] / length, a[1] / length};
    parts_.push_back(part);
  }
}

PlanarMotion::At PlanarMotion::at(double q) const {
  At at;
  for (const Part& part : parts_) {
    osim::SplineValue f;
    if (part.axis.kind == osim::TransformAxis::Kind::constant) f.value = part.axis.constant;
    if (part.axis.kind == osim::TransformAxis::Kind::linear)
      f = {part.axis.slope * q + part.axis.intercept, part.axis.slope, 0};
    if (part.axis.kind == osim::TransformAxis::Kind::spline)
      f = osim::evaluate_with_derivatives(part.spline, q);
    osim::SplineValue* sums[] = {&at.angle, &at.x, &at.y};
    for (int i = 0; i < 3; ++i) {
      sums[i]->value += part.direction[i] * f.value;
      sums[i]->first += part.direction[i] * f.first;
      sums[i]->second += part.direction[i] * f.second;
    }
  }
  return at;
}

SimbodySkeleton::SimbodySkeleton(const osim::Model& model, const simulation::RunnerLayout& layout)
    : matter(system), bodies(model.bodies.size()) {
  // Bodies that do not move on their parent join the parent's leader; a body fixed to the ground is
  // its own leader.
  const std::size_t n = model.bodies.size();
  std::vector<SimTK::Transform> in_leader(n);
  std::vector<SimTK::MassProperties> mass(n, {0, SimTK::Vec3(0), SimTK::Inertia(0)});
  for (const osim::Joint& joint : model.joints) {
    int leader = joint.child;
    if (stands_still(model, joint) && joint.parent >= 0) {
      leader = bodies[joint.parent].leader < 0 ? joint.parent : bodies[joint.parent].leader;
      const SimTK::Transform x = in_leader[joint.parent] * frame_in_parent(joint) *
                                 default_transform(model, joint) * ~frame_in_child(joint);
      in_leader[joint.child] = x;
      bodies[joint.child] = {{}, leader, x.p()[0], x.p()[1], x.p()[2], x.R()[0][0], x.R()[1][0]};
    }
    mass[leader] = together(mass[leader], mass_properties(model.bodies[joint.child])
                                              .calcTransformedMassProps(~in_leader[joint.child]));
  }
  for (const osim::Joint& joint : model.joints)
    if (bodies[joint.child].leader < 0)
      mobilize(model, joint, joint.parent < 0 ? SimTK::Transform() : in_leader[joint.parent],
               mass[joint.child]);
    else
      bodies[joint.child].root = bodies[bodies[joint.child].leader].root;
  state = system.realizeTopology();
  system.realizeModel(state);
  int free = 0;
  for (const osim::Joint& joint : model.joints)
    for (int coordinate : joint.coordinates) {
      const auto at = std::find(layout.coordinate.begin(), layout.coordinate.end(), coordinate);
      if (at != layout.coordinate.end()) slot[at - layout.coordinate.begin()] = free++;
    }
}

void SimbodySkeleton::mobilize(const osim::Model& model, const osim::Joint& joint,
                               const SimTK::Transform& parent_in_root,
                               const SimTK::MassProperties& mass) {
  const SimTK::MobilizedBodyIndex parent =
      joint.parent < 0 ? SimTK::MobilizedBodyIndex(0) : bodies[joint.parent].root;
  SimTK::MobilizedBody& on = matter.updMobilizedBody(parent);
  const SimTK::Transform inboard = parent_in_root * frame_in_parent(joint);
  const SimTK::Transform outboard = frame_in_child(joint);
  const SimTK::Body::Rigid body(mass);
  const auto made = [&]() -> SimTK::MobilizedBody {
    if (stands_still(model, joint)) return SimTK::MobilizedBody::Weld(on, inboard, body, outboard);
    for (int coordinate : joint.coordinates)
      require(!model.coordinates[coordinate].locked,
              "joint {}: some of its coordinates are locked and others are not; lock all or none",
              joint.name);
    if (joint.type == osim::Joint::Type::planar)
      return SimTK::MobilizedBody::Planar(on, inboard, body, outboard);
    if (joint.type == osim::Joint::Type::pin)
      return SimTK::MobilizedBody::Pin(on, inboard, body, outboard);
    // Slots are given out in the order of mobilized bodies.
    int slot_of_this = 0;
    for (const osim::Joint& before : model.joints) {
      if (&before == &joint) break;
      if (!stands_still(model, before)) slot_of_this += static_cast<int>(before.coordinates.size());
    }
    return SimTK::MobilizedBody::Custom(
        on, new PlanarMobilizer(matter, PlanarMotion(model, joint), slot_of_this), inboard, body,
        outboard);
  };
  bodies[joint.child].root = made().getMobilizedBodyIndex();
}

}  // namespace stride::simbody
