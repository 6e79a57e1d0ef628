#include <fmt/format.h>

#include "extract/import/formats/formats.h"
#include "extract/import/parsing/labels.h"
#include "extract/io/json/json_file.h"

namespace stride::imports {
namespace {

/// From meta_info.keypoint_id2name where the file has it, else by the number of points.
std::vector<std::string> labels_of(const JsonValue& root, const JsonValue& keypoints) {
  std::vector<std::string> labels = layout_of(keypoints.size());
  if (root.has("meta_info") && root["meta_info"].has("keypoint_id2name")) {
    const JsonValue names = root["meta_info"]["keypoint_id2name"];
    labels.assign(keypoints.size(), "");
    for (std::size_t k = 0; k < labels.size(); ++k) {
      const std::string id = fmt::format("{}", k);
      if (names.has(id)) labels[k] = names[id].text();
    }
  }
  if (labels.empty())
    keypoints.fail(fmt::format("17, 26 or 133 points ({} here)", keypoints.size()));
  return labels;
}

ImportedFile read_mmpose(std::string_view text, const std::string& file,
                         const ImportOptions& options) {
  const JsonFile json(text, file);
  const JsonValue root = json.root(), frames = root["instance_info"];
  ImportedFile content;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const int frame = frames[i]["frame_id"].integer() - 1;  // they count from 1
    if (frame < 0) frames[i]["frame_id"].fail("the number of a frame, from 1");
    const JsonValue instances = frames[i]["instances"];
    for (std::size_t k = 0; k < instances.size(); ++k) {
      const JsonValue keypoints = instances[k]["keypoints"];
      const std::vector<double> scores = instances[k]["keypoint_scores"].numbers();
      if (scores.size() != keypoints.size())
        instances[k]["keypoint_scores"].fail("as many scores as keypoints");
      std::vector<Point> points(scores.size());
      for (std::size_t j = 0; j < points.size(); ++j) {
        const std::vector<double> xy = keypoints[j].numbers();
        if (xy.size() < 2) keypoints[j].fail("two coordinates");
        if (scores[j] > 0) points[j] = {{xy[0], xy[1]}, Source::detected, scores[j]};
      }
      const LabelMap map(labels_of(root, keypoints), options.labels, file);
      content.people.push_back({frame, "", map.parts(points)});
    }
  }
  return content;
}

}  // namespace

/// What MMPose's demo writes with --save-predictions.
const Format formats::mmpose{[](const FileText& text) {
                               return if_so(text.is_object() && text.has("\"instance_info\""),
                                            Certainty::likely);
                             },
                             read_mmpose};

}  // namespace stride::imports
