#include "train/simulation/simbody_engine.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include "extract/error.h"
#include "train/simulation/contact.h"
#include "train/simulation/integrator.h"
#include "train/simulation/limit.h"
#include "train/simulation/muscle.h"
#include "train/simulation/path.h"
#include "train/simulation/simbody_skeleton.h"

namespace stride {
namespace {

constexpr int kStates = 2 * kCoordinates + 2 * kMuscles;  // q, u, activations, fibre lengths
using States = std::array<double, kStates>;
constexpr int kU = kCoordinates, kActivation = 2 * kCoordinates, kFiber = kActivation + kMuscles;

class SimbodyEngine final : public Engine {
 public:
  SimbodyEngine(const Model& model, const EngineOptions& options);

  std::string_view name() const override { return "simbody"; }
  const Model& model() const override { return model_; }
  void set_state(const RunnerState& state) override;
  const RunnerState& state() const override { return state_; }
  void set_strength(int muscle, double factor) override { muscles_[muscle].strength = factor; }
  void set_obstacles(const std::vector<Obstacle>& obstacles) override;
  void equilibrate_fibers() override;
  AdvanceReport advance(const Excitations& excitations, double duration_s) override;
  RunnerDerivative derivative(const Excitations& excitations) override;
  RunnerKinematics kinematics() override;
  std::array<double, kCoordinates * kCoordinates> mass_matrix() override;

 private:
  struct MuscleOfRunner {
    MuscleLaw law;
    PathLaw path;
    double strength = 1;
    double length_m = 0, tendon_force_N = 0, fiber_velocity_m_s = 0;  // of the last evaluation
  };
  struct Foot {
    ContactLaw law;
    double floor_m = 0;
    std::vector<int> spheres;  // indices into Model::spheres
    Planar reaction_N;         // of the last evaluation
  };
  struct Stop {
    LimitLaw law;
    int coordinate = 0;    // of the runner
    double torque_Nm = 0;  // of the last evaluation
  };
  struct Ball {
    Obstacle obstacle;
    ContactLaw law;
  };

  void place(const double* q, const double* u);
  void push(int body, const Vec3& point, double fx, double fy);
  Vec3 point_on(int body, const Vec3& location) const;
  Planar velocity_of(int body, const Vec3& point) const;
  void add_gravity();
  void add_muscles(const States& y);
  void add_foot(Foot& foot);
  void add_obstacle(const Ball& ball);
  void add_forces(const States& y);
  void evaluate(const States& y, const Excitations& excitations, States& rate);
  States pack() const;
  void unpack(const States& y);

  Model model_;
  EngineOptions options_;
  RunnerLayout layout_;
  SimbodySkeleton skeleton_;
  std::vector<MuscleOfRunner> muscles_;
  std::vector<Foot> feet_;
  std::vector<Stop> stops_;
  std::vector<Ball> balls_;
  std::vector<PathNode> nodes_;  // room for the longest path
  std::vector<int> mobility_;    // Simbody's, of each of Model::coordinates; -1 if it is locked
  MersonIntegrator<kStates> integrator_;

