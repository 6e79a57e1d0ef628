#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "extract/import/formats/formats.h"
#include "extract/import/networks/frames.h"
#include "extract/import/networks/ultralytics.h"
#include "extract/import/parsing/labels.h"
#include "extract/import/parsing/text.h"
#include "extract/io/error.h"

namespace stride::imports {
namespace {

constexpr std::size_t kPoints = 17;  // of COCO

std::vector<std::string> labels_for(const JsonValue& keypoints, std::size_t points) {
  std::vector<std::string> labels = layout_of(points);
  if (labels.empty()) keypoints.fail(fmt::format("17 points ({} here)", points));
  return labels;
}

/// Of {"x": […], "y": […], "visible": […]}, or a list of [x, y, confidence].
std::vector<Point> points_of(const JsonValue& keypoints) {
  std::vector<Point> points;
  const auto add = [&](double x, double y, double confidence) {
    Point& point = points.emplace_back();
    if (confidence > 0 && (x != 0 || y != 0))
      point = {{x, y}, Source::detected, kSurestNetwork * std::min(confidence, 1.0)};
  };
  if (keypoints.is_array()) {
    for (std::size_t k = 0; k < keypoints.size(); ++k) {
      const std::vector<double> xyc = keypoints[k].numbers();
      if (xyc.size() < 2) keypoints[k].fail("x, y and a confidence");
      add(xyc[0], xyc[1], xyc.size() > 2 ? xyc[2] : 1);
    }
    return points;
  }
  const std::vector<double> x = keypoints["x"].numbers(), y = keypoints["y"].numbers();
  const auto visible = first_of(keypoints, {"visible", "confidence", "conf"});
  const std::vector<double> c = visible ? visible->numbers() : std::vector<double>(x.size(), 1);
  if (y.size() != x.size() || c.size() != x.size()) keypoints.fail("as many y and visible as x");
  for (std::size_t k = 0; k < x.size(); ++k) add(x[k], y[k], c[k]);
  return points;
}

void add_person(const JsonValue& detection, int frame, const std::string& file,
                ImportedFile& content) {
  const auto keypoints = first_of(detection, {"keypoints"});
  if (!keypoints) return;  // a box alone
  const std::vector<Point> points = points_of(*keypoints);
  const LabelMap map(labels_for(*keypoints, points.size()), {}, file);
  content.people.push_back(
      {frame, name_of(first_of(detection, {"track_id", "id"})), map.parts(points)});
}

/// Everybody on a frame: a detection, a list of them, or either under one of the usual names.
void add_people(const JsonValue& value, int frame, const std::string& file, ImportedFile& content,
                int deepest = 4) {
  if (value.is_null()) return;
  if (deepest == 0) value.fail("a list of detections, not lists in lists");
  if (value.has("keypoints")) return add_person(value, frame, file, content);
  if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      add_people(value[i], frame, file, content, deepest - 1);
    return;
  }
  if (const auto inner =
          first_of(value, {"detections", "objects", "results", "people", "persons", "predictions"}))
    add_people(*inner, frame, file, content, deepest - 1);
}

void add_file(const JsonValue& root, const std::string& file, ImportedFile& content) {
  // A list of detections is one frame unless they say theirs; a list of lists has a frame each.
  const bool one_frame = root.is_array() && root.size() > 0 && root[0].has("keypoints") &&
                         !first_of(root[0], {"frame", "frame_id", "frame_idx", "frame_index"});
  if (one_frame) return add_people(root, 0, file, content);
  for (const auto& [frame, value] : frames_of(root)) add_people(value, frame, file, content);
}

ImportedFile read_ultralytics(std::string_view text, const std::string& file,
                              const ImportOptions& /*options*/) {
  ImportedFile content;
  const std::size_t first = text.find_first_not_of(" \t\n"), end = text.find("]\n[");
  if (first != text.npos && text[first] == '[' && end != text.npos) {  // a line a frame
    std::istringstream lines{std::string(text)};
    int frame = 0;
    for (std::string line; std::getline(lines, line);) {
      if (trimmed(line).empty()) continue;
      const JsonFile json(line, fmt::format("{}:{}", file, frame + 1));
      add_people(json.root(), frame++, file, content);
    }
  } else {
    const JsonFile json(text, file);
    add_file(json.root(), file, content);
  }
  tell_normalised(content);
  return content;
}

}  // namespace

/// Ultralytics' YOLO pose: what Results.to_json() gives, for each frame in a list, or a line a
/// frame.
const Format formats::ultralytics{[](const FileText& text) {
                                    return if_so(is_of_a_network(text) && text.has("\"visible\""),
                                                 Certainty::certain);
                                  },
                                  read_ultralytics, /*in_folders=*/true};

ImportedFile read_ultralytics_labels(std::string_view text, const std::string& file, int frame) {
  ImportedFile content;
  const TextTable table = read_text_table(text, file, ' ');
  for (const TextLine& line : table.lines) {
    constexpr std::size_t kBox = 5;  // class, x, y, width, height
    const std::size_t numbers = line.cells.size() < kBox ? 0 : line.cells.size() - kBox;
    const bool flat = numbers >= 2 * kPoints && numbers <= 2 * kPoints + 2;
    require(flat || (numbers >= 3 * kPoints && numbers <= 3 * kPoints + 2),
            "{}:{}: {} numbers: expected a class, a box and 17 points of 2 or 3 numbers, as yolo "
            "pose predict save_txt=True writes",
            file, line.number, line.cells.size());
    const std::size_t each = flat ? 2 : 3;
    std::vector<Point> points(kPoints);
    for (std::size_t k = 0; k < kPoints; ++k) {
      const std::size_t at = kBox + each * k;
      const double x = number_in(line, at, file), y = number_in(line, at + 1, file),
                   c = flat ? 1 : number_in(line, at + 2, file);
      if (c > 0 && (x != 0 || y != 0))
        points[k] = {{x, y}, Source::detected, kSurestNetwork * std::min(c, 1.0)};
    }
    const std::size_t rest = numbers - each * kPoints;  // a confidence, and a track
    const LabelMap map(layout_of(kPoints), {}, file);
    DetectedPerson& person = content.people.emplace_back();
    person.frame = frame;
    if (rest == 2) person.id = line.cells.back();
    person.points = map.parts(points);
  }
  tell_normalised(content);
  return content;
}

}  // namespace stride::imports
