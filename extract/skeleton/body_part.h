#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "extract/io/names.h"

namespace stride {

/// The labelled parts of a runner. The pelvis is the midpoint of the hips, every other part the
/// centre of its joint; the toe is the tip of the big toe, the heel its back, the head its centre.
/// `_r` and `_l` are the runner's own right and left.
enum class BodyPart {
  pelvis,
  knee_r,
  ankle_r,
  toe_r,
  hip_r,
  knee_l,
  ankle_l,
  toe_l,
  hip_l,
  head,
  heel_r,
  heel_l
};

enum class Side { right, left };
inline constexpr Names<Side> kSides({{Side::right, "right"}, {Side::left, "left"}});

/// When `stride annotate` asks for a part. Never: it comes from networks and other programs, and
/// files have it only where it was seen.
enum class Prompt { always, with_hips, with_head, never };

/// What the program knows of a part. All that names, mirrors, joins, prompts for, imports or
/// exports parts reads this table; a part without a row does not compile.
struct BodyPartRow {
  BodyPart part{};
  std::string_view name;       // in every file
  std::optional<Side> side;    // none: the middle of the body
  BodyPart mirrored{};         // right ↔ left
  BodyPart parent{};           // the other end of its bone; itself: no bone ends here
  std::string_view osim_body;  // the body of the OpenSim model whose origin it is
  int body_25 = 0;             // its index in OpenPose's BODY_25
  bool required = false;       // a potential needs it
  Prompt prompt{};
  std::array<std::string_view, 10> nouns;  // what other programs call it, without the side
};

inline constexpr std::array<BodyPartRow, enumerator_count<BodyPart>()> kBodyPartRows = [] {
  using enum BodyPart;
  using enum Prompt;
  constexpr Side right = Side::right, left = Side::left;
  constexpr bool kRequired = true, kOptional = false;
  constexpr decltype(BodyPartRow::nouns) kPelvis{"pelvis",    "midhip", "hipmid",    "hip",
                                                 "hips",      "chip",   "hipcenter", "hipcentre",
                                                 "centerhip", "root"},
      kKnee{"knee", "kneejoint"}, kAnkle{"ankle", "anklejoint"},
      kToe{"toe", "bigtoe", "toes", "toetip", "hallux", "footindex"}, kHip{"hip", "hipjoint"},
      kHead{"head", "headcenter", "headcentre"}, kHeel{"heel", "calcaneus", "calcn"};
  // BODY_25 has no head: ours becomes its nose.
  // clang-format off
  return std::array<BodyPartRow, enumerator_count<BodyPart>()>{{
      // part    name       side   mirrored parent   OpenSim   B25 required   prompt     nouns
      {pelvis,  "pelvis",  {},    pelvis,  pelvis,  "pelvis",   8, kRequired, always,    kPelvis},
      {knee_r,  "knee_r",  right, knee_l,  pelvis,  "tibia_r", 10, kRequired, always,    kKnee},
      {ankle_r, "ankle_r", right, ankle_l, knee_r,  "talus_r", 11, kRequired, always,    kAnkle},
      {toe_r,   "toe_r",   right, toe_l,   ankle_r, "toes_r",  22, kOptional, always,    kToe},
      {hip_r,   "hip_r",   right, hip_l,   hip_r,   "femur_r",  9, kOptional, with_hips, kHip},
      {knee_l,  "knee_l",  left,  knee_r,  pelvis,  "tibia_l", 13, kRequired, always,    kKnee},
      {ankle_l, "ankle_l", left,  ankle_r, knee_l,  "talus_l", 14, kRequired, always,    kAnkle},
      {toe_l,   "toe_l",   left,  toe_r,   ankle_l, "toes_l",  19, kOptional, always,    kToe},
      {hip_l,   "hip_l",   left,  hip_r,   hip_l,   "femur_l", 12, kOptional, with_hips, kHip},
      {head,    "head",    {},    head,    head,    "head",     0, kOptional, with_head, kHead},
      {heel_r,  "heel_r",  right, heel_l,  ankle_r, "calcn_r", 24, kOptional, never,     kHeel},
      {heel_l,  "heel_l",  left,  heel_r,  ankle_l, "calcn_l", 21, kOptional, never,     kHeel},
  }};
  // clang-format on
}();

constexpr int index(BodyPart part) { return static_cast<int>(part); }
constexpr const BodyPartRow& row(BodyPart part) {
  return kBodyPartRows[static_cast<std::size_t>(part)];
}
constexpr std::string_view name(BodyPart part) { return row(part).name; }
constexpr BodyPart mirrored(BodyPart part) { return row(part).mirrored; }

/// +1 right, −1 left, 0 the middle of the body.
constexpr int side_of(BodyPart part) {
  const std::optional<Side> side = row(part).side;
  return !side ? 0 : *side == Side::right ? 1 : -1;
}

constexpr bool is_heel(BodyPart part) {
  return part == BodyPart::heel_r || part == BodyPart::heel_l;
}

/// The parts for which `chosen(row)` holds, in the order of the enumeration.
template <auto kChosen>
consteval auto parts_where() {
  constexpr auto kCount = [] {
    std::size_t count = 0;
    for (const BodyPartRow& each : kBodyPartRows) count += kChosen(each) ? 1 : 0;
    return count;
  }();
  std::array<BodyPart, kCount> parts{};
  std::size_t i = 0;
  for (const BodyPartRow& each : kBodyPartRows)
    if (kChosen(each)) parts[i++] = each.part;
  return parts;
}

inline constexpr auto kBodyParts = parts_where<[](const BodyPartRow&) { return true; }>();
inline constexpr int kBodyPartCount = static_cast<int>(kBodyParts.size());

/// The parts that a person can be asked for. They come first.
inline constexpr auto kAskedParts =
    parts_where<[](const BodyPartRow& each) { return each.prompt != Prompt::never; }>();
static_assert(index(kAskedParts.back()) + 1 == static_cast<int>(kAskedParts.size()));

/// The parts that a file of points has: those that a person can be asked for, and every other one
/// for which `is_seen(part)` holds.
template <typename IsSeen>
std::vector<BodyPart> parts_in_file(IsSeen is_seen) {
  std::vector<BodyPart> parts(kAskedParts.begin(), kAskedParts.end());
  for (const BodyPart part : kBodyParts)
    if (row(part).prompt == Prompt::never && is_seen(part)) parts.push_back(part);
  return parts;
}

/// The parts that a potential needs.
inline constexpr auto kRequiredParts =
    parts_where<[](const BodyPartRow& each) { return each.required; }>();

/// A part of the right leg and its like on the left.
struct LegPair {
  BodyPart right{}, left{};
  constexpr BodyPart operator[](int side) const { return side == 0 ? right : left; }
};
inline constexpr auto kLegPairs = [] {
  constexpr auto kRight =
      parts_where<[](const BodyPartRow& each) { return each.side == Side::right; }>();
  std::array<LegPair, kRight.size()> pairs{};
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = {kRight[i], mirrored(kRight[i])};
  return pairs;
}();

/// Whether a part is another one or hangs from it by bones.
constexpr bool hangs_from(BodyPart part, BodyPart above) {
  for (; part != above; part = row(part).parent)
    if (row(part).parent == part) return false;
  return true;
}

/// A limb, or the line from the pelvis to a knee.
struct Bone {
  BodyPart from{}, to{};
};
inline constexpr auto kBones = [] {
  constexpr auto kEnds =
      parts_where<[](const BodyPartRow& each) { return each.parent != each.part; }>();
  std::array<Bone, kEnds.size()> bones{};
  for (std::size_t i = 0; i < bones.size(); ++i) bones[i] = {row(kEnds[i]).parent, kEnds[i]};
  return bones;
}();

/// The bones of a leg, from the hip downwards: the first begins at the hip instead of the pelvis.
template <Side kSide>
inline constexpr auto kLegBones = [] {
  constexpr auto kEnds = parts_where<[](const BodyPartRow& each) {
    return each.side == kSide && each.parent != each.part;
  }>();
  std::array<Bone, kEnds.size()> bones{};
  for (std::size_t i = 0; i < bones.size(); ++i) {
    const BodyPart from = row(kEnds[i]).parent;
    bones[i] = {row(from).side         ? from
                : kSide == Side::right ? BodyPart::hip_r
                                       : BodyPart::hip_l,
                kEnds[i]};
  }
  return bones;
}();

/// The line under each foot, right and left.
inline constexpr std::array kSoles{Bone{BodyPart::heel_r, BodyPart::toe_r},
                                   Bone{BodyPart::heel_l, BodyPart::toe_l}};

static_assert(
    [] {
      for (std::size_t i = 0; i < kBodyPartRows.size(); ++i) {
        const BodyPartRow& each = kBodyPartRows[i];
        const BodyPartRow& other = row(each.mirrored);
        if (each.part != static_cast<BodyPart>(i) || each.name.empty() || each.osim_body.empty() ||
            other.mirrored != each.part || (other.part == each.part) != !each.side ||
            (each.side && other.side == each.side) || row(each.parent).mirrored != other.parent ||
            (each.side == Side::right && each.mirrored < each.part))
          return false;
      }
      return true;
    }(),
    "each part needs one row, in the order of the enumeration; right comes before left and "
    "matches it");

/// The part of that name. Throws Error with the list of names.
BodyPart body_part(std::string_view name);

}  // namespace stride
