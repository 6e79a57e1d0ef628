#include "train/simulation/laws/path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/train/reference.h"

namespace stride {
namespace {

/// Lengths, speeds and moment arms of all muscles from first principles: frames by walking the
/// joints, moment arms as the power of a unit tension per unit speed.
class MusclePaths : public ::testing::Test {
 protected:
  struct Result {
    laws::PathSummary path;
    double arm[3] = {};  // hip, knee, ankle of the muscle's side
  };

  std::vector<laws::BodyFrame> frames(const std::vector<double>& q,
                                      const std::vector<double>& u) const {
    std::vector<laws::BodyFrame> all(model_.bodies.size());
    for (const osim::Joint& joint : model_.joints) {
      const laws::BodyFrame parent = joint.parent < 0 ? laws::BodyFrame{} : all[joint.parent];
      osim::Vec3 p = joint.location_in_parent_m;
      double angle = 0, omega = 0, dx = 0, dy = 0;
      if (joint.type == osim::Joint::Type::planar || joint.type == osim::Joint::Type::pin) {
        angle = q[joint.coordinates[0]];
        omega = u[joint.coordinates[0]];
      }
      if (joint.type == osim::Joint::Type::planar) {
        p[0] += q[joint.coordinates[1]], dx = u[joint.coordinates[1]];
        p[1] += q[joint.coordinates[2]], dy = u[joint.coordinates[2]];
      }
      if (joint.type == osim::Joint::Type::custom) {
        const int c = joint.coordinates[0];
        angle = q[c], omega = u[c];
        for (int axis = 0; axis < 2; ++axis) {
          const osim::SplineValue s = osim::evaluate_with_derivatives(
              osim::spline_coefficients(joint.transform[3 + axis].spline), q[c]);
          p[axis] += s.value;
          (axis == 0 ? dx : dy) = s.first * u[c];
        }
      }
      laws::BodyFrame& f = all[joint.child];
      const double ax = parent.cos * p[0] - parent.sin * p[1];
      const double ay = parent.sin * p[0] + parent.cos * p[1];
      f.origin_m = {parent.origin_m[0] + ax, parent.origin_m[1] + ay, parent.origin_m[2] + p[2]};
      f.cos = parent.cos * std::cos(angle) - parent.sin * std::sin(angle);
      f.sin = parent.sin * std::cos(angle) + parent.cos * std::sin(angle);
      f.vx_m_s = parent.vx_m_s - parent.omega_rad_s * ay + parent.cos * dx - parent.sin * dy;
      f.vy_m_s = parent.vy_m_s + parent.omega_rad_s * ax + parent.sin * dx + parent.cos * dy;
      f.omega_rad_s = parent.omega_rad_s + omega;
    }
    return all;
  }

  laws::PathSummary summary(int muscle, const std::vector<double>& q, const std::vector<double>& u,
                            std::vector<laws::PathNode>& nodes) const {
    nodes.assign(10, {});
    const laws::PathLaw path = laws::path_law(model_, model_.muscles[muscle]);
    const int count = laws::place_path(path, q.data(), u.data(), frames(q, u), nodes.data());
    nodes.resize(count);
    return laws::pull_path(nodes.data(), count);
  }

  Result result(int muscle, const std::vector<double>& q, const std::vector<double>& u) const {
    Result r;
    std::vector<laws::PathNode> nodes;
    r.path = summary(muscle, q, u, nodes);
    const std::string side =
        model_.muscles[muscle].name.substr(model_.muscles[muscle].name.size() - 2);
    const char* joints[] = {"hip_flexion", "knee_angle", "ankle_angle"};
    for (int j = 0; j < 3; ++j) {
      std::vector<double> unit(q.size(), 0);
      unit[model_.coordinate(joints[j] + side)] = 1;
      summary(muscle, q, unit, nodes);
      // The velocity of a moving point holds the part that its coordinate moves it by.
      for (const laws::PathNode& n : nodes) {
        for (int i = 0; i < 3; ++i) r.arm[j] += n.pull[i] * n.velocity_m_s[i];
      }
    }
    return r;
  }

  std::vector<double> defaults() const {
    std::vector<double> q;
    for (const osim::Coordinate& c : model_.coordinates) q.push_back(c.default_value);
    return q;
  }

  osim::Model model_ = osim::load_osim(osim::default_model_file());
};

TEST_F(MusclePaths, AreOpenSimsInRandomPoses) {
  const Reference poses("static_poses.csv"), r("static_muscle.csv");
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    const std::size_t pose = static_cast<std::size_t>(r.number(i, "pose_id"));
    std::vector<double> q = defaults(), u(q.size(), 0);
    for (std::size_t c = 0; c < q.size(); ++c) {
      const std::string& name = model_.coordinates[c].name;
      if (name == "lumbar_extension") continue;
      q[c] = poses.number(pose, name + "_rad_or_m");
      u[c] = poses.number(pose, name + "_vel_rad_s_or_m_s");
    }
    const Result m = result(model_.muscle(r.text(i, "muscle")), q, u);
    ASSERT_TRUE(close(m.path.length_m, r.number(i, "mtu_length_m"), 1e-11)) << i;
    ASSERT_TRUE(close(m.path.speed_m_s, r.number(i, "mtu_lengthening_speed_m_s"), 1e-10, 1e-11));
    ASSERT_TRUE(close(m.arm[0], r.number(i, "ma_hip_m"), 1e-9, 1e-12)) << i;
    ASSERT_TRUE(close(m.arm[1], r.number(i, "ma_knee_m"), 1e-9, 1e-12)) << i;
    ASSERT_TRUE(close(m.arm[2], r.number(i, "ma_ankle_m"), 1e-9, 1e-12)) << i;
  }
}

TEST_F(MusclePaths, AreOpenSimsThroughEverySwitchAndBeyondTheKneesRange) {
  const Reference r("static_sweep.csv");
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    const std::string& swept = r.text(i, "swept_coord");
    std::vector<double> q(model_.coordinates.size(), 0), u(q.size(), 0);
    // The pose around which the recording swept one joint at a time.
    q[model_.coordinate("hip_flexion_r")] = 0.1;
    q[model_.coordinate("knee_angle_r")] = -0.1;
    q[model_.coordinate("ankle_angle_r")] = 0.05;
    q[model_.coordinate(swept)] = r.number(i, "value_rad");
    const Result m = result(model_.muscle(r.text(i, "muscle")), q, u);
    const int joint = swept[0] == 'h' ? 0 : swept[0] == 'k' ? 1 : 2;
    ASSERT_TRUE(close(m.path.length_m, r.number(i, "mtu_length_m"), 1e-11)) << i;
    ASSERT_TRUE(close(m.arm[joint], r.number(i, "ma_about_swept_m"), 1e-9, 1e-12)) << i << swept;
  }
}

}  // namespace
}  // namespace stride
