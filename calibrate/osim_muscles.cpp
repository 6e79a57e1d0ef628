#include <algorithm>
#include <utility>

#include "calibrate/osim_parts.h"
#include "extract/error.h"

namespace stride {
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
    muscle.path.push_back(read_point(model, point));
  if (muscle.path.size() < 2) path.fail("has fewer than two points");
  model.muscles.push_back(std::move(muscle));
}

}  // namespace stride
