#include <algorithm>

#include "extract/import/formats/formats.h"
#include "extract/import/parsing/columns.h"
#include "extract/import/parsing/labels.h"
#include "extract/io/csv.h"
#include "extract/io/error.h"
#include "extract/io/json/json_file.h"

namespace stride::imports {
namespace {

/// What the metadata of a trajectory says of its video.
struct Declared {
  std::string video, sha256;
  int width_px = 0, height_px = 0;
};
Declared declared_in(const TextTable& table) {
  Declared declared;
  for (const TextLine& comment : table.comments) {
    const std::string_view line = comment.cells.front();
    const auto value = [&](std::string_view key) -> std::string_view {
      return line.starts_with(key) ? trimmed(line.substr(key.size())) : std::string_view();
    };
    const auto size = [&](std::string_view key, int& px) {
      const double number = cell_number(value(key)).value_or(0);
      if (number >= 1 && number < 100000) px = static_cast<int>(number);
    };
    if (const auto name = value("video:"); !name.empty()) declared.video = from_one_line(name);
    if (const auto hash = value("video_sha256:"); !hash.empty()) declared.sha256 = hash;
    size("width_px:", declared.width_px);
    size("height_px:", declared.height_px);
  }
  return declared;
}

ImportedFile read_own_csv(std::string_view text, const std::string& file,
                          const ImportOptions& options) {
  const TextTable table = read_text_table(text, file);
  const std::vector<TextLine>& lines = table.lines;
  require(!lines.empty() && lines[0].cells[0] == "frame",
          "{}:1: expected a header frame,time_s,knee_r_x,knee_r_y,knee_r_confidence,…", file);
  const PointColumns columns = find_point_columns(lines[0], file, {"_x", "_y", "_confidence"});
  const LabelMap map(columns.labels, options.labels, file);
  ImportedFile content;
  content.labels = columns.labels;
  content.unused_labels = map.unused(columns.labels);
  const Declared declared = declared_in(table);
  content.video = declared.video;
  content.video_sha256 = declared.sha256;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    check_width(lines[i], lines[0], file);
    content.people.push_back({frame_in(lines[i], 0, file), "runner",
                              map.parts(columns.points(lines[i], file)), declared.width_px,
                              declared.height_px});
  }
  return content;
}

ImportedFile read_own_json(std::string_view text, const std::string& file,
                           const ImportOptions& /*options*/) {
  const JsonFile json(text, file);
  const JsonValue root = json.root(), frames = root["frames"];
  if (root["version"].integer() != 1) root["version"].fail("version 1");
  ImportedFile content;
  if (root.has("video_sha256")) {
    content.video = root["video"].text();
    content.video_sha256 = root["video_sha256"].text();
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    DetectedPerson person{frames[i]["frame"].integer(), "runner", {}};
    if (root.has("width_px") && root.has("height_px")) {
      person.width_px = root["width_px"].integer();
      person.height_px = root["height_px"].integer();
    }
    if (person.frame < 0) frames[i]["frame"].fail("the number of a frame");
    const JsonValue points = frames[i]["points"];
    for (const std::string& label : points.keys()) {
      const auto part = std::ranges::find(kBodyParts, label, [](BodyPart p) { return name(p); });
      if (part == kBodyParts.end()) points[label].fail("a body part of ours by its name");
      const std::vector<double> numbers = points[label].numbers();
      if (numbers.size() != 3) points[label].fail("[x, y, confidence]");
      person.points[index(*part)] = {{numbers[0], numbers[1]}, Source::detected, numbers[2]};
    }
    content.people.push_back(person);
  }
  return content;
}

}  // namespace

/// What export_points() writes, and NAME.trajectory.csv.
const Format formats::csv{
    [](const FileText& text) { return if_so(text.first_cell() == "frame", Certainty::perhaps); },
    read_own_csv};
/// What export_points() writes.
const Format formats::json{[](const FileText& text) {
                             return if_so(text.is_object() && text.has("\"stride points\""),
                                          Certainty::perhaps);
                           },
                           read_own_json};

}  // namespace stride::imports
