#include "extract/import/networks/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace stride::imports {
namespace {

constexpr int kMostFrames = 1'000'000'000;

std::optional<int> number_of(std::string_view digits) {
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size() || number < 0)
    return std::nullopt;
  return number;
}

int said_number(const JsonValue& frame, int otherwise) {
  const auto said =
      first_of(frame, {"frame", "frame_id", "frame_idx", "frame_index", "frame_number", "frame_num",
                       "frameNumber", "frameIndex", "frameId"});
  if (!said) return otherwise;
  if (!said->is_number() || said->integer() < 0 || said->integer() > kMostFrames)
    said->fail("the number of a frame");
  return said->integer();
}

}  // namespace

bool is_of_a_network(const FileText& text) {
  return text.is_json() && !text.has("\"pose_keypoints_2d\"");
}

std::optional<JsonValue> first_of(const JsonValue& value,
                                  std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (value.has(name) && !value[name].is_null()) return value[name];
  return std::nullopt;
}

std::string name_of(const std::optional<JsonValue>& value) {
  if (!value) return "";
  return value->is_number() ? fmt::format("{}", value->number())
         : value->is_text() ? value->text()
                            : "";
}

std::vector<FrameValue> frames_of(const JsonValue& root, int deepest) {
  if (deepest == 0) root.fail("a list of frames");
  std::vector<FrameValue> frames;
  if (root.is_array()) {
    for (std::size_t i = 0; i < root.size(); ++i)
      frames.push_back({said_number(root[i], static_cast<int>(i)), root[i]});
    return frames;
  }
  if (const auto list = first_of(root, {"frames", "results", "predictions", "poses", "data",
                                        "detections", "pose_data", "landmarks"});
      list && (list->is_array() || list->is_object()))
    return frames_of(*list, deepest - 1);
  for (const std::string& key : root.keys())
    if (const auto number = number_of(key)) frames.push_back({*number, root[key]});
  if (frames.empty()) root.fail("a list of frames, or an object with one under \"frames\"");
  std::ranges::stable_sort(frames, {}, &FrameValue::frame);
  return frames;
}

void tell_normalised(ImportedFile& content) {
  double largest = 0;
  bool any = false;
  for (const DetectedPerson& person : content.people)
    for (const Point& point : person.points)
      if (point.present()) {
        any = true;
        largest = std::max(largest, point.p_px.lpNorm<Eigen::Infinity>());
      }
  if (!any || largest > 2) return;
  for (DetectedPerson& person : content.people) person.width_px = person.height_px = 1;
}

}  // namespace stride::imports