  RunnerState state_;
  // Of the last place(): all coordinates of the model, every body, and where each of Simbody's
  // bodies has its origin.
  std::vector<double> q_, u_;
  std::vector<BodyFrame> frames_;
  std::vector<SimTK::Vec3> origins_;
  // Of the last add_forces(), on each of Simbody's bodies: what moves it in the plane.
  struct Wrench {
    double torque = 0, fx = 0, fy = 0;  // about the body's origin
  };
  std::vector<Wrench> wrenches_;
  SimTK::Vector mobility_forces_, udot_;
  SimTK::Vector_<SimTK::SpatialVec> body_forces_, accelerations_;
};

SimbodyEngine::SimbodyEngine(const Model& model, const EngineOptions& options)
    : model_(model),
      options_(options),
      layout_(runner_layout(model)),
      skeleton_(model_, layout_),
      state_(default_state(model)),
      frames_(model.bodies.size()) {
  for (const Coordinate& each : model_.coordinates) {
    q_.push_back(each.default_value);
    u_.push_back(0);
    mobility_.push_back(-1);
  }
  for (int i = 0; i < kCoordinates; ++i) mobility_[layout_.coordinate[i]] = skeleton_.slot[i];
  std::size_t longest = 0;
  for (int i : layout_.muscle) {
    muscles_.push_back({MuscleLaw(model_.muscles[i]), path_law(model_, model_.muscles[i])});
    longest = std::max(longest, model_.muscles[i].path.size());
  }
  nodes_.resize(longest);
  for (const ContactForce& each : model_.contacts) {
    require(!options_.drop_contacts || each.spheres.size() == 2,
            "contact {}: has {} spheres; the rules nips2017 are known for two; use the rules clean",
            each.name, each.spheres.size());
    feet_.push_back({contact_law(each), model_.planes[each.plane].height_m, each.spheres, {}});
  }
  for (const CoordinateLimit& each : model_.limits) {
    const auto at =
        std::find(layout_.coordinate.begin(), layout_.coordinate.end(), each.coordinate);
    if (at == layout_.coordinate.end()) continue;  // it limits a locked coordinate
    stops_.push_back({limit_law(each, model_.coordinates[each.coordinate].rotational),
                      static_cast<int>(at - layout_.coordinate.begin())});
  }
  mobility_forces_.resize(kCoordinates);
  udot_.resize(kCoordinates);
  body_forces_.resize(skeleton_.matter.getNumBodies());
  accelerations_.resize(skeleton_.matter.getNumBodies());
  origins_.resize(skeleton_.matter.getNumBodies(), SimTK::Vec3(0));
  wrenches_.resize(skeleton_.matter.getNumBodies());
}

void SimbodyEngine::set_state(const RunnerState& state) {
  state_ = state;
  integrator_.restart();
}

void SimbodyEngine::set_obstacles(const std::vector<Obstacle>& obstacles) {
  balls_.clear();
  for (Obstacle each : obstacles) {
    if (options_.nominal_obstacles) each.radius_m = kNominalObstacleRadius_m;
    balls_.push_back({each, obstacle_law(each.radius_m)});
  }
}

void SimbodyEngine::equilibrate_fibers() {
  place(state_.q.data(), state_.u.data());
  for (int i = 0; i < kMuscles; ++i) {
    const int count = place_path(muscles_[i].path, q_.data(), u_.data(), frames_, nodes_.data());
    state_.fiber_length_m[i] = equilibrium_fiber_length(muscles_[i].law, state_.activation[i],
                                                        pull_path(nodes_.data(), count).length_m);
  }
  integrator_.restart();
}

/// Moves Simbody's bodies to q and u (in the runner's order) and reads every body's frame.
void SimbodyEngine::place(const double* q, const double* u) {
  SimTK::State& s = skeleton_.state;
  double* all_q = &s.updQ()[0];
  double* all_u = &s.updU()[0];
  for (int i = 0; i < kCoordinates; ++i) {
    all_q[skeleton_.slot[i]] = q_[layout_.coordinate[i]] = q[i];
    all_u[skeleton_.slot[i]] = u_[layout_.coordinate[i]] = u[i];
  }
  skeleton_.system.realize(s, SimTK::Stage::Velocity);
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const SimbodySkeleton::Placement& at = skeleton_.bodies[i];
    BodyFrame& frame = frames_[i];
    if (at.leader < 0) {
      const SimTK::MobilizedBody& root = skeleton_.matter.getMobilizedBody(at.root);
      const SimTK::Transform& x = root.getBodyTransform(s);
      const SimTK::SpatialVec& v = root.getBodyVelocity(s);
      origins_[at.root] = x.p();
      frame = {{x.p()[0], x.p()[1], x.p()[2]}, x.R()[0][0], x.R()[1][0], v[1][0], v[1][1], v[0][2]};
      continue;
    }
    const BodyFrame& leader = frames_[at.leader];
    const double x = leader.cos * at.x - leader.sin * at.y,
                 y = leader.sin * at.x + leader.cos * at.y;
    frame.origin_m = {leader.origin_m[0] + x, leader.origin_m[1] + y, leader.origin_m[2] + at.z};
    frame.cos = leader.cos * at.cos - leader.sin * at.sin;
    frame.sin = leader.sin * at.cos + leader.cos * at.sin;
    frame.vx_m_s = leader.vx_m_s - leader.omega_rad_s * y;
    frame.vy_m_s = leader.vy_m_s + leader.omega_rad_s * x;
    frame.omega_rad_s = leader.omega_rad_s;
  }
}

/// A force at a point of the ground's axes on a body; the ground (-1) takes what it gets. What
/// leaves the plane is borne by the joints.
void SimbodyEngine::push(int body, const Vec3& point, double fx, double fy) {
  if (body < 0) return;
  const SimTK::MobilizedBodyIndex root = skeleton_.bodies[body].root;
  const SimTK::Vec3& origin = origins_[root];
  Wrench& sum = wrenches_[root];
  sum.torque += (point[0] - origin[0]) * fy - (point[1] - origin[1]) * fx;
  sum.fx += fx;
  sum.fy += fy;
}

/// A point fixed in a body, in the ground.
Vec3 SimbodyEngine::point_on(int body, const Vec3& location) const {
  if (body < 0) return location;
  const BodyFrame& f = frames_[body];
  return {f.origin_m[0] + f.cos * location[0] - f.sin * location[1],
          f.origin_m[1] + f.sin * location[0] + f.cos * location[1], f.origin_m[2] + location[2]};
}

/// Velocity of the body's material that is at a point of the ground's axes.
Planar SimbodyEngine::velocity_of(int body, const Vec3& point) const {
  if (body < 0) return {};
  const BodyFrame& f = frames_[body];
  return {f.vx_m_s - f.omega_rad_s * (point[1] - f.origin_m[1]),
          f.vy_m_s + f.omega_rad_s * (point[0] - f.origin_m[0])};
}

void SimbodyEngine::add_gravity() {
  for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
    const Body& body = model_.bodies[i];
    push(static_cast<int>(i), point_on(static_cast<int>(i), body.mass_center_m),
         body.mass_kg * model_.gravity_m_s2[0], body.mass_kg * model_.gravity_m_s2[1]);
  }
}

