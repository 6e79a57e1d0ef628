#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibrate/model.h"
#include "calibrate/osim_element.h"
#include "extract/error.h"

// Version 3 documents (30000) keep each body's joint inside the body and name things by bare names;
// version 4 documents (40000) keep joints in a set and point at things by paths through "sockets".

namespace stride {
namespace {

/// The thing that a path or bare name means: "/jointset/knee_r/knee_angle_r" → "knee_angle_r".
std::string last_of_path(const std::string& path) { return path.substr(path.rfind('/') + 1); }

class OsimReader {
 public:
  explicit OsimReader(const OsimElement& model) : root_(model) {}

  Model read(bool version4);

 private:
  OsimElement reference(const OsimElement& from, const char* socket, const char* bare) const;
  int body_of(const OsimElement& from, const char* socket, const char* bare) const;
  int coordinate_of(const OsimElement& from, const char* socket, const char* bare) const;
  int coordinate_named(const OsimElement& at, const std::string& path) const;

  void read_body(const OsimElement& from);
  void read_joint_inside_body(const OsimElement& body);
  void read_joint_of_set(const OsimElement& from);
  Joint joint_head(const OsimElement& from) const;
  void read_frame(const OsimElement& joint, const char* socket, int& body, Vec3& location,
                  Vec3& orientation) const;
  void read_coordinates(const OsimElement& from, const std::vector<OsimElement>& all, Joint& joint);
  void read_transform(const OsimElement& from, Joint& joint) const;
  TransformAxis read_axis(const OsimElement& from) const;
  void order_joints();

  void read_muscle(const OsimElement& from);
  PathPoint read_point(const OsimElement& from) const;
  Spline read_spline(const OsimElement& from, const char* property) const;

  void read_geometry(const OsimElement& from);
  void read_contact(const OsimElement& from);
  void read_limit(const OsimElement& from);
  void read_force(const OsimElement& from);

