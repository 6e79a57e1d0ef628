#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string_view>

#include "extract/io/names.h"
#include "extract/skeleton/body_part.h"

namespace stride {

/// What the potential compares. A foot is the ankle (origin of talus) unless the potential says
/// "toe" (origin of toes).
enum class PosePart { pelvis, knee_r, foot_r, knee_l, foot_l };

/// One of them. All that reads, writes, mirrors or measures a pose goes through this table.
struct ComparedPart {
  PosePart part{};
  std::string_view key;     // in NAME.potential.json
  std::size_t numbers = 0;  // 2: x and y from the pelvis; 1: only its height above the ground
  PosePart mirrored{};      // right ↔ left
  BodyPart ankle{}, toe{};  // which part of the body it is, where the foot is "ankle" or "toe"
};

inline constexpr std::array<ComparedPart, enumerator_count<PosePart>()> kPoseParts{{
    {PosePart::pelvis, "pelvis_height_m", 1, PosePart::pelvis, BodyPart::pelvis, BodyPart::pelvis},
    {PosePart::knee_r, "knee_r_m", 2, PosePart::knee_l, BodyPart::knee_r, BodyPart::knee_r},
    {PosePart::foot_r, "foot_r_m", 2, PosePart::foot_l, BodyPart::ankle_r, BodyPart::toe_r},
    {PosePart::knee_l, "knee_l_m", 2, PosePart::knee_r, BodyPart::knee_l, BodyPart::knee_l},
    {PosePart::foot_l, "foot_l_m", 2, PosePart::foot_r, BodyPart::ankle_l, BodyPart::toe_l},
}};

constexpr const ComparedPart& compared(PosePart part) {
  return kPoseParts[static_cast<std::size_t>(part)];
}

/// Where the numbers of a part begin in `Pose::m`.
constexpr std::size_t first_number(PosePart part) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(part); ++i) first += kPoseParts[i].numbers;
  return first;
}
inline constexpr std::size_t kPoseNumbers = [] {
  std::size_t count = 0;
  for (const ComparedPart& each : kPoseParts) count += each.numbers;
  return count;
}();
static_assert(
    [] {
      for (std::size_t i = 0; i < kPoseParts.size(); ++i)
        if (kPoseParts[i].part != static_cast<PosePart>(i) || kPoseParts[i].numbers == 0)
          return false;
      return true;
    }(),
    "each part needs one row, in the order of the enumeration");

/// Where knees and feet are relative to the pelvis origin, and how high the pelvis is. x forward, y
/// up, axes of the ground, metres.
struct Pose {
  std::array<double, kPoseNumbers> m{};  // of each part in its order: x, y; of the pelvis: height

  double& pelvis_height_m() { return m[first_number(PosePart::pelvis)]; }
  double pelvis_height_m() const { return m[first_number(PosePart::pelvis)]; }

  /// The numbers of a part.
  std::span<double> numbers(PosePart part) {
    return std::span(m).subspan(first_number(part), compared(part).numbers);
  }
  std::span<const double> numbers(PosePart part) const {
    return std::span(m).subspan(first_number(part), compared(part).numbers);
  }

  /// A knee or a foot.
  Eigen::Map<Eigen::Vector2d> operator[](PosePart part) {
    return Eigen::Map<Eigen::Vector2d>(numbers(part).data());
  }
  Eigen::Map<const Eigen::Vector2d> operator[](PosePart part) const {
    return Eigen::Map<const Eigen::Vector2d>(numbers(part).data());
  }

  Pose mirrored() const;

  /// All its numbers.
  auto row() const {
    return Eigen::Map<const Eigen::Matrix<double, 1, static_cast<int>(kPoseNumbers)>>(m.data());
  }
};

/// Angles of the right and the left leg, rad: how far the line from the pelvis to the knee is
/// turned forward from straight down, and how far the knee is flexed.
inline constexpr std::size_t kLegAngles = 4;
std::array<double, kLegAngles> leg_angles(const Pose& pose);

/// A pose and how fast its parts move, m/s.
struct MovingPose {
  Pose pose, velocity;

  MovingPose mirrored() const { return {pose.mirrored(), velocity.mirrored()}; }
};

/// How far a part is from where it is in another pose; of the pelvis only the height.
inline Eigen::Vector2d displacement(const Pose& from, const Pose& to, PosePart part) {
  const std::span<const double> a = from.numbers(part), b = to.numbers(part);
  return a.size() == 1 ? Eigen::Vector2d(0, b[0] - a[0])
                       : Eigen::Vector2d(b[0] - a[0], b[1] - a[1]);
}

}  // namespace stride