void SimbodyEngine::add_muscles(const States& y) {
  for (int i = 0; i < kMuscles; ++i) {
    MuscleOfRunner& muscle = muscles_[i];
    const int count = place_path(muscle.path, q_.data(), u_.data(), frames_, nodes_.data());
    muscle.length_m = pull_path(nodes_.data(), count).length_m;
    const MuscleForces forces =
        muscle_forces(muscle.law, y[kActivation + i], y[kFiber + i], muscle.length_m);
    const double tension = muscle.strength * forces.tendon_force_N;
    muscle.tendon_force_N = tension;
    muscle.fiber_velocity_m_s = forces.fiber_velocity_m_s;
    for (int n = 0; n < count; ++n) {
      const PathNode& node = nodes_[n];
      push(node.body, node.position_m, tension * node.pull[0], tension * node.pull[1]);
      if (node.coordinate >= 0 && mobility_[node.coordinate] >= 0)
        mobility_forces_[mobility_[node.coordinate]] += tension * pull_on_coordinate(node);
    }
  }
}

void SimbodyEngine::add_foot(Foot& foot) {
  foot.reaction_N = {};
  const auto centre_of = [&](int i) {
    const ContactSphere& sphere = model_.spheres[i];
    return point_on(sphere.body, sphere.location_m);
  };
  std::size_t first = 0;
  if (options_.drop_contacts) {
    const ContactSphere &a = model_.spheres[foot.spheres[0]], &b = model_.spheres[foot.spheres[1]];
    first = first_sphere_is_swept_first(centre_of(foot.spheres[0]), a.radius_m,
                                        centre_of(foot.spheres[1]), b.radius_m)
                ? 0
                : 1;
  }
  for (std::size_t n = 0; n < foot.spheres.size(); ++n) {
    const int i = foot.spheres[(n + first) % foot.spheres.size()];
    const ContactSphere& sphere = model_.spheres[i];
    Vec3 point = centre_of(i);
    const double depth = sphere.radius_m - (point[1] - foot.floor_m);
    if (depth <= 0) continue;
    point[1] = foot.floor_m - depth / 2;
    const Planar velocity = velocity_of(sphere.body, point);
    const double normal = normal_force(foot.law, sphere.radius_m, depth, -velocity.y);
    if (normal <= 0 && options_.drop_contacts) return;
    if (normal <= 0) continue;
    const double friction = friction_force(foot.law, normal, std::abs(velocity.x));
    const double along = -std::copysign(friction, velocity.x);
    push(sphere.body, point, along, normal);
    foot.reaction_N.x += along;
    foot.reaction_N.y += normal;
  }
}