  OsimElement root_;
  Model model_;
};

// ---- Names -------------------------------------------------------------------------------------

OsimElement OsimReader::reference(const OsimElement& from, const char* socket,
                                  const char* bare) const {
  const OsimElement found = from.child(socket);
  return found ? found : from.need(bare);
}

int OsimReader::body_of(const OsimElement& from, const char* socket, const char* bare) const {
  const OsimElement at = reference(from, socket, bare);
  const std::string name = last_of_path(at.text());
  if (name == "ground") return -1;
  const int body = model_.body(name);
  if (body < 0) at.fail(fmt::format("\"{}\": there is no such body", at.text()));
  return body;
}

int OsimReader::coordinate_named(const OsimElement& at, const std::string& path) const {
  const int coordinate = model_.coordinate(last_of_path(path));
  if (coordinate < 0) at.fail(fmt::format("\"{}\": there is no such coordinate", path));
  return coordinate;
}

int OsimReader::coordinate_of(const OsimElement& from, const char* socket, const char* bare) const {
  const OsimElement at = reference(from, socket, bare);
  return coordinate_named(at, at.text());
}

// ---- Bodies and joints -------------------------------------------------------------------------

void OsimReader::read_body(const OsimElement& from) {
  if (from.tag() != "Body") from.fail("is not understood; only <Body> is");
  if (from.name() == "ground") return;
  from.only({"mass", "mass_center", "inertia", "inertia_xx", "inertia_yy", "inertia_zz",
             "inertia_xy", "inertia_xz", "inertia_yz", "Joint"});
  Body body;
  body.name = from.name();
  if (model_.body(body.name) >= 0) from.fail("there are two bodies of this name");
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
  model_.bodies.push_back(body);
}

Joint OsimReader::joint_head(const OsimElement& from) const {
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

void OsimReader::read_joint_inside_body(const OsimElement& body) {
  if (body.name() == "ground") return;
  const std::vector<OsimElement> inside = body.need("Joint").children();
  if (inside.size() != 1) body.fail("must have exactly one joint that connects it to its parent");
  const OsimElement& from = inside.front();
  from.only({"parent_body", "location_in_parent", "orientation_in_parent", "location",
             "orientation", "CoordinateSet", "reverse", "SpatialTransform"});
  if (from.flag("reverse", false)) from.fail("a reversed joint is not understood");
  Joint joint = joint_head(from);
  joint.child = model_.body(body.name());
  joint.parent = body_of(from, "parent_body", "parent_body");
  joint.location_in_parent_m = from.vec3("location_in_parent");
  joint.orientation_in_parent_rad = from.vec3("orientation_in_parent");
  joint.location_in_child_m = from.vec3("location");
  joint.orientation_in_child_rad = from.vec3("orientation");
  read_coordinates(from, from.objects("CoordinateSet"), joint);
  model_.joints.push_back(joint);
}

void OsimReader::read_joint_of_set(const OsimElement& from) {
  from.only(
      {"socket_parent_frame", "socket_child_frame", "coordinates", "frames", "SpatialTransform"});
  Joint joint = joint_head(from);
  read_frame(from, "socket_parent_frame", joint.parent, joint.location_in_parent_m,
             joint.orientation_in_parent_rad);
  read_frame(from, "socket_child_frame", joint.child, joint.location_in_child_m,
             joint.orientation_in_child_rad);
  if (joint.child < 0) from.fail("its child is the ground: a joint must move a body");
  read_coordinates(from, from.objects("coordinates"), joint);
  model_.joints.push_back(joint);
}

void OsimReader::read_frame(const OsimElement& joint, const char* socket, int& body, Vec3& location,
                            Vec3& orientation) const {
  const OsimElement at = joint.need(socket);
  const std::string name = last_of_path(at.text());
  for (const OsimElement& frame : joint.objects("frames")) {
    if (frame.name() != name) continue;
    if (frame.tag() != "PhysicalOffsetFrame")
      frame.fail("is not understood; only <PhysicalOffsetFrame> is");
    frame.only({"socket_parent", "translation", "orientation"});
    body = body_of(frame, "socket_parent", "socket_parent");
    location = frame.vec3("translation");
    orientation = frame.vec3("orientation");
    return;
  }
  body = body_of(joint, socket, socket);
}

bool turns(const Joint& joint, int coordinate) {
  return std::any_of(joint.transform.begin(), joint.transform.begin() + 3,
                     [&](const TransformAxis& each) { return each.coordinate == coordinate; });
}

void OsimReader::read_coordinates(const OsimElement& from, const std::vector<OsimElement>& all,
                                  Joint& joint) {
  for (const OsimElement& each : all) {
    if (each.tag() != "Coordinate") each.fail("is not understood; only <Coordinate> is");
    each.only({"motion_type", "default_value", "default_speed_value", "range", "clamped", "locked",
               "prescribed"});
    if (each.flag("prescribed", false)) each.fail("a prescribed coordinate is not understood");
    if (model_.coordinate(each.name()) >= 0) each.fail("there are two coordinates of this name");
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
    joint.coordinates.push_back(static_cast<int>(model_.coordinates.size()));
    model_.coordinates.push_back(coordinate);
  }
  const std::size_t expected[] = {3, 1, joint.coordinates.size(), 0};  // planar, pin, custom, weld
  if (joint.coordinates.size() != expected[static_cast<int>(joint.type)])
    from.fail(fmt::format("has {} coordinates, must have {}", joint.coordinates.size(),
                          expected[static_cast<int>(joint.type)]));
  if (joint.type == Joint::Type::planar)
    for (int i : {1, 2}) model_.coordinates[joint.coordinates[i]].rotational = false;
  if (joint.type != Joint::Type::custom) return;
  read_transform(from.need("SpatialTransform"), joint);
  for (int i : joint.coordinates) model_.coordinates[i].rotational = turns(joint, i);
}

void OsimReader::read_transform(const OsimElement& from, Joint& joint) const {
  const char* order[] = {"rotation1",    "rotation2",    "rotation3",
                         "translation1", "translation2", "translation3"};
  const std::vector<OsimElement> all = from.children();
  if (all.size() != 6) from.fail("must have six axes: rotation1‥3, translation1‥3");
  for (int i = 0; i < 6; ++i) {
    if (all[i].tag() != "TransformAxis" || all[i].name() != order[i])
      all[i].fail(fmt::format("must be <TransformAxis name=\"{}\">", order[i]));
    joint.transform[i] = read_axis(all[i]);
  }
}

TransformAxis OsimReader::read_axis(const OsimElement& from) const {
  from.only({"coordinates", "axis", "function"});
  TransformAxis axis;
  axis.axis = from.vec3("axis");
  if (const OsimElement coordinates = from.child("coordinates"); coordinates.text() != "")
    axis.coordinate = coordinate_named(coordinates, coordinates.text());
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

void OsimReader::order_joints() {
  std::vector<Joint> ordered;
  std::vector<bool> placed(model_.bodies.size(), false);
  while (ordered.size() < model_.joints.size()) {
    const std::size_t before = ordered.size();
    for (const Joint& joint : model_.joints) {
      if (placed[joint.child] || (joint.parent >= 0 && !placed[joint.parent])) continue;
      ordered.push_back(joint);
      placed[joint.child] = true;
    }
    if (ordered.size() == before)
      root_.fail("its joints do not form a tree: a loop, or a body with two joints");
  }
  for (std::size_t i = 0; i < placed.size(); ++i)
    if (!placed[i]) root_.fail(fmt::format("no joint holds the body {}", model_.bodies[i].name));
  model_.joints = std::move(ordered);
}

// ---- Muscles -----------------------------------------------------------------------------------

Spline OsimReader::read_spline(const OsimElement& from, const char* property) const {
  const OsimElement function = from.object(property);
  Spline spline;
  if (function.tag() == "Constant") {
    spline.y = {function.number("value", 0)};
    spline.x = {0};
    return spline;
  }
  if (function.tag() == "MultiplierFunction") {  // as OpenSim's scaling tool leaves it
    function.only({"function", "scale"});
    spline = read_spline(function, "function");
    for (double& y : spline.y) y *= function.number("scale", 1);
    return spline;
  }
  if (function.tag() != "SimmSpline")
    function.fail("is not understood; functions are Constant, LinearFunction, SimmSpline");
  function.only({"x", "y"});
  spline.x = function.need("x").numbers();
  spline.y = function.need("y").numbers();
  if (spline.x.size() != spline.y.size() || spline.x.size() < 2)
    function.fail("must have as many x as y, two at least");
  if (std::adjacent_find(spline.x.begin(), spline.x.end(), std::greater_equal<>()) !=
      spline.x.end())
    function.fail("its x must increase");
  return spline;
}

PathPoint OsimReader::read_point(const OsimElement& from) const {
  PathPoint point;
  point.name = from.name();
  point.body = body_of(from, "socket_parent_frame", "body");
  if (from.tag() == "PathPoint") {
    from.only({"location", "body", "socket_parent_frame"});
    point.location_m = from.vec3("location");
  } else if (from.tag() == "ConditionalPathPoint") {
    from.only(
        {"location", "body", "socket_parent_frame", "range", "coordinate", "socket_coordinate"});
    point.kind = PathPoint::Kind::conditional;
    point.location_m = from.vec3("location");
    point.coordinate = coordinate_of(from, "socket_coordinate", "coordinate");
    const std::vector<double> ends = from.need("range").numbers();
    if (ends.size() != 2) from.fail("its range must be two numbers");
    point.range_min = ends[0], point.range_max = ends[1];
  } else if (from.tag() == "MovingPathPoint") {
    // Its <location> is where it stood when the model was saved; the functions say where it is.
    from.only({"location", "body", "socket_parent_frame", "x_location", "y_location", "z_location",
               "x_coordinate", "y_coordinate", "z_coordinate", "socket_x_coordinate",
               "socket_y_coordinate", "socket_z_coordinate"});
    point.kind = PathPoint::Kind::moving;
    const char* names[] = {"x", "y", "z"};
    for (int i = 0; i < 3; ++i) {
      const std::string axis = names[i];
      point.location[i] = read_spline(from, (axis + "_location").c_str());
      point.location_coordinate[i] = coordinate_of(from, ("socket_" + axis + "_coordinate").c_str(),
                                                   (axis + "_coordinate").c_str());
    }
  } else {
    from.fail(
        "is not understood; path points are PathPoint, ConditionalPathPoint, MovingPathPoint");
  }
  return point;
}

void OsimReader::read_muscle(const OsimElement& from) {
  Muscle muscle;
  muscle.name = from.name();
  if (model_.muscle(muscle.name) >= 0) from.fail("there are two muscles of this name");
  const std::pair<const char*, double*> numbers[] = {
      {"max_isometric_force", &muscle.max_isometric_force_N},
      {"optimal_fiber_length", &muscle.optimal_fiber_length_m},
      {"tendon_slack_length", &muscle.tendon_slack_length_m},
      {"pennation_angle_at_optimal", &muscle.pennation_angle_at_optimal_rad},
      {"max_contraction_velocity", &muscle.max_contraction_velocity},
      {"activation_time_constant", &muscle.activation_time_constant_s},
      {"deactivation_time_constant", &muscle.deactivation_time_constant_s},
      {"minimum_activation", &muscle.minimum_activation},
      {"FmaxTendonStrain", &muscle.FmaxTendonStrain},
      {"FmaxMuscleStrain", &muscle.FmaxMuscleStrain},
      {"KshapeActive", &muscle.KshapeActive},
      {"KshapePassive", &muscle.KshapePassive},
      {"Af", &muscle.Af},
      {"Flen", &muscle.Flen},
      {"fv_linear_extrap_threshold", &muscle.fv_linear_extrap_threshold},
      {"maximum_pennation_angle", &muscle.maximum_pennation_angle_rad},
      {"default_activation", &muscle.default_activation}};
  from.only({"isDisabled",
             "appliesForce",
             "GeometryPath",
             "max_isometric_force",
             "optimal_fiber_length",
             "tendon_slack_length",
             "pennation_angle_at_optimal",
             "max_contraction_velocity",
             "activation_time_constant",
             "deactivation_time_constant",
             "minimum_activation",
             "FmaxTendonStrain",
             "FmaxMuscleStrain",
             "KshapeActive",
             "KshapePassive",
             "Af",
             "Flen",
             "fv_linear_extrap_threshold",
             "maximum_pennation_angle",
             "default_activation",
             "default_fiber_length",
             "ignore_tendon_compliance",
             "ignore_activation_dynamics"});
  for (const auto& [tag, value] : numbers) *value = from.number(tag, *value);
  for (double* positive : {&muscle.max_isometric_force_N, &muscle.optimal_fiber_length_m,
                           &muscle.tendon_slack_length_m, &muscle.max_contraction_velocity,
                           &muscle.activation_time_constant_s, &muscle.deactivation_time_constant_s,
                           &muscle.FmaxTendonStrain, &muscle.FmaxMuscleStrain})
    if (!(*positive > 0))
      from.fail(fmt::format("one of its figures is {}: must be > 0", *positive));
  for (const char* ignores : {"ignore_tendon_compliance", "ignore_activation_dynamics"})
    if (from.flag(ignores, false)) from.need(ignores).fail("true is not understood");
  if (const OsimElement length = from.child("default_fiber_length"))
    muscle.default_fiber_length_m = length.number();

  const OsimElement path = from.need("GeometryPath");
  path.only({"PathPointSet", "PathWrapSet"});
  path.none_of({"PathWrapSet"});
  for (const OsimElement& point : path.objects("PathPointSet"))
    muscle.path.push_back(read_point(point));
  if (muscle.path.size() < 2) path.fail("has fewer than two points");
  model_.muscles.push_back(std::move(muscle));
}

// ---- Contact and limits ------------------------------------------------------------------------

void OsimReader::read_geometry(const OsimElement& from) {
  from.only({"body_name", "socket_frame", "location", "orientation", "radius"});
  const int body = body_of(from, "socket_frame", "body_name");
  const Vec3 location = from.vec3("location"), orientation = from.vec3("orientation");
  if (from.tag() == "ContactSphere") {
    const double radius = from.need("radius").number();
    if (!(radius > 0)) from.fail(fmt::format("its radius is {}: must be > 0 m", radius));
    model_.spheres.push_back({from.name(), body, location, radius});
  } else if (from.tag() == "ContactHalfSpace") {
    // OpenSim's half-space is x > 0 of its frame: turned by -90° about z it is y < 0, the floor.
    const bool level = std::abs(orientation[0]) < 1e-9 && std::abs(orientation[1]) < 1e-9 &&
                       std::abs(orientation[2] + std::numbers::pi / 2) < 1e-9;
    if (body >= 0 || !level)
      from.fail("must be a level floor of the ground, orientation 0 0 -1.5707963");
    model_.planes.push_back({from.name(), location[1]});
  } else {
    from.fail("is not understood; contact geometry is ContactSphere and ContactHalfSpace");
  }
}

void OsimReader::read_contact(const OsimElement& from) {
  from.only({"isDisabled", "appliesForce", "HuntCrossleyForce::ContactParametersSet",
             "transition_velocity"});
  const auto parameters = from.objects("HuntCrossleyForce::ContactParametersSet");
  if (parameters.size() != 1) from.fail("must have exactly one set of contact parameters");
  const OsimElement& only = parameters.front();
  only.only({"geometry", "stiffness", "dissipation", "static_friction", "dynamic_friction",
             "viscous_friction"});
  ContactForce contact;
  contact.name = from.name();
  contact.stiffness = only.number("stiffness", contact.stiffness);
  contact.dissipation = only.number("dissipation", contact.dissipation);
  contact.static_friction = only.number("static_friction", contact.static_friction);
  contact.dynamic_friction = only.number("dynamic_friction", contact.dynamic_friction);
  contact.viscous_friction = only.number("viscous_friction", contact.viscous_friction);
  contact.transition_velocity_m_s =
      from.number("transition_velocity", contact.transition_velocity_m_s);

  const std::string geometry = only.text("geometry");
  for (std::size_t at = 0; at < geometry.size();) {
    const std::size_t end = std::min(geometry.find_first_of(" \t\r\n", at), geometry.size());
    const std::string name = last_of_path(geometry.substr(at, end - at));
    at = std::min(geometry.find_first_not_of(" \t\r\n", end), geometry.size());
    const auto is_it = [&](const auto& each) { return each.name == name; };
    const auto plane = std::find_if(model_.planes.begin(), model_.planes.end(), is_it);
    const auto sphere = std::find_if(model_.spheres.begin(), model_.spheres.end(), is_it);
    if (sphere != model_.spheres.end())
      contact.spheres.push_back(static_cast<int>(sphere - model_.spheres.begin()));
    else if (plane != model_.planes.end() && contact.plane < 0)
      contact.plane = static_cast<int>(plane - model_.planes.begin());
    else
      only.fail(fmt::format("geometry \"{}\": there is no such contact geometry, or a second plane",
                            name));
  }
  if (contact.plane < 0 || contact.spheres.empty())
    from.fail("must name one plane and one sphere at least");
  model_.contacts.push_back(std::move(contact));
}

void OsimReader::read_limit(const OsimElement& from) {
  from.only({"isDisabled", "appliesForce", "coordinate", "upper_stiffness", "upper_limit",
             "lower_stiffness", "lower_limit", "damping", "transition"});
  CoordinateLimit limit;
  limit.name = from.name();
  limit.coordinate = coordinate_of(from, "coordinate", "coordinate");
  limit.upper_stiffness = from.number("upper_stiffness", limit.upper_stiffness);
  limit.upper_limit = from.number("upper_limit", limit.upper_limit);
  limit.lower_stiffness = from.number("lower_stiffness", limit.lower_stiffness);
  limit.lower_limit = from.number("lower_limit", limit.lower_limit);
  limit.damping = from.number("damping", limit.damping);
  limit.transition = from.number("transition", limit.transition);
  if (!(limit.transition > 0)) from.fail("its transition must be > 0");
  model_.limits.push_back(limit);
}

void OsimReader::read_force(const OsimElement& from) {
  if (from.flag("isDisabled", false) || !from.flag("appliesForce", true)) return;
  if (from.tag() == "Thelen2003Muscle")
    read_muscle(from);
  else if (from.tag() == "HuntCrossleyForce")
    read_contact(from);
  else if (from.tag() == "CoordinateLimitForce")
    read_limit(from);
  else
    from.fail(
        "is not understood; forces are Thelen2003Muscle, HuntCrossleyForce, CoordinateLimitForce");
}

Model OsimReader::read(bool version4) {
  root_.only({"length_units", "force_units", "gravity", "BodySet", "ConstraintSet", "ForceSet",
              "ContactGeometrySet", "ControllerSet", "ComponentSet", "JointSet", "Ground", "ground",
              "components"});
  root_.none_of({"ConstraintSet", "ControllerSet", "ComponentSet", "components"});
  if (const auto units = root_.child("length_units"); units && units.text() != "meters")
    units.fail(fmt::format("\"{}\": must be meters", units.text()));
  if (const auto units = root_.child("force_units"); units && units.text() != "N")
    units.fail(fmt::format("\"{}\": must be N", units.text()));
  model_.name = root_.name();
  if (const auto credits = root_.child("credits")) model_.credits = credits.text();
  model_.gravity_m_s2 = root_.vec3("gravity", model_.gravity_m_s2);

  const auto bodies = root_.objects("BodySet");
  for (const auto& each : bodies)
    if (each.tag() != "groups") read_body(each);
  if (version4)
    for (const auto& each : root_.objects("JointSet")) read_joint_of_set(each);
  else
    for (const auto& each : bodies) read_joint_inside_body(each);
  order_joints();
  for (const auto& each : root_.objects("ContactGeometrySet")) read_geometry(each);
  for (const auto& each : root_.objects("ForceSet")) read_force(each);
  return std::move(model_);
}

}  // namespace

Model load_osim(const std::filesystem::path& file) {
  const OsimDocument document(file);
  const OsimElement root(document, document.tree.child("OpenSimDocument"));
  require(static_cast<bool>(root),
          "{}: not an OpenSim model: its first element must be <OpenSimDocument>", file.string());
  const pugi::xml_attribute attribute = document.tree.child("OpenSimDocument").attribute("Version");
  const int version = attribute.as_int();
  const bool version3 = version >= 30000 && version < 30500;
  const bool version4 = version >= 40000 && version < 50000;
  if (!version3 && !version4)
    root.fail(
        fmt::format("Version=\"{}\": must be 30000‥30499 or 40000‥49999; save it with OpenSim 4",
                    attribute.value()));
  return OsimReader(root.need("Model")).read(version4);
}

}  // namespace stride
