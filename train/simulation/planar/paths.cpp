#include "train/simulation/planar/paths.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "extract/io/error.h"
#include "train/simulation/laws/path.h"

namespace stride::planar {
namespace {

/// Builds the paths of one muscle after the other, right and left leg together.
class PathBuilder {
 public:
  PathBuilder(const osim::Model& model, const simulation::RunnerLayout& layout,
              const JointCoordinates& joints, PlanarModel& planar)
      : model_(model), layout_(layout), joints_(joints), planar_(planar) {}

  void add_muscle(int m) {
    muscle_ = m;
    for (int leg = 0; leg < kLegs; ++leg) {
      law_[leg] = laws::path_law(
          model_, model_.muscles[layout_.muscle[m + leg * PlanarModel::kMusclesOfLeg]]);
    }
    check_symmetry();
    PlanarModel::MusclePath path;
    path.first_joint = PlanarModel::kJoints;
    path.last_joint = -1;
    std::vector<int> bit(law_[0].points.size(), 0);
    for (std::size_t p = 0; p < law_[0].points.size(); ++p) {
      if (law_[0].points[p].kind != osim::PathPoint::Kind::conditional) continue;
      need(path.conditions.size() < PlanarModel::kMostConditions,
           "it has more than two conditional points");
      path.conditions.push_back(condition(p, 1 << path.conditions.size()));
      bit[p] = path.conditions.back().bit;
    }
    for (int present = 0; present < 1 << path.conditions.size(); ++present) {
      std::array<PlanarModel::Path, kLegs> variant;
      for (int leg = 0; leg < kLegs; ++leg) variant[leg] = build_path(leg, bit, present, path);
      path.variants[present] = variant;
    }
    planar_.paths[m] = path;
  }

  /// The moving points' functions of the knee angle, in the order of PlanarModel::Point::function.
  std::array<std::vector<osim::SplineCoefficients>, kLegs> functions;

 private:
  std::string name() const { return model_.muscles[layout_.muscle[muscle_]].name; }

  void need(bool condition, const char* reason) const {
    require(condition,
            "model {}, muscle {}: the planar engine cannot represent it: {}; use --engine simbody",
            model_.name, name(), reason);
  }

  /// The segment of a path point, and where its body is in the segment.
  PlanarModel::Place place(int leg, std::size_t p) const {
    const int body = law_[leg].points[p].body;
    need(body >= 0, "its path has a point on the ground");
    return planar_.bodies[body];
  }

  /// Both legs go through the same arithmetic, so their paths must have the same structure.
  void check_symmetry() const {
    need(law_[0].points.size() == law_[1].points.size(), "the other leg's path has other points");
    for (std::size_t p = 0; p < law_[0].points.size(); ++p) {
      need(law_[0].points[p].kind == law_[1].points[p].kind &&
               place(0, p).segment == place(1, p).segment,
           "the other leg's path has other points");
      for (int leg = 0; leg < kLegs; ++leg) {
        need(place(leg, p).leg < 0 || place(leg, p).leg == leg,
             "its path runs to the other leg, or the muscles are not listed leg by leg");
      }
    }
  }

  /// The range of a joint angle in which a conditional point is present.
  PlanarModel::Condition condition(std::size_t p, int bit) const {
    PlanarModel::Condition c;
    c.bit = bit;
    for (int leg = 0; leg < kLegs; ++leg) {
      const laws::PathLaw::Point& point = law_[leg].points[p];
      for (int joint = 0; joint < PlanarModel::kJoints; ++joint) {
        if (joints_[joint][leg] == point.coordinate) c.joint = joint;
      }
      need(c.joint >= 0 && joints_[c.joint][leg] == point.coordinate,
           "a conditional point depends on another coordinate than a joint of its leg");
      c.range_min[leg] = point.range_min;
      c.range_max[leg] = point.range_max;
    }
    return c;
  }

