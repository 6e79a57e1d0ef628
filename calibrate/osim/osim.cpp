#include <algorithm>
#include <functional>

#include "calibrate/osim/model.h"
#include "calibrate/osim/osim_parts.h"
#include "extract/io/error.h"

namespace stride::osim {
namespace {

OsimElement reference(const OsimElement& from, const char* socket, const char* bare) {
  const OsimElement found = from.child(socket);
  return found ? found : from.need(bare);
}

void read_force(Model& model, const OsimElement& from) {
  if (from.flag("isDisabled", false) || !from.flag("appliesForce", true)) return;
  if (from.tag() == "Thelen2003Muscle")
    read_muscle(model, from);
  else if (from.tag() == "HuntCrossleyForce")
    read_contact(model, from);
  else if (from.tag() == "CoordinateLimitForce")
    read_limit(model, from);
  else
    from.fail(
        "is not understood; forces are Thelen2003Muscle, HuntCrossleyForce, CoordinateLimitForce");
}

Model read_model(const OsimElement& root, bool version4) {
  root.only({"length_units", "force_units", "gravity", "BodySet", "ConstraintSet", "ForceSet",
             "ContactGeometrySet", "ControllerSet", "ComponentSet", "JointSet", "Ground", "ground",
             "components"});
  root.none_of({"ConstraintSet", "ControllerSet", "ComponentSet", "components"});
  if (const auto units = root.child("length_units"); units && units.text() != "meters")
    units.fail(fmt::format("\"{}\": must be meters", units.text()));
  if (const auto units = root.child("force_units"); units && units.text() != "N")
    units.fail(fmt::format("\"{}\": must be N", units.text()));
  Model model;
  model.name = root.name();
  if (const auto credits = root.child("credits")) model.credits = credits.text();
  model.gravity_m_s2 = root.vec3("gravity", model.gravity_m_s2);
  read_bodies_and_joints(root, version4, model);
  for (const auto& each : root.objects("ContactGeometrySet")) read_geometry(model, each);
  for (const auto& each : root.objects("ForceSet")) read_force(model, each);
  return model;
}

}  // namespace

std::string last_of_path(const std::string& path) { return path.substr(path.rfind('/') + 1); }

int body_of(const Model& model, const OsimElement& from, const char* socket, const char* bare) {
  const OsimElement at = reference(from, socket, bare);
  const std::string name = last_of_path(at.text());
  if (name == "ground") return -1;
  const int body = model.body(name);
  if (body < 0) at.fail(fmt::format("\"{}\": there is no such body", at.text()));
  return body;
}

int coordinate_named(const Model& model, const OsimElement& at, const std::string& path) {
  const int coordinate = model.coordinate(last_of_path(path));
  if (coordinate < 0) at.fail(fmt::format("\"{}\": there is no such coordinate", path));
  return coordinate;
}

int coordinate_of(const Model& model, const OsimElement& from, const char* socket,
                  const char* bare) {
  const OsimElement at = reference(from, socket, bare);
  return coordinate_named(model, at, at.text());
}

SimmSpline read_spline(const OsimElement& from, const char* property) {
  const OsimElement function = from.object(property);
  SimmSpline spline;
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
  return read_model(root.need("Model"), version4);
}

}  // namespace stride::osim
