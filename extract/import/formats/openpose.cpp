#include <fmt/format.h>

#include <filesystem>

#include "extract/import/formats/formats.h"
#include "extract/import/parsing/labels.h"
#include "extract/import/parsing/text.h"
#include "extract/io/json/json_file.h"

namespace stride::imports {
namespace {

ImportedFile read_openpose(std::string_view text, const std::string& file,
                           const ImportOptions& /*options*/) {
  const int frame = last_number(std::filesystem::path(file).stem().string()).value_or(0);
  const JsonFile json(text, file);
  const JsonValue people = json.root()["people"];
  ImportedFile content;
  for (std::size_t i = 0; i < people.size(); ++i) {
    const JsonValue keypoints = people[i]["pose_keypoints_2d"];
    const std::vector<double> numbers = keypoints.numbers();
    if (numbers.empty()) continue;  // a face or hands without a body
    const std::vector<std::string> labels = layout_of(numbers.size() / 3);
    if (numbers.size() % 3 != 0 || labels.empty())
      keypoints.fail(fmt::format("3 numbers for each of 15, 18 or 25 points ({} numbers here)",
                                 numbers.size()));
    std::vector<Point> points(labels.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double* xyc = &numbers[3 * k];
      if (xyc[2] > 0 && (xyc[0] != 0 || xyc[1] != 0))
        points[k] = {{xyc[0], xyc[1]}, Source::detected, xyc[2]};
    }
    DetectedPerson& person = content.people.emplace_back();
    person.frame = frame;
    if (people[i].has("person_id")) {
      const JsonValue id = people[i]["person_id"];
      if (id.is_array() && id.size() == 1 && id[0].is_number() && id[0].number() >= 0)
        person.id = fmt::format("{}", id[0].number());
    }
    person.points = LabelMap(labels, {}, file).parts(points);
  }
  return content;
}

}  // namespace

/// One frame (15, 18 or 25 points).
const Format formats::openpose{[](const FileText& text) {
                                 return if_so(text.is_object() && text.has("\"people\""),
                                              Certainty::likely);
                               },
                               read_openpose, /*in_folders=*/true};

}  // namespace stride::imports
