#include "extract/annotation/change_json.h"

#include <nlohmann/json.hpp>

#include "extract/io/error.h"

namespace stride::annotation {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Eigen::Vector2d& p) { return Json::array({p.x(), p.y()}); }
Eigen::Vector2d point_of(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>()};
}

int frame_of(const Json& json) {
  const auto frame = json.get<double>();
  require(frame >= 0 && frame <= 1e9, "frame {}: must not be negative or beyond 10⁹", frame);
  return static_cast<int>(frame);
}

Json json_of(const std::optional<Click>& click) {
  if (!click) return nullptr;
  Json json{{"state", kClickStates[click->state]}, {"p_px", json_of(click->p_px)}};
  if (!click->other_json.empty()) json["other"] = click->other_json;
  return json;
}

std::optional<Click> click_of(const Json& json) {
  if (json.is_null()) return std::nullopt;
  Click click;
  click.p_px = point_of(json.at("p_px"));
  click.state = kClickStates.find(json.at("state").get<std::string>()).value_or(click.state);
  click.other_json = json.value("other", "");
  require(click.other_json.empty() || Json::parse(click.other_json).is_object(),
          "\"other\" = {}: must be an object", click.other_json);
  return click;
}

Json json_of(const ClipSettings& s) {
  Json json{{"direction", name_or_empty(kFacings, s.direction)},
            {"near_leg", name_or_empty(kSides, s.near_leg)},
            {"slow_motion", s.slow_motion},
            {"notes", s.notes}};
  if (s.corrects_network) json["corrects_network"] = true;
  if (s.movement != ClipSettings().movement) json["movement"] = s.movement;
  if (s.treadmill) json["treadmill"] = *s.treadmill;
  if (s.trim) json["trim"] = Json::array({s.trim->first, s.trim->last});
  if (s.floor) json["floor"] = Json::array({json_of(s.floor->from_px), json_of(s.floor->to_px)});
  if (const auto& line = s.calibration_line)
    json["calibration_line"] = {{"frame", line->frame},
                                {"from_px", json_of(line->from_px)},
                                {"to_px", json_of(line->to_px)},
                                {"length_m", line->length_m}};
  return json;
}

ClipSettings settings_of(const Json& json) {
  ClipSettings s;
  s.direction = kFacings.find(json.at("direction").get<std::string>());
  s.near_leg = kSides.find(json.at("near_leg").get<std::string>());
  s.slow_motion = json.at("slow_motion");
  s.notes = json.at("notes");
  s.corrects_network = json.value("corrects_network", false);
  if (json.contains("movement")) s.movement = json.at("movement");
  if (json.contains("treadmill")) s.treadmill = json.at("treadmill").get<bool>();
  if (json.contains("trim"))
    s.trim = {frame_of(json.at("trim").at(0)), frame_of(json.at("trim").at(1))};
  if (json.contains("floor"))
    s.floor = {point_of(json.at("floor").at(0)), point_of(json.at("floor").at(1))};
  if (json.contains("calibration_line")) {
    const Json& line = json.at("calibration_line");
    s.calibration_line = {frame_of(line.at("frame")), point_of(line.at("from_px")),
                          point_of(line.at("to_px")), line.at("length_m").get<double>()};
  }
  return s;
}

}  // namespace

std::string line_of(const Change& change) {
  Json json{{"what", change.what}, {"clicks", Json::array()}};
  for (const ClickChange& edit : change.clicks)
    json["clicks"].push_back({{"frame", edit.frame},
                              {"video_time_s", edit.video_time_s},
                              {"part", name(edit.part)},
                              {"click", json_of(edit.click)}});
  if (change.settings) json["settings"] = json_of(*change.settings);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Change change_of(const std::string& line, const std::string& where) {
  try {
    const Json json = Json::parse(line);
    Change change;
    change.what = json.at("what");
    for (const Json& edit : json.at("clicks"))
      change.clicks.push_back({frame_of(edit.at("frame")), edit.at("video_time_s"),
                               body_part(edit.at("part").get<std::string>()),
                               click_of(edit.at("click"))});
    if (json.contains("settings")) change.settings = settings_of(json.at("settings"));
    return change;
  } catch (const Json::exception&) {
    throw Error(fmt::format("{}: not a line of an annotation journal", where));
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", where, error.what()));
  }
}

}  // namespace stride::annotation
