#include "videos/jump_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "extract/io/data_file.h"
#include "extract/io/table.h"
#include "extract/skeleton/units.h"

namespace stride::videos {
namespace {

constexpr double kTurned_deg[2] = {-10.3, -2.3};  // of the ankles in standing
constexpr double kRaised_m = 0.026;               // sole of the shoe instead of the bare figure's
constexpr double kOnGround_m = 0.012;             // a shoe below that bends, and is on the ground

/// A curve by eye through (time, value), flat at its ends, on cosines between.
double by_eye(std::initializer_list<std::pair<double, double>> points, double time_s) {
  const std::pair<double, double>* before = points.begin();
  for (const auto& point : points) {
    if (point.first > time_s) {
      if (before == &point) return point.second;
      const double share = (time_s - before->first) / (point.first - before->first);
      return std::lerp(before->second, point.second,
                       0.5 - 0.5 * std::cos(std::numbers::pi * share));
    }
    before = &point;
  }
  return before->second;
}

}  // namespace

JumpMotion::JumpMotion(const Proportions& proportions) : proportions_(proportions) {
  const Table table = load_table(data_file("videos/jump_kinematics.csv"), "jump-kinematics", 1);
  source_ = table.meta("source");
  for (const std::vector<double>& row : table.rows) {
    Row& own = rows_.emplace_back();
    const auto of = [&](const char* column) { return row[table.column(column)]; };
    own = {of("time_s"), of("pelvis_x"), of("pelvis_y") + kRaised_m, kDegree * of("pelvis_tilt")};
    own.hip_flexion = {kDegree * of("hip_flexion_r"), kDegree * of("hip_flexion_l")};
    own.knee_angle = {kDegree * of("knee_angle_r"), kDegree * of("knee_angle_l")};
    own.ankle_angle = {kDegree * (of("ankle_angle_r") + kTurned_deg[0]),
                       kDegree * (of("ankle_angle_l") + kTurned_deg[1])};
  }
  constexpr double kStep_s = 1e-3;
  const double highest_s = std::ranges::max_element(rows_, {}, &Row::height_m)->time_s;
  const auto in_air = [&](double time_s) { return lower_shoe_m(time_s) > kOnGround_m; };
  for (take_off_s_ = highest_s; in_air(take_off_s_);) take_off_s_ -= kStep_s;
  for (landing_s_ = highest_s; in_air(landing_s_);) landing_s_ += kStep_s;
}

JumpMotion::Row JumpMotion::at(double time_s) const {
  const auto after = std::ranges::lower_bound(rows_, time_s, {}, &Row::time_s);
  if (after == rows_.begin()) return rows_.front();
  if (after == rows_.end()) return rows_.back();
  const Row &a = *std::prev(after), &b = *after;
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  Row row{time_s, std::lerp(a.x_m, b.x_m, share), std::lerp(a.height_m, b.height_m, share),
          std::lerp(a.pelvis_tilt, b.pelvis_tilt, share)};
  for (int side : {0, 1}) {
    row.hip_flexion[side] = std::lerp(a.hip_flexion[side], b.hip_flexion[side], share);
    row.knee_angle[side] = std::lerp(a.knee_angle[side], b.knee_angle[side], share);
    row.ankle_angle[side] = std::lerp(a.ankle_angle[side], b.ankle_angle[side], share);
  }
  return row;
}

Skeleton JumpMotion::skeleton(double time_s) const {
  const Row row = at(time_s);
  Posture posture;
  posture.phase = std::clamp(time_s / duration_s(), 0.0, 1.0);
  posture.pelvis_tilt = row.pelvis_tilt;
  posture.trunk_lean = 0.05 - 1.15 * row.pelvis_tilt;
  posture.hip_flexion = row.hip_flexion;
  posture.knee_angle = row.knee_angle;
  posture.ankle_angle = row.ankle_angle;
  const double arms = by_eye({{0, 8},
                              {0.2, 15},
                              {0.5, -55},
                              {0.6, -50},
                              {0.88, 125},
                              {1.0, 118},
                              {1.25, 40},
                              {1.45, 25},
                              {1.8, 8}},
                             time_s);
  const double elbows =
      by_eye({{0, 12}, {0.5, 15}, {0.7, 45}, {0.9, 25}, {1.3, 35}, {1.8, 12}}, time_s);
  for (int side : {0, 1}) {
    posture.upper_arm[side] = kDegree * (arms + (side == 0 ? 2 : -2));
    posture.elbow[side] = kDegree * elbows;
  }
  return stand(posture, proportions_, row.x_m, row.height_m);
}

double JumpMotion::lower_shoe_m(double time_s) const {
  const Skeleton s = skeleton(time_s);
  return std::min(clearance(s, proportions_, 0), clearance(s, proportions_, 1));
}

}  // namespace stride::videos
