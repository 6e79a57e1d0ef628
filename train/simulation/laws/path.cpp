#include "train/simulation/laws/path.h"

#include <algorithm>
#include <cmath>

#include "extract/io/error.h"

namespace stride::laws {
namespace {

constexpr double kConditionSlack = 1e-5;  // rad, of OpenSim's ConditionalPathPoint

PathLaw::Point moving_point(const osim::Model& model, const osim::PathPoint& point) {
  PathLaw::Point law;
  law.coordinate = point.location_coordinate[0];
  for (int i = 0; i < 3; ++i) {
    require(point.location_coordinate[i] == law.coordinate,
            "path point {}: x, y and z must move with the same coordinate, as OpenSim requires",
            point.name);
    law.location[i] = osim::spline_coefficients(point.location[i]);
  }
  require(law.coordinate >= 0, "path point {}: a moving path point needs a coordinate", point.name);
  law.range_min = model.coordinates[law.coordinate].range_min;
  law.range_max = model.coordinates[law.coordinate].range_max;
  return law;
}

osim::Vec3 rotate(const BodyFrame& f, const osim::Vec3& v) {
  return {f.cos * v[0] - f.sin * v[1], f.sin * v[0] + f.cos * v[1], v[2]};
}

}  // namespace

PathLaw path_law(const osim::Model& model, const osim::Muscle& muscle) {
  PathLaw path;
  for (const osim::PathPoint& point : muscle.path) {
    PathLaw::Point law;
    if (point.kind == osim::PathPoint::Kind::moving) law = moving_point(model, point);
    if (point.kind == osim::PathPoint::Kind::conditional) {
      law.coordinate = point.coordinate;
      law.range_min = point.range_min - kConditionSlack;
      law.range_max = point.range_max + kConditionSlack;
    }
    law.kind = point.kind;
    law.body = point.body;
    law.location_m = point.location_m;
    path.points.push_back(law);
  }
  return path;
}

int place_path(const PathLaw& path, const double* q, const double* u,
               const std::vector<BodyFrame>& frames, PathNode* nodes) {
  static const BodyFrame ground;
  int count = 0;
  for (const PathLaw::Point& point : path.points) {
    PathNode node;
    osim::Vec3 location = point.location_m;
    const double angle = point.coordinate < 0 ? 0 : q[point.coordinate];
    if (point.kind == osim::PathPoint::Kind::conditional &&
        (angle < point.range_min || angle > point.range_max)) {
      continue;
    }
    const BodyFrame& frame = point.body < 0 ? ground : frames[point.body];
    if (point.kind == osim::PathPoint::Kind::moving) {
      node.coordinate = point.coordinate;
      osim::Vec3 derivative;
      for (int i = 0; i < 3; ++i) {
        const double clamped = std::clamp(angle, point.range_min, point.range_max);
        location[i] = osim::evaluate(point.location[i], clamped);
        derivative[i] = osim::evaluate_with_derivatives(point.location[i], angle).first;
      }
      node.derivative = rotate(frame, derivative);
    }
    node.body = point.body;
    const osim::Vec3 arm = rotate(frame, location);
    const double speed = node.coordinate < 0 ? 0 : u[node.coordinate];
    node.velocity_m_s = {frame.vx_m_s - frame.omega_rad_s * arm[1] + node.derivative[0] * speed,
                         frame.vy_m_s + frame.omega_rad_s * arm[0] + node.derivative[1] * speed,
                         node.derivative[2] * speed};
    for (int i = 0; i < 3; ++i) node.position_m[i] = frame.origin_m[i] + arm[i];
    nodes[count++] = node;
  }
  return count;
}

PathSummary pull_path(PathNode* nodes, int count) {
  PathSummary sum;
  for (int n = 0; n + 1 < count; ++n) {
    PathNode &from = nodes[n], &to = nodes[n + 1];
    osim::Vec3 d;
    for (int i = 0; i < 3; ++i) d[i] = to.position_m[i] - from.position_m[i];
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    sum.length_m += length;
    for (int i = 0; i < 3; ++i) {
      const double direction = d[i] / length;
      sum.speed_m_s += direction * (to.velocity_m_s[i] - from.velocity_m_s[i]);
      if (from.body == to.body) continue;
      from.pull[i] += direction;
      to.pull[i] -= direction;
    }
  }
  return sum;
}

}  // namespace stride::laws
