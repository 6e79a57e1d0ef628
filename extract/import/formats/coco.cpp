#include <fmt/format.h>

#include <map>

#include "extract/import/formats/formats.h"
#include "extract/import/parsing/labels.h"
#include "extract/import/parsing/text.h"
#include "extract/io/json/json_file.h"

namespace stride::imports {
namespace {

/// 12, "12.jpg" or "run_0012.png".
int frame_of(const JsonValue& image) {
  if (image.is_number() && image.integer() >= 0) return image.integer();
  const std::string name = image.is_text() ? image.text() : "";
  const auto number = last_number(name.substr(0, name.rfind('.')));
  if (!number) image.fail("the number of a frame, or a file name with one");
  return *number;
}

/// Person as results name it: a number, or a list of one.
std::string id_of(const JsonValue& entry) {
  if (!entry.has("idx")) return "";
  const JsonValue idx = entry["idx"];
  const JsonValue id = idx.is_array() && idx.size() > 0 ? idx[0] : idx;
  return id.is_number() ? fmt::format("{}", id.number()) : "";
}

/// Three numbers a point; the third is a score, or in annotations 0 not labelled, 1 hidden, 2 seen.
std::vector<Point> points_of(const JsonValue& keypoints, bool annotated) {
  const std::vector<double> numbers = keypoints.numbers();
  if (numbers.empty() || numbers.size() % 3 != 0) keypoints.fail("3 numbers for each point");
  std::vector<Point> points(numbers.size() / 3);
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double* xys = &numbers[3 * k];
    if (xys[2] > 0)
      points[k] = {{xys[0], xys[1]}, Source::detected, annotated ? xys[2] / 2 : xys[2]};
  }
  return points;
}

std::vector<std::string> layout_or_fail(const JsonValue& keypoints) {
  std::vector<std::string> labels = layout_of(keypoints.size() / 3);
  if (labels.empty() || labels.size() == 15 || labels.size() == 25)
    keypoints.fail(
        fmt::format("17, 26, 133 or 136 points of 3 numbers ({} numbers here)", keypoints.size()));
  return labels;
}

ImportedFile read_results(const JsonValue& root, const std::string& file) {
  ImportedFile content;
  for (std::size_t i = 0; i < root.size(); ++i) {
    const JsonValue entry = root[i], keypoints = entry["keypoints"];
    const LabelMap map(layout_or_fail(keypoints), {}, file);
    content.people.push_back(
        {frame_of(entry["image_id"]), id_of(entry), map.parts(points_of(keypoints, false))});
  }
  return content;
}

struct Image {
  int frame = -1;  // not said
  int width_px = 0, height_px = 0;
};

std::map<int, Image> images_of(const JsonValue& root) {
  std::map<int, Image> images;  // by id
  const auto size = [](const JsonValue& image, const char* key) {
    const int px = image.has(key) && image[key].is_number() ? image[key].integer() : 0;
    return px > 0 && px < 100000 ? px : 0;
  };
  for (std::size_t i = 0; root.has("images") && i < root["images"].size(); ++i) {
    const JsonValue image = root["images"][i];
    images[image["id"].integer()] = {image.has("file_name") ? frame_of(image["file_name"]) : -1,
                                     size(image, "width"), size(image, "height")};
  }
  return images;
}

ImportedFile read_annotations(const JsonValue& root, const std::string& file,
                              const ImportOptions& options) {
  const std::map<int, Image> images = images_of(root);
  std::vector<std::string> labels;
  for (std::size_t i = 0; root.has("categories") && i < root["categories"].size(); ++i) {
    const JsonValue category = root["categories"][i];
    if (!category.has("keypoints") || !labels.empty()) continue;
    for (std::size_t k = 0; k < category["keypoints"].size(); ++k)
      labels.push_back(category["keypoints"][k].text());
  }
  const JsonValue annotations = root["annotations"];
  ImportedFile content;
  for (std::size_t i = 0; i < annotations.size(); ++i) {
    const JsonValue entry = annotations[i], keypoints = entry["keypoints"];
    const LabelMap map(labels.empty() ? layout_or_fail(keypoints) : labels, options.labels, file);
    const int id = entry["image_id"].integer();
    const auto known = images.find(id);
    const Image image = known != images.end() ? known->second : Image{};
    const int frame = image.frame >= 0 ? image.frame : id;
    if (frame < 0) entry["image_id"].fail("the number of a frame");
    content.people.push_back(
        {frame, "", map.parts(points_of(keypoints, true)), image.width_px, image.height_px});
    content.labels = labels;
    content.unused_labels = map.unused(labels);
  }
  return content;
}

ImportedFile read_coco(std::string_view content, const std::string& file,
                       const ImportOptions& options) {
  const JsonFile json(content, file);
  const JsonValue root = json.root();
  return root.is_object() ? read_annotations(root, file, options) : read_results(root, file);
}

}  // namespace

/// Results (a list), annotations (an object).
const Format formats::coco{
    [](const FileText& text) {
      return if_so(text.is_list() || (text.is_object() && text.has("\"annotations\"")),
                   Certainty::perhaps);
    },
    read_coco};
/// Results of COCO with the person's number or box.
const Format formats::alphapose{
    [](const FileText& text) {
      return if_so(text.is_list() && (text.has("\"idx\"") || text.has("\"box\"")),
                   Certainty::likely);
    },
    read_coco};

}  // namespace stride::imports
