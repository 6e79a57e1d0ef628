#include <algorithm>

#include "calibrate/osim/osim_parts.h"
#include "extract/io/error.h"

namespace stride::osim {
namespace {

void read_body(Model& model, const OsimElement& from) {
  if (from.tag() != "Body") from.fail("is not understood; only <Body> is");
  if (from.name() == "ground") return;
  from.only({"mass", "mass_center", "inertia", "inertia_xx", "inertia_yy", "inertia_zz",
             "inertia_xy", "inertia_xz", "inertia_yz", "Joint"});
  Body body;
  body.name = from.name();
  if (model.body(body.name) >= 0) from.fail("there are two bodies of this name");
  body.mass_kg = from.need("mass").number();
  if (body.mass_kg < 0) from.fail("its mass is negative");
  body.mass_center_m = from.vec3("mass_center");
  if (const OsimElement inertia = from.child("inertia")) {
    const std::vector<double> all = inertia.numbers();
    if (all.size() != 6) inertia.fail("must be six numbers: xx yy zz xy xz yz");
    std::copy(all.begin(), all.end(), body.inertia.begin());
  } else {
    const char* tags[] = {"inertia_xx", "inertia_yy", "inertia_zz",
                          "inertia_xy", "inertia_xz", "inertia_yz"};
    for (int i = 0; i < 6; ++i) body.inertia[i] = from.number(tags[i], 0);
  }
  model.bodies.push_back(body);
}

TransformAxis read_axis(const Model& model, const OsimElement& from) {
  from.only({"coordinates", "axis", "function"});
  TransformAxis axis;
  axis.axis = from.vec3("axis");
  if (const OsimElement coordinates = from.child("coordinates"); coordinates.text() != "")
    axis.coordinate = coordinate_named(model, coordinates, coordinates.text());
  const OsimElement function = from.object("function");
  if (function.tag() == "Constant") {
    function.only({"value"});
    axis.kind = TransformAxis::Kind::constant;
    axis.constant = function.number("value", 0);
    return axis;
  }
  if (axis.coordinate < 0) from.fail("depends on no coordinate, so its function must be Constant");
  if (function.tag() == "LinearFunction") {
    function.only({"coefficients"});
    const std::vector<double> both = function.need("coefficients").numbers();
    if (both.size() != 2) function.fail("must have two coefficients: slope and intercept");
    axis.kind = TransformAxis::Kind::linear;
    axis.slope = both[0], axis.intercept = both[1];
  } else {
    axis.kind = TransformAxis::Kind::spline;
    axis.spline = read_spline(from, "function");
  }
  return axis;
}

void read_transform(const Model& model, const OsimElement& from, Joint& joint) {
  const char* order[] = {"rotation1",    "rotation2",    "rotation3",
                         "translation1", "translation2", "translation3"};
  const std::vector<OsimElement> all = from.children();
  if (all.size() != 6) from.fail("must have six axes: rotation1‥3, translation1‥3");
  for (int i = 0; i < 6; ++i) {
    if (all[i].tag() != "TransformAxis" || all[i].name() != order[i])
      all[i].fail(fmt::format("must be <TransformAxis name=\"{}\">", order[i]));
    joint.transform[i] = read_axis(model, all[i]);
  }
}

bool turns(const Joint& joint, int coordinate) {
  return std::any_of(joint.transform.begin(), joint.transform.begin() + 3,
                     [&](const TransformAxis& each) { return each.coordinate == coordinate; });
}

void read_coordinates(Model& model, const OsimElement& from, const std::vector<OsimElement>& all,
                      Joint& joint) {
  for (const OsimElement& each : all) {
    if (each.tag() != "Coordinate") each.fail("is not understood; only <Coordinate> is");
    each.only({"motion_type", "default_value", "default_speed_value", "range", "clamped", "locked",
               "prescribed"});
    if (each.flag("prescribed", false)) each.fail("a prescribed coordinate is not understood");
    if (model.coordinate(each.name()) >= 0) each.fail("there are two coordinates of this name");
    Coordinate coordinate;
    coordinate.name = each.name();
    coordinate.default_value = each.number("default_value", 0);
    coordinate.default_speed = each.number("default_speed_value", 0);
    if (const OsimElement range = each.child("range")) {
      const std::vector<double> ends = range.numbers();
      if (ends.size() != 2 || ends[0] > ends[1]) range.fail("must be two numbers, the lower first");
      coordinate.range_min = ends[0], coordinate.range_max = ends[1];
    }
    coordinate.clamped = each.flag("clamped", false);
    coordinate.locked = each.flag("locked", false);
    joint.coordinates.push_back(static_cast<int>(model.coordinates.size()));
    model.coordinates.push_back(coordinate);
  }
  const std::size_t expected[] = {3, 1, joint.coordinates.size(), 0};  // planar, pin, custom, weld
  if (joint.coordinates.size() != expected[static_cast<int>(joint.type)])
    from.fail(fmt::format("has {} coordinates, must have {}", joint.coordinates.size(),
                          expected[static_cast<int>(joint.type)]));
  if (joint.type == Joint::Type::planar)
    for (int i : {1, 2}) model.coordinates[joint.coordinates[i]].rotational = false;
  if (joint.type != Joint::Type::custom) return;
  read_transform(model, from.need("SpatialTransform"), joint);
  for (int i : joint.coordinates) model.coordinates[i].rotational = turns(joint, i);
}

Joint joint_head(const OsimElement& from) {
  Joint joint;
  joint.name = from.name();
  const std::string type = from.tag();
  if (type == "PlanarJoint")
    joint.type = Joint::Type::planar;
  else if (type == "PinJoint")
    joint.type = Joint::Type::pin;
  else if (type == "CustomJoint")
    joint.type = Joint::Type::custom;
  else if (type == "WeldJoint")
    joint.type = Joint::Type::weld;
  else
    from.fail("is not understood; joints are PlanarJoint, PinJoint, CustomJoint, WeldJoint");
  return joint;
}

void read_joint_inside_body(Model& model, const OsimElement& body) {
  if (body.name() == "ground") return;
  const std::vector<OsimElement> inside = body.need("Joint").children();
  if (inside.size() != 1) body.fail("must have exactly one joint that connects it to its parent");
  const OsimElement& from = inside.front();
  from.only({"parent_body", "location_in_parent", "orientation_in_parent", "location",
             "orientation", "CoordinateSet", "reverse", "SpatialTransform"});
  if (from.flag("reverse", false)) from.fail("a reversed joint is not understood");
  Joint joint = joint_head(from);
  joint.child = model.body(body.name());
  joint.parent = body_of(model, from, "parent_body", "parent_body");
  joint.location_in_parent_m = from.vec3("location_in_parent");
  joint.orientation_in_parent_rad = from.vec3("orientation_in_parent");
  joint.location_in_child_m = from.vec3("location");
  joint.orientation_in_child_rad = from.vec3("orientation");
  read_coordinates(model, from, from.objects("CoordinateSet"), joint);
  model.joints.push_back(joint);
}

void read_frame(const Model& model, const OsimElement& joint, const char* socket, int& body,
                Vec3& location, Vec3& orientation) {
  const OsimElement at = joint.need(socket);
  const std::string name = last_of_path(at.text());
  for (const OsimElement& frame : joint.objects("frames")) {
    if (frame.name() != name) continue;
    if (frame.tag() != "PhysicalOffsetFrame")
      frame.fail("is not understood; only <PhysicalOffsetFrame> is");
    frame.only({"socket_parent", "translation", "orientation"});
    body = body_of(model, frame, "socket_parent", "socket_parent");
    location = frame.vec3("translation");
    orientation = frame.vec3("orientation");
    return;
  }
  body = body_of(model, joint, socket, socket);
}

void read_joint_of_set(Model& model, const OsimElement& from) {
  from.only(
      {"socket_parent_frame", "socket_child_frame", "coordinates", "frames", "SpatialTransform"});
  Joint joint = joint_head(from);
  read_frame(model, from, "socket_parent_frame", joint.parent, joint.location_in_parent_m,
             joint.orientation_in_parent_rad);
  read_frame(model, from, "socket_child_frame", joint.child, joint.location_in_child_m,
             joint.orientation_in_child_rad);
  if (joint.child < 0) from.fail("its child is the ground: a joint must move a body");
  read_coordinates(model, from, from.objects("coordinates"), joint);
  model.joints.push_back(joint);
}

void order_joints(const OsimElement& root, Model& model) {
  std::vector<Joint> ordered;
  std::vector<bool> placed(model.bodies.size(), false);
  while (ordered.size() < model.joints.size()) {
    const std::size_t before = ordered.size();
    for (const Joint& joint : model.joints) {
      if (placed[joint.child] || (joint.parent >= 0 && !placed[joint.parent])) continue;
      ordered.push_back(joint);
      placed[joint.child] = true;
    }
    if (ordered.size() == before)
      root.fail("its joints do not form a tree: a loop, or a body with two joints");
  }
  for (std::size_t i = 0; i < placed.size(); ++i)
    if (!placed[i]) root.fail(fmt::format("no joint holds the body {}", model.bodies[i].name));
  model.joints = std::move(ordered);
}

}  // namespace

void read_bodies_and_joints(const OsimElement& root, bool version4, Model& model) {
  const auto bodies = root.objects("BodySet");
  for (const auto& each : bodies) read_body(model, each);
  if (version4)
    for (const auto& each : root.objects("JointSet")) read_joint_of_set(model, each);
  else
    for (const auto& each : bodies) read_joint_inside_body(model, each);
  order_joints(root, model);
}

}  // namespace stride::osim
