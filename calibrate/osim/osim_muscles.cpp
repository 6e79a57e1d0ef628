#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "calibrate/osim/osim_parts.h"
#include "extract/io/error.h"

namespace stride::osim {
namespace {

PathPoint read_point(const Model& model, const OsimElement& from) {
  PathPoint point;
  point.name = from.name();
  point.body = body_of(model, from, "socket_parent_frame", "body");
  if (from.tag() == "PathPoint") {
    from.only({"location", "body", "socket_parent_frame"});
    point.location_m = from.vec3("location");
  } else if (from.tag() == "ConditionalPathPoint") {
    from.only(
        {"location", "body", "socket_parent_frame", "range", "coordinate", "socket_coordinate"});
    point.kind = PathPoint::Kind::conditional;
    point.location_m = from.vec3("location");
    point.coordinate = coordinate_of(model, from, "socket_coordinate", "coordinate");
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
      point.location_coordinate[i] = coordinate_of(
          model, from, ("socket_" + axis + "_coordinate").c_str(), (axis + "_coordinate").c_str());
    }
  } else {
    from.fail(
        "is not understood; path points are PathPoint, ConditionalPathPoint, MovingPathPoint");
  }
  return point;
}

}  // namespace

void read_muscle(Model& model, const OsimElement& from) {
  Muscle muscle;
  muscle.name = from.name();
  if (model.muscle(muscle.name) >= 0) from.fail("there are two muscles of this name");
  struct Figure {
    const char* tag;
    double* value;
    bool positive;
  };
  const Figure figures[] = {
      {"max_isometric_force", &muscle.max_isometric_force_N, true},
      {"optimal_fiber_length", &muscle.optimal_fiber_length_m, true},
      {"tendon_slack_length", &muscle.tendon_slack_length_m, true},
      {"pennation_angle_at_optimal", &muscle.pennation_angle_at_optimal_rad, false},
      {"max_contraction_velocity", &muscle.max_contraction_velocity, true},
      {"activation_time_constant", &muscle.activation_time_constant_s, true},
      {"deactivation_time_constant", &muscle.deactivation_time_constant_s, true},
      {"minimum_activation", &muscle.minimum_activation, true},
      {"FmaxTendonStrain", &muscle.FmaxTendonStrain, true},
      {"FmaxMuscleStrain", &muscle.FmaxMuscleStrain, true},
      {"KshapeActive", &muscle.KshapeActive, true},
      {"KshapePassive", &muscle.KshapePassive, true},
      {"Af", &muscle.Af, true},
      {"Flen", &muscle.Flen, true},
      {"fv_linear_extrap_threshold", &muscle.fv_linear_extrap_threshold, true},
      {"maximum_pennation_angle", &muscle.maximum_pennation_angle_rad, true},
      {"default_activation", &muscle.default_activation, false}};
  std::vector<std::string_view> read{"isDisabled",
                                     "appliesForce",
                                     "GeometryPath",
                                     "default_fiber_length",
                                     "ignore_tendon_compliance",
                                     "ignore_activation_dynamics"};
  for (const Figure& each : figures) {
    read.emplace_back(each.tag);
    *each.value = from.number(each.tag, *each.value);
    if (each.positive && !(*each.value > 0))
      from.need(each.tag).fail(fmt::format("{}: must be > 0", *each.value));
  }
  from.only(read);
  for (const char* ignores : {"ignore_tendon_compliance", "ignore_activation_dynamics"})
    if (from.flag(ignores, false)) from.need(ignores).fail("true is not understood");
  if (const OsimElement length = from.child("default_fiber_length"))
    muscle.default_fiber_length_m = length.number();

  const OsimElement path = from.need("GeometryPath");
  path.only({"PathPointSet", "PathWrapSet"});
  path.none_of({"PathWrapSet"});
  for (const OsimElement& point : path.objects("PathPointSet"))
    muscle.path.push_back(read_point(model, point));
  if (muscle.path.size() < 2) path.fail("has fewer than two points");
  model.muscles.push_back(std::move(muscle));
}

}  // namespace stride::osim
