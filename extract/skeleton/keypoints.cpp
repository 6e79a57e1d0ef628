#include "extract/skeleton/keypoints.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/json/json.h"
#include "extract/skeleton/movement.h"

namespace stride {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr std::string_view kFormat = "stride keypoints";

Eigen::Vector2d point(const JsonNode& node) {
  const Json& json = node.json;
  if (!json.is_array() || json.size() != 2 || !json[0].is_number() || !json[1].is_number())
    node.fail("[x, y] in pixels");
  return {json[0].get<double>(), json[1].get<double>()};
}

CalibrationLine calibration_line(const JsonNode& node) {
  const std::string what = node.where + ": " + node.path;
  const Json& json = node.json;
  require(json.is_object() && json.contains("px") && json.at("px").is_array() &&
              json.at("px").size() == 2,
          "{} = {}: must have frame, px [[x, y], [x, y]] and length_m", what, json.dump());
  const JsonNode line{json, what, ""};
  const auto end = [&](std::size_t i) { return point({json.at("px")[i], what, "px"}); };
  return {line.value<int>("frame", "a frame number"), end(0), end(1),
          line.value<double>("length_m", "metres")};
}

/// The keys that this program does not know, as text.
std::string others(const Json& object, std::initializer_list<std::string_view> known) {
  Json rest = Json::object();
  for (const auto& [key, entry] : object.items())
    if (std::find(known.begin(), known.end(), key) == known.end()) rest[key] = entry;
  return rest.empty() ? std::string() : rest.dump();
}

void add_others(Json& object, const std::string& other_json) {
  if (other_json.empty()) return;
  const Json rest = Json::parse(other_json);
  for (const auto& [key, entry] : rest.items())
    if (!object.contains(key)) object[key] = entry;
}

ClickState click_state(const JsonNode& click) {
  const std::string allowed = kClickStates.list(" or ");
  const auto text = click.value<std::string>("state", allowed);
  const std::optional<ClickState> state = kClickStates.find(text);
  require(state.has_value(), "{}: state = {}: must be {}", click.where, text, allowed);
  return *state;
}

Click click_of(const Json& json, const std::string& what) {
  require(json.is_object(), "{} = {}: must be an object with x, y and state", what, json.dump());
  const JsonNode node{json, what, ""};
  Click click;
  click.state = click_state(node);
  if (click.state != ClickState::absent)
    click.p_px = {node.value<double>("x", "a number of pixels"),
                  node.value<double>("y", "a number of pixels")};
  click.other_json = others(json, {"x", "y", "state"});
  return click;
}

void read_frame(const Json& json, const std::string& file, Keypoints& keypoints) {
  require(json.is_object(), "{}: frames: {}: must be an object with frame, time_s and points", file,
          json.dump());
  const int number = JsonNode{json, file + ": frames", ""}.value<int>("frame", "a frame number");
  const std::string what = fmt::format("{}: frame {}", file, number);
  require(!keypoints.frames.contains(number), "{} appears twice; keep one of them", what);
  ClickedFrame& frame = keypoints.frames[number];
  frame.time_s = JsonNode{json, what, ""}.value<double>("time_s", "a time in seconds");
  frame.other_json = others(json, {"frame", "time_s", "points"});
  require(json.contains("points") && json.at("points").is_object(),
          "{}: \"points\" must be an object of body parts", what);
  for (const auto& [part_name, click] : json.at("points").items()) {
    try {
      frame[body_part(part_name)] = click_of(click, fmt::format("{}: {}", what, part_name));
    } catch (const Error& error) {
      const std::string message = error.what();
      if (message.starts_with(what)) throw;
      throw Error(fmt::format("{}: {}", what, message));
    }
  }
}

Json parsed(const fs::path& file) {
  return parse_json(read_file(file), file, "a file of clicks, as stride annotate writes it");
}

Json json_of(const Click& click) {
  Json json;
  if (click.state != ClickState::absent) json = {{"x", click.p_px.x()}, {"y", click.p_px.y()}};
  json["state"] = kClickStates[click.state];
  add_others(json, click.other_json);
  return json;
}

Json json_of(int number, const ClickedFrame& frame) {
  Json json{{"frame", number}, {"time_s", frame.time_s}, {"points", Json::object()}};
  for (const BodyPart part : kBodyParts)
    if (frame[part]) json["points"][std::string(name(part))] = json_of(*frame[part]);
  add_others(json, frame.other_json);
  return json;
}

Json json_of(const Eigen::Vector2d& p) { return Json::array({p.x(), p.y()}); }

/// One of `names`, or nothing where the text is empty or missing.
template <typename Enum>
std::optional<Enum> one_of(const Names<Enum>& names, const JsonNode& root, const char* key) {
  const std::string allowed = names.list(" or "),
                    text = root.value_or<std::string>(key, "", allowed);
  const std::optional<Enum> found = names.find(text);
  require(found || text.empty(), "{}: {} = {}: must be {}", root.where, key, text, allowed);
  return found;
}

FrameRange trim_of(const JsonNode& node) {
  const std::string what = node.where + ": trim";
  require(node.json.is_object(), "{} = {}: must name first_frame and last_frame", what,
          node.json.dump());
  const JsonNode trim{node.json, what, ""};
  return {trim.value<int>("first_frame", "a frame number"),
          trim.value<int>("last_frame", "a frame number")};
}

FloorLine floor_line(const JsonNode& node) {
  if (!node.json.is_array() || node.json.size() != 2) node.fail("two points [[x, y], [x, y]]");
  return {point({node.json[0], node.where, node.path}),
          point({node.json[1], node.where, node.path})};
}

}  // namespace

