#pragma once

#include <array>
#include <string_view>

namespace stride {

/// The labelled parts of a runner. The pelvis is the midpoint of the hips, every other part the
/// centre of its joint; the toe is the tip of the big toe, the head its centre. `_r` and `_l` are
/// the runner's own right and left.
enum class BodyPart { pelvis, knee_r, ankle_r, toe_r, hip_r, knee_l, ankle_l, toe_l, hip_l, head };

inline constexpr std::array kBodyParts{
    BodyPart::pelvis, BodyPart::knee_r,  BodyPart::ankle_r, BodyPart::toe_r, BodyPart::hip_r,
    BodyPart::knee_l, BodyPart::ankle_l, BodyPart::toe_l,   BodyPart::hip_l, BodyPart::head};
inline constexpr int kBodyPartCount = static_cast<int>(kBodyParts.size());

/// The parts that a potential needs.
inline constexpr std::array kRequiredParts{BodyPart::pelvis, BodyPart::knee_r, BodyPart::ankle_r,
                                           BodyPart::knee_l, BodyPart::ankle_l};

constexpr int index(BodyPart part) { return static_cast<int>(part); }

/// `pelvis`, `knee_r`, …: the names in every file.
std::string_view name(BodyPart part);

/// The part of that name. Throws Error with the list of names.
BodyPart body_part(std::string_view name);

/// Right ↔ left; pelvis and head are their own mirror images.
BodyPart mirrored(BodyPart part);

}  // namespace stride