void SimbodyEngine::add_obstacle(const Ball& ball) {
  const Vec3 middle{ball.obstacle.x_m, ball.obstacle.y_m, 0};
  for (const ContactSphere& sphere : model_.spheres) {
    const Vec3 centre = point_on(sphere.body, sphere.location_m);
    const Vec3 away{centre[0] - middle[0], centre[1] - middle[1], centre[2] - middle[2]};
    const double distance = std::sqrt(away[0] * away[0] + away[1] * away[1] + away[2] * away[2]);
    const double depth = ball.obstacle.radius_m + sphere.radius_m - distance;
    if (depth <= 0 || distance <= 0) continue;
    Vec3 normal, point;
    for (int k = 0; k < 3; ++k) {
      normal[k] = away[k] / distance;
      point[k] = middle[k] + normal[k] * (ball.obstacle.radius_m - depth / 2);
    }
    const Planar velocity = velocity_of(sphere.body, point);
    const double approach = -(velocity.x * normal[0] + velocity.y * normal[1]);
    const double radius =
        ball.obstacle.radius_m * sphere.radius_m / (ball.obstacle.radius_m + sphere.radius_m);
    const double force = std::max(normal_force(ball.law, radius, depth, approach), 0.0);
    push(sphere.body, point, force * normal[0], force * normal[1]);
  }
}

void SimbodyEngine::add_forces(const States& y) {
  mobility_forces_.setToZero();
  std::fill(wrenches_.begin(), wrenches_.end(), Wrench{});
  add_gravity();
  add_muscles(y);
  for (Foot& foot : feet_) add_foot(foot);
  for (const Ball& ball : balls_) add_obstacle(ball);
  for (Stop& stop : stops_) {
    stop.torque_Nm = limit_force(stop.law, y[stop.coordinate], y[kU + stop.coordinate]);
    mobility_forces_[skeleton_.slot[stop.coordinate]] += stop.torque_Nm;
  }
}

void SimbodyEngine::evaluate(const States& y, const Excitations& excitations, States& rate) {
  place(y.data(), y.data() + kU);
  add_forces(y);
  SimTK::SpatialVec* on_bodies = &body_forces_[0];
  for (std::size_t i = 0; i < wrenches_.size(); ++i)
    on_bodies[i] = {SimTK::Vec3(0, 0, wrenches_[i].torque),
                    SimTK::Vec3(wrenches_[i].fx, wrenches_[i].fy, 0)};
  skeleton_.system.realize(skeleton_.state, SimTK::Stage::Dynamics);
  skeleton_.matter.calcAccelerationIgnoringConstraints(skeleton_.state, mobility_forces_,
                                                       body_forces_, udot_, accelerations_);
  const double* udot = &udot_[0];
  for (int i = 0; i < kCoordinates; ++i) {
    rate[i] = y[kU + i];
    rate[kU + i] = udot[skeleton_.slot[i]];
  }
  for (int i = 0; i < kMuscles; ++i) {
    rate[kActivation + i] = activation_rate(muscles_[i].law, y[kActivation + i], excitations[i]);
    rate[kFiber + i] = muscles_[i].fiber_velocity_m_s;
  }
}

States SimbodyEngine::pack() const {
  States y;
  std::copy(state_.q.begin(), state_.q.end(), y.begin());
  std::copy(state_.u.begin(), state_.u.end(), y.begin() + kU);
  std::copy(state_.activation.begin(), state_.activation.end(), y.begin() + kActivation);
  std::copy(state_.fiber_length_m.begin(), state_.fiber_length_m.end(), y.begin() + kFiber);
  return y;
}

void SimbodyEngine::unpack(const States& y) {
  std::copy_n(y.begin(), kCoordinates, state_.q.begin());
  std::copy_n(y.begin() + kU, kCoordinates, state_.u.begin());
  std::copy_n(y.begin() + kActivation, kMuscles, state_.activation.begin());
  std::copy_n(y.begin() + kFiber, kMuscles, state_.fiber_length_m.begin());
}