Keypoints load_keypoints(const fs::path& path) {
  const std::string file = path.string();
  const Json json = parsed(path);
  require(json.is_object() && json.value("format", Json()) == kFormat,
          "{}: not a file of clicks: expected \"format\": \"{}\"", file, kFormat);
  const JsonNode root{json, file, ""};
  const int version = root.value<int>("version", "a whole number");
  require(version >= 1 && version <= kVersion,
          "{}: version {}: this program reads up to version {}; use a newer stride", file, version,
          kVersion);
  Keypoints k;
  k.video = root.value<std::string>("video", "the file name of the video");
  k.video_sha256 = root.value<std::string>("video_sha256", "64 hexadecimal digits");
  k.width_px = root.value<int>("width_px", "a whole number of pixels");
  k.height_px = root.value<int>("height_px", "a whole number of pixels");
  k.movement = movement(root.value_or<std::string>("movement", kDefaultMovement, "a name"),
                        file + ": movement")
                   .name;
  k.direction = one_of(kFacings, root, "direction");
  k.near_leg = one_of(kSides, root, "near_leg");
  k.slow_motion = root.value_or<double>("slow_motion", 1, "a factor");
  if (const auto treadmill = root.find("treadmill"))
    k.treadmill = treadmill->as<bool>("true or false");
  if (const auto trim = root.find("trim")) k.trim = trim_of(*trim);
  if (const auto line = root.find("floor_line_px")) k.floor = floor_line(*line);
  if (const auto line = root.find("calibration_line")) k.calibration_line = calibration_line(*line);
  const auto corrects = root.value_or<std::string>("corrects", "", "network");
  require(corrects.empty() || corrects == "network", "{}: corrects = {}: must be network", file,
          corrects);
  k.corrects_network = !corrects.empty();
  k.notes = root.value_or<std::string>("notes", "", "a text");
  require(json.contains("frames") && json.at("frames").is_array(),
          "{}: \"frames\" must be a list of clicked frames", file);
  for (const Json& frame : json.at("frames")) read_frame(frame, file, k);
  k.other_json =
      others(json, {"format", "version", "video", "video_sha256", "width_px", "height_px",
                    "movement", "direction", "near_leg", "slow_motion", "treadmill", "trim",
                    "floor_line_px", "calibration_line", "corrects", "notes", "frames"});
  check(k, file);
  return k;
}