  /// The path with the conditional points whose bits are in `present`.
  PlanarModel::Path build_path(int leg, const std::vector<int>& bit, int present,
                               PlanarModel::MusclePath& muscle) {
    std::vector<std::size_t> order;
    for (std::size_t p = 0; p < bit.size(); ++p) {
      if ((bit[p] & present) == bit[p]) order.push_back(p);
    }
    PlanarModel::Path path;
    int count = 0;
    for (std::size_t i = 0; i + 1 < order.size(); ++i) {
      const std::size_t from = order[i], to = order[i + 1];
      if (place(leg, from).segment == place(leg, to).segment) {
        path.constant_m += distance(leg, from, to);
      } else {
        need(count < 2, "its path crosses between segments more than twice");
        path.pieces[count++] = piece(leg, from, to, muscle);
      }
    }
    need(count > 0, "its path crosses no joint");
    muscle.pieces = std::max(muscle.pieces, count);
    if (count == 1) {  // a second piece of weight 0 and length not 0, which costs no branch
      path.pieces[1].inner = path.pieces[0].inner;
      path.pieces[1].outer = path.pieces[0].outer;
      path.pieces[1].dz_m = 1;
    }
    return path;
  }

  /// The piece between two points of different segments, `outer` the one further from the pelvis.
  /// It crosses every joint between them and contributes to their moment arms, README (7).
  PlanarModel::Piece piece(int leg, std::size_t from, std::size_t to,
                           PlanarModel::MusclePath& muscle) {
    if (place(0, from).segment > place(0, to).segment) std::swap(from, to);
    PlanarModel::Piece piece;
    piece.inner = point(from, muscle);
    piece.outer = point(to, muscle);
    piece.weight = 1;
    piece.dz_m = planar_.points[piece.outer].z_m[leg] - planar_.points[piece.inner].z_m[leg];
    if (muscle.moving >= 0) {
      piece.moves = piece.outer == muscle.moving ? 1 : piece.inner == muscle.moving ? -1 : 0;
    }
    for (int joint = place(0, from).segment; joint < place(0, to).segment; ++joint) {
      piece.crosses[joint] = 1;
      muscle.first_joint = std::min(muscle.first_joint, joint);
      muscle.last_joint = std::max(muscle.last_joint, joint);
    }
    return piece;
  }

  /// Position of a fixed point in its segment, m.
  osim::Vec3 location(int leg, std::size_t p) const {
    const PlanarModel::Place at = place(leg, p);
    const osim::Vec3& v = law_[leg].points[p].location_m;
    const double c = std::cos(at.angle_rad), s = std::sin(at.angle_rad);
    return {at.x_m + c * v[0] - s * v[1], at.y_m + s * v[0] + c * v[1], at.z_m + v[2]};
  }

  /// Length of a piece within a segment, m.
  double distance(int leg, std::size_t p, std::size_t q) const {
    need(law_[leg].points[p].kind != osim::PathPoint::Kind::moving &&
             law_[leg].points[q].kind != osim::PathPoint::Kind::moving,
         "a moving point has a neighbour on its own segment");
    const osim::Vec3 a = location(leg, p), b = location(leg, q);
    return std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
  }

  /// Index of the point in PlanarModel::points; adds it at its first use.
  int point(std::size_t p, PlanarModel::MusclePath& muscle) {
    const bool moves = law_[0].points[p].kind == osim::PathPoint::Kind::moving;
    const auto known = known_.find({muscle_, p});
    if (known != known_.end()) return known->second;
    PlanarModel::Point point;
    point.segment = place(0, p).segment;
    for (int leg = 0; leg < kLegs; ++leg) {
      if (moves) {
        point.function = add_functions(leg, p);
        point.z_m[leg] = place(leg, p).z_m + law_[leg].points[p].location[2].y[0];
      } else {
        const osim::Vec3 at = location(leg, p);
        point.x_m[leg] = at[0], point.y_m[leg] = at[1], point.z_m[leg] = at[2];
      }
    }
    need(planar_.points.size() < PlanarModel::kMostPoints, "the paths have more points than fit");
    planar_.points.push_back(point);
    if (moves) {
      need(muscle.moving < 0, "it has more than one moving point");
      muscle.moving = static_cast<int>(planar_.points.size()) - 1;
    }
    return known_[{muscle_, p}] = static_cast<int>(planar_.points.size()) - 1;
  }

