#include "train/simulation/planar/kinematics.h"

#include <algorithm>

namespace stride::planar {

using simd::both;
using simd::Pair;
using simd::V2;
using simd::V4;

void place(const PlanarModel& m, const PlanarState& state, KneeIntervals& intervals,
           PlanarKinematics& k) {
  const V2 knee = state.joint_q(1);
  const V2 tilt = both(state.q(6));
  const V2 thigh = tilt + state.joint_q(0), shank = thigh + knee, foot = shank + state.joint_q(2);
  V4 s, c;
  simd::sin_cos(simd::join(tilt, thigh), s, c);
  k.sin[0] = simd::low(s), k.cos[0] = simd::low(c);
  k.sin[1] = simd::high(s), k.cos[1] = simd::high(c);
  simd::sin_cos(simd::join(shank, foot), s, c);
  k.sin[2] = simd::low(s), k.cos[2] = simd::low(c);
  k.sin[3] = simd::high(s), k.cos[3] = simd::high(c);
  k.knee_speed = state.joint_u(1);
  k.omega[0] = both(state.u(6));
  k.omega[1] = k.omega[0] + state.joint_u(0);
  k.omega[2] = k.omega[1] + k.knee_speed;
  k.omega[3] = k.omega[2] + state.joint_u(2);

  // The functions of the knee angle are cubics of the table's interval. They are evaluated with the
  // functions of a leg in lanes, then transposed to both legs in lanes.
  V4 moving[PlanarModel::kLegs][2], value[PlanarModel::kLegs][2], slope[PlanarModel::kLegs][2];
  V4 bend[PlanarModel::kLegs];
  for (int leg = 0; leg < PlanarModel::kLegs; ++leg) {
    const PlanarModel::KneeTable& table = m.knee[leg];
    const auto interval = [&](double angle) {
      int& i = intervals[leg];
      const int last = static_cast<int>(table.knots.size());
      while (i < last && angle >= table.knots[i]) ++i;
      while (i > 0 && angle < table.knots[i - 1]) --i;
      return i;
    };
    const auto values = [](const PlanarModel::KneeTable::Cubics& f, V4 h, V4(&at)[2]) {
      for (int n = 0; n < 2; ++n) at[n] = f.a[n] + h * (f.b[n] + h * (f.c[n] + h * f.d[n]));
    };
    const double clamped = std::clamp(knee[leg], m.knee_range_min[leg], m.knee_range_max[leg]);
    if (clamped != knee[leg]) {
      const PlanarModel::KneeTable::Cubics& f = table.cubics[interval(clamped)];
      values(f, simd::all(clamped - f.origin), moving[leg]);
    }
    const PlanarModel::KneeTable::Cubics& f = table.cubics[interval(knee[leg])];
    const V4 h = simd::all(knee[leg] - f.origin);
    values(f, h, value[leg]);
    for (int n = 0; n < 2; ++n) slope[leg][n] = f.b[n] + h * (2 * f.c[n] + 3 * h * f.d[n]);
    bend[leg] = 2 * f.c[0] + 6 * h * f.d[0];
    if (clamped == knee[leg]) std::copy(value[leg], value[leg] + 2, moving[leg]);
  }
  const auto legs = [](V4 first, V4 second, Pair& even, Pair& odd) {
    const V4 x = __builtin_shufflevector(first, second, 0, 4, 2, 6);
    const V4 y = __builtin_shufflevector(first, second, 1, 5, 3, 7);
    even = {simd::low(x), simd::low(y)}, odd = {simd::high(x), simd::high(y)};
  };
  Pair hinge, hinge_slope, hinge_bend, unused;
  legs(value[0][0], value[1][0], hinge, unused);
  legs(slope[0][0], slope[1][0], hinge_slope, unused);
  legs(bend[0], bend[1], hinge_bend, unused);
  for (int n = 0; n < 2; ++n) {
    legs(moving[0][n], moving[1][n], k.moving[4 * n], k.moving[4 * n + 2]);
    legs(slope[0][n], slope[1][n], k.moving_slope[4 * n], k.moving_slope[4 * n + 2]);
  }

  // (1)
  k.origin[0] = Pair{};
  k.origin[1] = k.turn(0, {m.hip_x_m, m.hip_y_m});
  const Pair thigh_to_knee = k.turn(1, hinge);
  k.origin[2] = k.origin[1] + thigh_to_knee;
  const Pair knee_to_ankle = k.turn(2, {m.ankle_x_m, m.ankle_y_m});
  k.origin[3] = k.origin[2] + knee_to_ankle;
  for (int i = 0; i < 4; ++i) {
    k.center[i] = k.origin[i] + k.turn(i, {m.center_x_m[i], m.center_y_m[i]});
  }
  k.hinge_speed = k.turn(1, hinge_slope);
  k.hinge_bend = k.turn(1, hinge_bend);
  k.hinge = k.origin[2] + perp(k.hinge_speed);  // (2)
  k.velocity_of_foot = Pair{both(state.u(7)), both(state.u(8))} + k.omega[0] * perp(k.origin[1]) +
                       k.omega[1] * perp(thigh_to_knee) + k.knee_speed * k.hinge_speed +
                       k.omega[2] * perp(knee_to_ankle);
}

}  // namespace stride::planar
