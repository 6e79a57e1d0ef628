#include <algorithm>
#include <cmath>
#include <numbers>

#include "calibrate/osim/osim_parts.h"
#include "extract/io/error.h"

namespace stride::osim {

void read_geometry(Model& model, const OsimElement& from) {
  from.only({"body_name", "socket_frame", "location", "orientation", "radius"});
  const int body = body_of(model, from, "socket_frame", "body_name");
  const Vec3 location = from.vec3("location"), orientation = from.vec3("orientation");
  if (from.tag() == "ContactSphere") {
    const double radius = from.need("radius").number();
    if (!(radius > 0)) from.fail(fmt::format("its radius is {}: must be > 0 m", radius));
    model.spheres.push_back({from.name(), body, location, radius});
  } else if (from.tag() == "ContactHalfSpace") {
    // OpenSim's half-space is x > 0 of its frame: turned by -90° about z it is y < 0, the floor.
    const bool level = std::abs(orientation[0]) < 1e-9 && std::abs(orientation[1]) < 1e-9 &&
                       std::abs(orientation[2] + std::numbers::pi / 2) < 1e-9;
    if (body >= 0 || !level)
      from.fail("must be a level floor of the ground, orientation 0 0 -1.5707963");
    model.planes.push_back({from.name(), location[1]});
  } else {
    from.fail("is not understood; contact geometry is ContactSphere and ContactHalfSpace");
  }
}

void read_contact(Model& model, const OsimElement& from) {
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
    const auto plane = std::find_if(model.planes.begin(), model.planes.end(), is_it);
    const auto sphere = std::find_if(model.spheres.begin(), model.spheres.end(), is_it);
    if (sphere != model.spheres.end())
      contact.spheres.push_back(static_cast<int>(sphere - model.spheres.begin()));
    else if (plane != model.planes.end() && contact.plane < 0)
      contact.plane = static_cast<int>(plane - model.planes.begin());
    else
      only.fail(fmt::format("geometry \"{}\": there is no such contact geometry, or a second plane",
                            name));
  }
  if (contact.plane < 0 || contact.spheres.empty())
    from.fail("must name one plane and one sphere at least");
  model.contacts.push_back(std::move(contact));
}

void read_limit(Model& model, const OsimElement& from) {
  from.only({"isDisabled", "appliesForce", "coordinate", "upper_stiffness", "upper_limit",
             "lower_stiffness", "lower_limit", "damping", "transition"});
  CoordinateLimit limit;
  limit.name = from.name();
  limit.coordinate = coordinate_of(model, from, "coordinate", "coordinate");
  limit.upper_stiffness = from.number("upper_stiffness", limit.upper_stiffness);
  limit.upper_limit = from.number("upper_limit", limit.upper_limit);
  limit.lower_stiffness = from.number("lower_stiffness", limit.lower_stiffness);
  limit.lower_limit = from.number("lower_limit", limit.lower_limit);
  limit.damping = from.number("damping", limit.damping);
  limit.transition = from.number("transition", limit.transition);
  if (!(limit.transition > 0)) from.fail("its transition must be > 0");
  model.limits.push_back(limit);
}

}  // namespace stride::osim
