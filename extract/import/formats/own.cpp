#include <algorithm>

#include "extract/import/formats/formats.h"
#include "extract/import/parsing/columns.h"
#include "extract/import/parsing/json.h"
#include "extract/import/parsing/labels.h"
#include "extract/io/error.h"

namespace stride::imports {

DetectedPeople read_own_csv(std::string_view content, const std::string& file,
                            const ImportOptions& options) {
  std::vector<TextLine> lines = split_lines(content, ',');
  std::erase_if(lines, [](const TextLine& line) { return line.cells[0].starts_with('#'); });
  require(!lines.empty() && lines[0].cells[0] == "frame",
          "{}:1: expected a header frame,time_s,knee_r_x,knee_r_y,knee_r_confidence,…", file);
  const PointColumns columns = find_point_columns(lines[0], file, {"_x", "_y", "_confidence"});
  const LabelMap map(columns.labels, options.labels, file);
  DetectedPeople people;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    check_width(lines[i], lines[0], file);
    people.push_back(
        {frame_in(lines[i], 0, file), "runner", map.parts(columns.points(lines[i], file))});
  }
  return people;
}

DetectedPeople read_own_json(std::string_view content, const std::string& file) {
  const JsonFile json(content, file);
  const JsonValue root = json.root(), frames = root["frames"];
  if (root["version"].integer() != 1) root["version"].fail("version 1");
  DetectedPeople people;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    DetectedPerson person{frames[i]["frame"].integer(), "runner", {}};
    if (person.frame < 0) frames[i]["frame"].fail("the number of a frame");
    const JsonValue points = frames[i]["points"];
    for (const std::string& label : points.keys()) {
      const auto part = std::ranges::find(kBodyParts, label, [](BodyPart p) { return name(p); });
      if (part == kBodyParts.end()) points[label].fail("a body part of ours by its name");
      const std::vector<double> numbers = points[label].numbers();
      if (numbers.size() != 3) points[label].fail("[x, y, confidence]");
      person.points[index(*part)] = {{numbers[0], numbers[1]}, numbers[2]};
    }
    people.push_back(person);
  }
  return people;
}

}  // namespace stride::imports
