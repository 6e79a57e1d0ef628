// NAME.potential.json: reading, writing and the rules of its values.
#include <algorithm>
#include <cmath>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/json/json.h"
#include "extract/io/outputs.h"
#include "extract/skeleton/movement.h"
#include "shaping/potential.h"

namespace stride {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "stride-potential";
constexpr int kVersion = 1;

Json to_json(const Pose& pose) {
  Json json;
  for (const ComparedPart& each : kPoseParts) {
    const std::span<const double> numbers = pose.numbers(each.part);
    if (numbers.size() == 1)
      json[std::string(each.key)] = numbers[0];
    else
      json[std::string(each.key)] = std::vector<double>(numbers.begin(), numbers.end());
  }
  return json;
}

Pose pose_from(const JsonNode& node, double (JsonNode::*number)() const) {
  Pose pose;
  for (const ComparedPart& each : kPoseParts) {
    const JsonNode part = node[std::string(each.key)];
    const std::span<double> numbers = pose.numbers(each.part);
    if (numbers.size() == 1) {
      numbers[0] = (part.*number)();
      continue;
    }
    if (!part.json.is_array() || part.json.size() != numbers.size()) part.fail("[x, y]");
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = (part[i].*number)();
  }
  return pose;
}

template <typename Choice>
Choice choice(const JsonNode& node, const Names<Choice>& names) {
  const auto found = names.find(node.text());
  require(found.has_value(), "{}: {} = '{}': must be one of {}", node.where, node.path, node.text(),
          names.list());
  return *found;
}

bool is_finite(const Pose& pose) {
  return std::ranges::all_of(pose.m, [](double each) { return std::isfinite(each); });
}

void require_format(const JsonNode& root) {
  require(root.json.is_object() && root.json.contains("format"),
          "{}: is not a potential: the key format = \"{}\" is missing; make one with `stride "
          "convert`",
          root.where, kFormat);
  const std::string format = root["format"].text();
  require(format == kFormat, "{}: format = '{}': must be '{}'", root.where, format, kFormat);
  const double version = root["version"].number();
  require(version == kVersion,
          "{}: version = {}: this program reads version {}; make the file anew with `stride "
          "convert`",
          root.where, version, kVersion);
}

}  // namespace

void check(const Potential& potential, const std::string& origin) {
  const auto positive = [&](const char* key, double value) {
    require(std::isfinite(value) && value > 0, "{}: {} = {}: must be positive", origin, key, value);
  };
  positive("stride.period_s", potential.period_s);
  positive("epsilon_m", potential.epsilon_m);
  require(std::isfinite(potential.weight) && potential.weight >= 0,
          "{}: weight = {}: must not be negative", origin, potential.weight);
  require(potential.foot == "ankle" || potential.foot == "toe",
          "{}: foot = '{}': must be ankle or toe", origin, potential.foot);
  const std::size_t n = potential.keyframes.size();
  require(n >= 2, "{}: {} keyframes: at least two are needed", origin, n);
  for (std::size_t k = 0; k < n; ++k) {
    const Keyframe& keyframe = potential.keyframes[k];
    const double phase =
        static_cast<double>(k) / static_cast<double>(potential.repeats ? n : n - 1);
    require(std::abs(keyframe.phase - phase) < 1e-9,
            "{}: keyframes[{}].phase = {}: must be {}: keyframes are equally spaced from 0{}",
            origin, k, keyframe.phase, phase, potential.repeats ? "" : " to 1");
    require(is_finite(keyframe.pose), "{}: keyframes[{}] has a coordinate that is not finite",
            origin, k);
  }
}

namespace {

/// Knees and feet where a leg reaches, most feet below the pelvis.
void require_legs(const Potential& p, const std::string& origin) {
  constexpr double kThigh_m[] = {0.2, 0.7}, kShank_m[] = {0.25, 0.85};  // to the toe: longer
  double feet_m = 0;
  const auto require_length = [&](const Keyframe& keyframe, const char* what, double length_m,
                                  const double(&range_m)[2]) {
    require(length_m > range_m[0] && length_m < range_m[1],
            "{}: phase {}: {} is {:.3g} m, people's {} to {} m: are keys or axes exchanged, is it "
            "in m?",
            origin, keyframe.phase, what, length_m, range_m[0], range_m[1]);
  };
  for (const Keyframe& keyframe : p.keyframes)
    for (const auto& [knee, foot] : {std::pair(PosePart::knee_r, PosePart::foot_r),
                                     std::pair(PosePart::knee_l, PosePart::foot_l)}) {
      const Pose& pose = keyframe.pose;
      require_length(keyframe, "from pelvis to knee", pose[knee].norm(), kThigh_m);
      require_length(keyframe, "from knee to foot", (pose[foot] - pose[knee]).norm(), kShank_m);
      feet_m += pose[foot].y() / (2.0 * static_cast<double>(p.keyframes.size()));
    }
  require(feet_m < -0.4,
          "{}: the feet are at y = {:.2f} m from the pelvis on average, people's at -0.6 to -0.9 "
          "m: y grows upwards",
          origin, feet_m);
}

}  // namespace

