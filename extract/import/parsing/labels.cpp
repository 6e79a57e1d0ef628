#include "extract/import/parsing/labels.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>

#include "extract/io/error.h"

namespace stride::imports {
namespace {

/// "Right Knee" → "rightknee".
std::string plain(std::string_view label) {
  std::string letters;
  for (const unsigned char c : label)
    if (std::isalnum(c)) letters += static_cast<char>(std::tolower(c));
  return letters;
}

bool is_sided(std::string_view letters, std::string_view noun, bool right) {
  for (const std::string_view side : right ? std::array<std::string_view, 2>{"r", "right"}
                                           : std::array<std::string_view, 2>{"l", "left"}) {
    if (letters.size() != side.size() + noun.size()) continue;
    if (letters.starts_with(side) && letters.ends_with(noun)) return true;
    if (letters.starts_with(noun) && letters.ends_with(side)) return true;
  }
  return false;
}

bool is_called(const BodyPartRow& part, std::string_view letters) {
  return std::ranges::any_of(part.nouns, [&](std::string_view noun) {
    if (noun.empty()) return false;
    return part.side ? is_sided(letters, noun, *part.side == Side::right) : letters == noun;
  });
}

}  // namespace

LabelMap::LabelMap(std::span<const std::string> labels,
                   const std::map<std::string, std::string>& own, const std::string& where)
    : targets_(labels.size()) {
  constexpr int kOwn = 9, kExact = 3, kFallback = 2, kLastResort = 1;
  for (const auto& [part, label] : own) {
    const auto found = std::ranges::find(labels, label);
    require(found != labels.end(), "{}: label '{}' (for {}) is not in the file, which has {}",
            where, label, part, fmt::join(labels, ", "));
    targets_[static_cast<std::size_t>(found - labels.begin())].push_back({body_part(part), kOwn});
  }
  bool known = !own.empty();
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const std::string letters = plain(labels[i]);
    auto& targets = targets_[i];
    for (const BodyPartRow& part : kBodyPartRows)
      if (is_called(part, letters)) targets.push_back({part.part, kExact});
    if (is_sided(letters, "ear", true) || is_sided(letters, "ear", false))
      targets.push_back({BodyPart::head, kFallback});
    if (letters == "nose") targets.push_back({BodyPart::head, kLastResort});
    known = known || !targets.empty();
  }
  require(known,
          "{}: none of its labels ({}) is a body part of ours; say which is which with --labels, "
          "as in --labels knee_r={}",
          where, fmt::join(labels, ", "), labels.empty() ? "LABEL" : labels.front());
}

std::array<Point, kBodyPartCount> LabelMap::parts(std::span<const Point> points) const {
  struct Sum {
    int priority = 0, count = 0;
    Eigen::Vector2d p_px = Eigen::Vector2d::Zero();
    double confidence = 1;
  };
  std::array<Sum, kBodyPartCount> sums;
  for (std::size_t i = 0; i < std::min(points.size(), targets_.size()); ++i) {
    if (!points[i].present()) continue;
    for (const Target& target : targets_[i]) {
      Sum& sum = sums[index(target.part)];
      if (target.priority > sum.priority) sum = {target.priority};
      if (target.priority < sum.priority) continue;
      ++sum.count;
      sum.p_px += points[i].p_px;
      sum.confidence = std::min(sum.confidence, points[i].confidence);
    }
  }
  std::array<Point, kBodyPartCount> parts;
  for (int i = 0; i < kBodyPartCount; ++i)
    if (sums[i].count > 0)
      parts[i] = {sums[i].p_px / sums[i].count, Source::detected,
                  std::clamp(sums[i].confidence, 0.0, 1.0)};
  const Point &right = parts[index(BodyPart::hip_r)], &left = parts[index(BodyPart::hip_l)];
  Point& pelvis = parts[index(BodyPart::pelvis)];
  if (!pelvis.present() && right.present() && left.present())
    pelvis = {(right.p_px + left.p_px) / 2, Source::detected,
              std::min(right.confidence, left.confidence)};
  return parts;
}

std::vector<std::string> LabelMap::unused(std::span<const std::string> labels) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (targets_[i].empty() && !labels[i].empty()) names.push_back(labels[i]);
  return names;
}

std::vector<std::string> layout_of(std::size_t points) {
  const std::vector<std::string> coco{"nose",  "",       "",       "ear_l",   "ear_r",  "",
                                      "",      "",       "",       "",        "",       "hip_l",
                                      "hip_r", "knee_l", "knee_r", "ankle_l", "ankle_r"};
  std::vector<std::string> names;
  switch (points) {
    case 15:  // OpenPose MPI: 8–10 right leg, 11–13 left leg
      names = {"head",  "",       "",        "",      "",       "",        "", "",
               "hip_r", "knee_r", "ankle_r", "hip_l", "knee_l", "ankle_l", ""};
      break;
    case 17:
      names = coco;
      break;
    case 18:
      names = {"nose",   "",        "",      "",       "",        "", "", "",      "hip_r",
               "knee_r", "ankle_r", "hip_l", "knee_l", "ankle_l", "", "", "ear_r", "ear_l"};
      break;
    case 25:
      names = {"nose",    "",         "",      "",       "",        "",         "",
               "",        "midhip",   "hip_r", "knee_r", "ankle_r", "hip_l",    "knee_l",
               "ankle_l", "",         "",      "ear_r",  "ear_l",   "bigtoe_l", "",
               "heel_l",  "bigtoe_r", "",      "heel_r"};
      break;
    case 26:
    case 136:
      names = coco;
      names.insert(names.end(),
                   {"", "", "midhip", "bigtoe_l", "bigtoe_r", "", "", "heel_l", "heel_r"});
      break;
    case 33:
      names = {"nose", "", "", "", "", "", "", "ear_l", "ear_r"};
      names.resize(23);
      names.insert(names.end(), {"hip_l", "hip_r", "knee_l", "knee_r", "ankle_l", "ankle_r",
                                 "heel_l", "heel_r", "toe_l", "toe_r"});
      break;
    case 133:
      names = coco;
      names.insert(names.end(), {"bigtoe_l", "", "heel_l", "bigtoe_r", "", "heel_r"});
      break;
    default:
      return {};
  }
  names.resize(points);
  return names;
}

}  // namespace stride::imports