  /// Adds x and y of a moving point as functions of the knee angle; returns the index of x.
  int add_functions(int leg, std::size_t p) {
    const laws::PathLaw::Point& moving = law_[leg].points[p];
    const PlanarModel::Place at = place(leg, p);
    need(moving.coordinate == joints_[1][leg], "a moving point does not move with the knee");
    need(at.angle_rad == 0, "a moving point is on a body turned against its segment");
    const std::vector<double>& z = moving.location[2].y;
    for (const double value : z) need(value == z[0], "a moving point moves along z");
    std::vector<osim::SplineCoefficients>& f = functions[leg];
    const int index = 2 + static_cast<int>(f.size());
    need(index + 2 <= PlanarModel::kFunctions, "the model has more than three moving points a leg");
    need(f.empty() || (planar_.knee_range_min[leg] == moving.range_min &&
                       planar_.knee_range_max[leg] == moving.range_max),
         "moving points have different ranges");
    planar_.knee_range_min[leg] = moving.range_min;
    planar_.knee_range_max[leg] = moving.range_max;
    for (int axis = 0; axis < 2; ++axis) {
      f.push_back(moving.location[axis]);
      for (double& y : f.back().y) y += axis == 0 ? at.x_m : at.y_m;
    }
    return index;
  }

  const osim::Model& model_;
  const simulation::RunnerLayout& layout_;
  const JointCoordinates& joints_;
  PlanarModel& planar_;
  int muscle_ = 0;
  std::array<laws::PathLaw, kLegs> law_;
  std::map<std::pair<int, std::size_t>, int> known_;
};

/// Coefficients of the cubic of `f` at the angle `inside`, in powers of (angle - origin).
std::array<double, 4> cubic_at(const osim::SplineCoefficients& f, double inside, double origin) {
  const int i = osim::spline_interval(f, inside);
  const int k = std::max(i, 0);
  const bool straight = i < 0 || i + 1 == static_cast<int>(f.x.size());
  const double b = f.b[k], c = straight ? 0 : f.c[k], d = straight ? 0 : f.d[k];
  const double h = origin - f.x[k];
  return {f.y[k] + h * (b + h * (c + h * d)), b + h * (2 * c + 3 * h * d), c + 3 * h * d, d};
}

/// All functions of a knee angle on their common knots, so that one search finds all cubics.
PlanarModel::KneeTable knee_table(const std::vector<osim::SplineCoefficients>& functions) {
  PlanarModel::KneeTable table;
  for (const osim::SplineCoefficients& f : functions) {
    if (f.x.size() > 1) table.knots.insert(table.knots.end(), f.x.begin(), f.x.end());
  }
  std::sort(table.knots.begin(), table.knots.end());
  table.knots.erase(std::unique(table.knots.begin(), table.knots.end()), table.knots.end());
  const std::vector<double>& x = table.knots;
  for (std::size_t i = 0; i <= x.size(); ++i) {
    PlanarModel::KneeTable::Cubics cubics{};
    double inside = 0;
    if (!x.empty()) {
      cubics.origin = i == 0 ? x[0] : x[i - 1];
      inside = i == 0 ? x[0] - 1 : i == x.size() ? x.back() + 1 : 0.5 * (x[i - 1] + x[i]);
    }
    for (std::size_t n = 0; n < functions.size(); ++n) {
      const std::array<double, 4> p = cubic_at(functions[n], inside, cubics.origin);
      cubics.a[n / 4][n % 4] = p[0], cubics.b[n / 4][n % 4] = p[1];
      cubics.c[n / 4][n % 4] = p[2], cubics.d[n / 4][n % 4] = p[3];
    }
    table.cubics.push_back(cubics);
  }
  return table;
}

}  // namespace

void build_planar_paths(const osim::Model& model, const simulation::RunnerLayout& layout,
                        const JointCoordinates& joints,
                        const std::array<osim::SplineCoefficients, 2>& knee_x,
                        const std::array<osim::SplineCoefficients, 2>& knee_y,
                        PlanarModel& planar) {
  PathBuilder builder(model, layout, joints, planar);
  for (int m = 0; m < PlanarModel::kMusclesOfLeg; ++m) builder.add_muscle(m);
  for (int leg = 0; leg < kLegs; ++leg) {
    std::vector<osim::SplineCoefficients> functions = {knee_x[leg], knee_y[leg]};
    functions.insert(functions.end(), builder.functions[leg].begin(), builder.functions[leg].end());
    planar.knee[leg] = knee_table(functions);
  }
}

}  // namespace stride::planar
