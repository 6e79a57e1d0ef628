#include "extract/skeleton/body_part.h"

#include <fmt/ranges.h>

#include "extract/io/error.h"

namespace stride {
namespace {

constexpr std::array<std::string_view, kBodyPartCount> kNames{
    "pelvis", "knee_r", "ankle_r", "toe_r", "hip_r", "knee_l", "ankle_l", "toe_l", "hip_l", "head"};

}  // namespace

std::string_view name(BodyPart part) { return kNames[index(part)]; }

BodyPart body_part(std::string_view name) {
  for (int i = 0; i < kBodyPartCount; ++i)
    if (kNames[i] == name) return kBodyParts[i];
  throw Error(
      fmt::format("body part '{}': not known; use one of {}", name, fmt::join(kNames, ", ")));
}

BodyPart mirrored(BodyPart part) {
  switch (part) {
    case BodyPart::knee_r:
      return BodyPart::knee_l;
    case BodyPart::ankle_r:
      return BodyPart::ankle_l;
    case BodyPart::toe_r:
      return BodyPart::toe_l;
    case BodyPart::hip_r:
      return BodyPart::hip_l;
    case BodyPart::knee_l:
      return BodyPart::knee_r;
    case BodyPart::ankle_l:
      return BodyPart::ankle_r;
    case BodyPart::toe_l:
      return BodyPart::toe_r;
    case BodyPart::hip_l:
      return BodyPart::hip_r;
    default:
      return part;
  }
}

}  // namespace stride