AdvanceReport SimbodyEngine::advance(const Excitations& excitations, double duration_s) {
  States y = pack();
  // The error of a fibre counts against its optimal length; angles, metres and speeds count as
  // they are.
  const auto error_of = [&](const States& difference) {
    double largest = 0;
    for (int i = 0; i < kStates; ++i) {
      const double unit = i < kFiber ? 1 : muscles_[i - kFiber].law.optimal_length_m;
      largest = std::max(largest, std::abs(difference[i]) / unit);
    }
    return largest;
  };
  const auto rate = [&](const States& at, States& result) {
    if (std::all_of(at.begin(), at.end(), [](double x) { return std::isfinite(x); }))
      evaluate(at, excitations, result);
    else
      result.fill(std::nan(""));
  };
  AdvanceReport report;
  try {
    report = integrator_.advance(y, duration_s, options_, rate, error_of);
  } catch (const std::exception& simbodys) {  // its own complaint about a state
    report.ok = false;
    report.failure = simbodys.what();
  }
  unpack(y);
  if (report.ok) state_.time_s += duration_s;
  if (!report.ok) integrator_.restart();
  return report;
}

RunnerDerivative SimbodyEngine::derivative(const Excitations& excitations) {
  States rate;
  evaluate(pack(), excitations, rate);
  RunnerDerivative result;
  std::copy_n(rate.begin() + kU, kCoordinates, result.udot.begin());
  std::copy_n(rate.begin() + kActivation, kMuscles, result.activation_rate.begin());
  std::copy_n(rate.begin() + kFiber, kMuscles, result.fiber_velocity_m_s.begin());
  return result;
}

RunnerKinematics SimbodyEngine::kinematics() {
  place(state_.q.data(), state_.u.data());
  add_forces(pack());
  RunnerKinematics k;
  double mass = 0;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const BodyFrame& frame = frames_[i];
    k.bodies.push_back({{frame.origin_m[0], frame.origin_m[1]},
                        {frame.vx_m_s, frame.vy_m_s},
                        std::atan2(frame.sin, frame.cos),
                        frame.omega_rad_s});
    const Body& body = model_.bodies[i];
    const Vec3 com = point_on(static_cast<int>(i), body.mass_center_m);
    const Planar velocity = velocity_of(static_cast<int>(i), com);
    mass += body.mass_kg;
    k.com.x += body.mass_kg * com[0], k.com.y += body.mass_kg * com[1];
    k.com_velocity.x += body.mass_kg * velocity.x, k.com_velocity.y += body.mass_kg * velocity.y;
  }
  k.energy_J = skeleton_.matter.calcKineticEnergy(skeleton_.state) -
               k.com.x * model_.gravity_m_s2[0] - k.com.y * model_.gravity_m_s2[1];
  k.com = {k.com.x / mass, k.com.y / mass};
  k.com_velocity = {k.com_velocity.x / mass, k.com_velocity.y / mass};
  for (int i = 0; i < kMuscles; ++i) {
    k.muscle_length_m[i] = muscles_[i].length_m;
    k.tendon_force_N[i] = muscles_[i].tendon_force_N;
  }
  for (std::size_t i = 0; i < std::min(feet_.size(), k.ground_reaction_N.size()); ++i)
    k.ground_reaction_N[i] = feet_[i].reaction_N;
  for (std::size_t i = 0; i < std::min(stops_.size(), k.limit_torque_Nm.size()); ++i)
    k.limit_torque_Nm[i] = stops_[i].torque_Nm;
  return k;
}

std::array<double, kCoordinates * kCoordinates> SimbodyEngine::mass_matrix() {
  place(state_.q.data(), state_.u.data());
  SimTK::Matrix m;
  skeleton_.matter.calcM(skeleton_.state, m);
  std::array<double, kCoordinates * kCoordinates> result;
  for (int i = 0; i < kCoordinates; ++i)
    for (int j = 0; j < kCoordinates; ++j)
      result[i * kCoordinates + j] = m(skeleton_.slot[i], skeleton_.slot[j]);
  return result;
}

}  // namespace

std::unique_ptr<Engine> make_simbody_engine(const Model& model, const EngineOptions& options) {
  return std::make_unique<SimbodyEngine>(model, options);
}

bool simbody_engine_defines_ndebug() {
#ifdef NDEBUG
  return true;
#else
  return false;
#endif
}

}  // namespace stride