void check(const Keypoints& k, const std::string& what) {
  require(k.width_px > 0 && k.height_px > 0, "{}: frame size {}×{} px: must be positive", what,
          k.width_px, k.height_px);
  require(k.slow_motion >= 0.05 && k.slow_motion <= 100,
          "{}: slow_motion = {}: must be in [0.05, 100] seconds of video a second", what,
          k.slow_motion);
  if (k.trim)
    require(0 <= k.trim->first && k.trim->first <= k.trim->last,
            "{}: trim {}–{}: must be two frame numbers in order", what, k.trim->first,
            k.trim->last);
  if (k.floor)
    require(k.floor->from_px.allFinite() && k.floor->to_px.allFinite() &&
                k.floor->from_px.x() != k.floor->to_px.x(),
            "{}: floor_line_px: must be two points beside one another", what);
  const auto is_inside = [&](const Eigen::Vector2d& p) {
    return p.x() >= -0.5 && p.y() >= -0.5 && p.x() <= k.width_px - 0.5 &&
           p.y() <= k.height_px - 0.5;
  };
  if (const auto& line = k.calibration_line) {
    check(*line, what + ": calibration_line");
    require(is_inside(line->from_px) && is_inside(line->to_px),
            "{}: calibration_line: must lie in the picture of {}×{} px", what, k.width_px,
            k.height_px);
  }
  int before = -1;
  double before_s = -1;
  for (const auto& [frame, clicked] : k.frames) {
    require(frame >= 0, "{}: frame {}: must not be negative", what, frame);
    require(std::isfinite(clicked.time_s) && clicked.time_s >= 0,
            "{}: frame {}: time_s = {}: must be a time from the start of the video", what, frame,
            clicked.time_s);
    require(clicked.time_s > before_s, "{}: frame {}: time_s = {}: must be later than frame {}",
            what, frame, clicked.time_s, before);
    for (const BodyPart part : kBodyParts) {
      if (!clicked.placed(part)) continue;
      const Eigen::Vector2d& p = clicked[part]->p_px;
      require(p.allFinite(), "{}: frame {}: {} = ({}, {}): must be two numbers", what, frame,
              name(part), p.x(), p.y());
      require(is_inside(p),
              "{}: frame {}: {} = ({}, {}): outside the frame of {}×{} px; mark it as absent", what,
              frame, name(part), p.x(), p.y(), k.width_px, k.height_px);
    }
    before = frame;
    before_s = clicked.time_s;
  }
}

std::string text_of(const Keypoints& k) {
  Json json{{"format", kFormat},
            {"version", kVersion},
            {"video", k.video},
            {"video_sha256", k.video_sha256},
            {"width_px", k.width_px},
            {"height_px", k.height_px},
            {"direction", name_or_empty(kFacings, k.direction)},
            {"near_leg", name_or_empty(kSides, k.near_leg)},
            {"slow_motion", k.slow_motion}};
  if (k.movement != kDefaultMovement) json["movement"] = k.movement;
  if (k.treadmill) json["treadmill"] = *k.treadmill;
  if (k.trim) json["trim"] = {{"first_frame", k.trim->first}, {"last_frame", k.trim->last}};
  if (k.floor)
    json["floor_line_px"] = Json::array({json_of(k.floor->from_px), json_of(k.floor->to_px)});
  if (k.calibration_line)
    json["calibration_line"] = {{"frame", k.calibration_line->frame},
                                {"px", Json::array({json_of(k.calibration_line->from_px),
                                                    json_of(k.calibration_line->to_px)})},
                                {"length_m", k.calibration_line->length_m}};
  if (k.corrects_network) json["corrects"] = "network";
  json["notes"] = k.notes;
  add_others(json, k.other_json);
  json["frames"] = Json::array();
  for (const auto& [number, frame] : k.frames) json["frames"].push_back(json_of(number, frame));
  return json_text(json);
}

void save(const Keypoints& k, const fs::path& file) {
  check(k, file.string());
  write_file_atomically(file, text_of(k));
}

void check_belongs_to(const Keypoints& keypoints, const fs::path& video) {
  const std::string hash = sha256_of_file(video);
  require(keypoints.video_sha256 == hash,
          "{}: is another video than the one that was clicked ({}, SHA-256 {:.12}…, not {:.12}…); "
          "use that one, or click this one anew",
          video.string(), keypoints.video, keypoints.video_sha256, hash);
}

fs::path keypoints_file_of(const fs::path& video) {
  return fs::path(video).replace_extension(".keypoints.json");
}

}  // namespace stride
