#include "train/simulation/planar_kinematics.h"

#include <algorithm>

namespace stride {

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
  simd::sin_cos(V4{tilt[0], tilt[1], thigh[0], thigh[1]}, s, c);
  k.sin[0] = V2{s[0], s[1]}, k.cos[0] = V2{c[0], c[1]};
  k.sin[1] = V2{s[2], s[3]}, k.cos[1] = V2{c[2], c[3]};
  simd::sin_cos(V4{shank[0], shank[1], foot[0], foot[1]}, s, c);
  k.sin[2] = V2{s[0], s[1]}, k.cos[2] = V2{c[0], c[1]};
  k.sin[3] = V2{s[2], s[3]}, k.cos[3] = V2{c[2], c[3]};
  k.knee_speed = state.joint_u(1);
  k.omega[0] = both(state.u(6));
  k.omega[1] = k.omega[0] + state.joint_u(0);
  k.omega[2] = k.omega[1] + k.knee_speed;
  k.omega[3] = k.omega[2] + state.joint_u(2);

  Pair hinge, hinge_slope, hinge_bend;
  for (int leg = 0; leg < PlanarModel::kLegs; ++leg) {
    const PlanarModel::KneeTable& table = m.knee[leg];
    const auto interval = [&](double angle) {
      int& i = intervals[leg];
      const int last = static_cast<int>(table.knots.size());
      while (i < last && angle >= table.knots[i]) ++i;
      while (i > 0 && angle < table.knots[i - 1]) --i;
      return i;
    };
    const double clamped = std::clamp(knee[leg], m.knee_range_min[leg], m.knee_range_max[leg]);
    if (clamped != knee[leg]) {
      const PlanarModel::KneeTable::Cubics& f = table.cubics[interval(clamped)];
      const V4 h = simd::all(clamped - f.origin);
      for (int half = 0; half < 2; ++half) {
        const V4 value = f.a[half] + h * (f.b[half] + h * (f.c[half] + h * f.d[half]));
        for (int n = 0; n < 4; n += 2) {
          k.moving[4 * half + n].x[leg] = value[n], k.moving[4 * half + n].y[leg] = value[n + 1];
        }
      }
    }
    const PlanarModel::KneeTable::Cubics& f = table.cubics[interval(knee[leg])];
    const V4 h = simd::all(knee[leg] - f.origin);
    for (int half = 0; half < 2; ++half) {
      const V4 value = f.a[half] + h * (f.b[half] + h * (f.c[half] + h * f.d[half]));
      const V4 slope = f.b[half] + h * (2 * f.c[half] + 3 * h * f.d[half]);
      for (int n = 0; n < 4; n += 2) {
        const int i = 4 * half + n;
        if (clamped == knee[leg]) k.moving[i].x[leg] = value[n], k.moving[i].y[leg] = value[n + 1];
        k.moving_slope[i].x[leg] = slope[n], k.moving_slope[i].y[leg] = slope[n + 1];
      }
      if (half > 0) continue;
      const V4 bend = 2 * f.c[0] + 6 * h * f.d[0];
      hinge.x[leg] = value[0], hinge.y[leg] = value[1];
      hinge_slope.x[leg] = slope[0], hinge_slope.y[leg] = slope[1];
      hinge_bend.x[leg] = bend[0], hinge_bend.y[leg] = bend[1];
    }
  }

  k.origin[0] = {};
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
  k.hinge = k.origin[2] + perp(k.hinge_speed);
  k.velocity_of_foot = Pair{both(state.u(7)), both(state.u(8))} + k.omega[0] * perp(k.origin[1]) +
                       k.omega[1] * perp(thigh_to_knee) + k.knee_speed * k.hinge_speed +
                       k.omega[2] * perp(knee_to_ankle);
}

}  // namespace stride