void require_human(const Potential& p, const std::string& origin) {
  const double shortest_s = 0.3, longest_s = p.repeats ? 2 : 10;
  constexpr double kFastest_m_s = 12.5, kBackward_m_s = -1;
  require(!p.verdict.starts_with("refused"), "{}: the clip behind it was refused ({})", origin,
          p.verdict);
  require(p.period_s >= shortest_s && p.period_s <= longest_s,
          "{}: {} takes {:.2f} s, people's {} to {} s; if the clip plays in slow motion, convert "
          "it again with --slow-motion",
          origin, p.repeats ? "a stride" : "the " + p.movement, p.period_s, shortest_s, longest_s);
  require(!(p.speed_m_s > kFastest_m_s), "{}: {:.1f} m/s is faster than anybody", origin,
          p.speed_m_s);
  require(!(p.speed_m_s < kBackward_m_s), "{}: {:.1f} m/s: goes backward", origin, p.speed_m_s);
  for (const Keyframe& keyframe : p.keyframes) {
    const double height_m = keyframe.pose.pelvis_height_m();
    require(height_m > 0.3 && height_m < 1.6,
            "{}: phase {}: the pelvis is {:.2f} m high, a runner's 0.3 to 1.6 m", origin,
            keyframe.phase, height_m);
  }
  require_legs(p, origin);
}

Potential load_potential(const std::filesystem::path& path) {
  const std::string file = path.string();
  const std::string content = read_file(path);
  const FileKind kind = kind_of_content(std::string_view(content).substr(0, 8192));
  require(!is_binary(kind) && kind != FileKind::text && kind != FileKind::empty,
          "{}: is {}, a potential is needed; make one of a video with `stride convert`", file,
          name(kind));
  require(!content.starts_with("# stride"),
          "{}: is a table, a potential is needed; make one with `stride convert {} -o DIR`", file,
          file);
  const Json json = parse_json(content, file, "a potential; make one with `stride convert`");
  const JsonNode root{json, file, ""};
  require_format(root);
  Potential potential;
  potential.source = root["source"]["file"].text();
  potential.source_sha256 = root["source"]["sha256"].text();
  if (json.contains("movement"))
    set_movement(potential, root["movement"].text(), file + ": movement");
  potential.model = root["model"].text();
  potential.foot = root["foot"].text();
  potential.period_s = root["stride"]["period_s"].number();
  potential.period_sd_s = root["stride"]["period_sd_s"].number_or_unknown();
  potential.speed_m_s = root["stride"]["speed_m_s"].number_or_unknown();
  potential.rms_px = root["fit"]["rms_px"].number_or_unknown();
  potential.rms_m = root["fit"]["rms_m"].number_or_unknown();
  potential.verdict = root["fit"]["verdict"].text();
  potential.function = choice(root["function"], kInverseDistances);
  potential.index = choice(root["index"], kPotentialIndices);
  potential.epsilon_m = root["epsilon_m"].number();
  potential.weight = root["weight"].number();
  const JsonNode keyframes = root["keyframes"];
  require(keyframes.json.is_array(), "{}: keyframes must be a list", file);
  for (std::size_t k = 0; k < keyframes.json.size(); ++k) {
    const JsonNode node = keyframes[k];
    potential.keyframes.push_back({.phase = node["phase"].number(),
                                   .pose = pose_from(node, &JsonNode::number),
                                   .sd = pose_from(node["sd"], &JsonNode::number_or_unknown)});
  }
  check(potential, file);
  return potential;
}

std::string to_json_text(const Potential& potential) {
  Json keyframes = Json::array();
  for (const Keyframe& keyframe : potential.keyframes) {
    Json json{{"phase", keyframe.phase}};
    json.update(to_json(keyframe.pose));
    json["sd"] = to_json(keyframe.sd);  // NaN becomes null
    keyframes.push_back(std::move(json));
  }
  Json json{
      {"format", kFormat},
      {"version", kVersion},
      {"source", {{"file", potential.source}, {"sha256", potential.source_sha256}}},
      {"model", potential.model},
      {"foot", potential.foot},
      {"stride",
       {{"period_s", potential.period_s},
        {"period_sd_s", potential.period_sd_s},
        {"speed_m_s", potential.speed_m_s}}},
      {"fit",
       {{"rms_px", potential.rms_px}, {"rms_m", potential.rms_m}, {"verdict", potential.verdict}}},
      {"function", kInverseDistances[potential.function]},
      {"index", kPotentialIndices[potential.index]},
      {"epsilon_m", potential.epsilon_m},
      {"weight", potential.weight},
      {"keyframes", keyframes}};
  if (potential.movement != kDefaultMovement) json["movement"] = potential.movement;
  return json_text(json);
}

void save(const Potential& potential, const std::filesystem::path& file) {
  check(potential, file.string());
  write_file_atomically(file, to_json_text(potential));
}

}  // namespace stride
