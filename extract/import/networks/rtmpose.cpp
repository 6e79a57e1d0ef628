#include <fmt/format.h>

#include <algorithm>

#include "extract/import/formats/formats.h"
#include "extract/import/networks/frames.h"
#include "extract/import/parsing/labels.h"

namespace stride::imports {
namespace {

constexpr int kDeepest = 4;  // lists in lists

/// One person: K points [x, y], and K scores.
void add_person(int frame, const JsonValue& keypoints, const std::optional<JsonValue>& scores,
                const std::string& file, ImportedFile& content) {
  const std::vector<std::string> labels = layout_of(keypoints.size());
  if (labels.empty())
    keypoints.fail(fmt::format("17, 26 or 133 points ({} here)", keypoints.size()));
  const std::vector<double> sure =
      scores ? scores->numbers() : std::vector<double>(keypoints.size(), 1);
  if (sure.size() != keypoints.size()) scores->fail("as many scores as keypoints");
  std::vector<Point> points(keypoints.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    const std::vector<double> xy = keypoints[k].numbers();
    if (xy.size() < 2) keypoints[k].fail("two coordinates");
    if (sure[k] > 0)
      points[k] = {{xy[0], xy[1]}, Source::detected, kSurestNetwork * std::min(sure[k], 1.0)};
  }
  content.people.push_back({frame, "", LabelMap(labels, {}, file).parts(points)});
}

bool is_list_of_numbers(const JsonValue& value) {
  return value.is_array() && value.size() > 0 && value[0].is_number();
}

/// keypoints and scores of one person, or of a list of people.
void add_people(int frame, const JsonValue& keypoints, const std::optional<JsonValue>& scores,
                const std::string& file, ImportedFile& content, int deepest = kDeepest) {
  if (keypoints.size() == 0) return;
  if (deepest == 0) keypoints.fail("people with lists of [x, y]");
  if (is_list_of_numbers(keypoints[0])) return add_person(frame, keypoints, scores, file, content);
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    if (keypoints[i].is_object()) {
      add_people(frame, keypoints[i]["keypoints"],
                 first_of(keypoints[i], {"keypoint_scores", "scores"}), file, content, deepest - 1);
      continue;
    }
    const auto own = scores && i < scores->size() ? std::optional((*scores)[i]) : std::nullopt;
    if (scores && !own) scores->fail("scores of every person");
    add_people(frame, keypoints[i], own, file, content, deepest - 1);
  }
}

void add_frame(int frame, const JsonValue& value, const std::string& file, ImportedFile& content,
               int deepest = kDeepest) {
  if (value.is_null()) return;
  if (deepest == 0) value.fail("a list of people, not lists in lists");
  if (const auto people = first_of(value, {"instances", "people", "persons"})) {
    for (std::size_t i = 0; i < people->size(); ++i)
      add_frame(frame, (*people)[i], file, content, deepest - 1);
    return;
  }
  if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      add_frame(frame, value[i], file, content, deepest - 1);
    return;
  }
  add_people(frame, value["keypoints"], first_of(value, {"keypoint_scores", "scores"}), file,
             content);
}

ImportedFile read_rtmpose(std::string_view text, const std::string& file,
                          const ImportOptions& /*options*/) {
  const JsonFile json(text, file);
  const JsonValue root = json.root();
  ImportedFile content;
  // A list of people is one frame.
  if (root.is_array() && root.size() > 0 && root[0].has("keypoint_scores") &&
      !first_of(root[0], {"frame", "frame_id", "frame_idx"})) {
    add_frame(0, root, file, content);
    return content;
  }
  for (const auto& [frame, value] : frames_of(root)) add_frame(frame, value, file, content);
  return content;
}

}  // namespace

/// RTMPose: predictions of MMPose's inferencer, and keypoints and scores as rtmlib returns them.
const Format formats::rtmpose{
    [](const FileText& text) {
      const bool scored =
          text.has("\"keypoints\"") && (text.has("\"scores\"") || text.has("\"keypoint_scores\""));
      return if_so(is_of_a_network(text) && !text.has("\"instance_info\"") &&
                       (scored || text.has("\"instances\"")),
                   Certainty::certain);
    },
    read_rtmpose, /*in_folders=*/true};

}  // namespace stride::imports
