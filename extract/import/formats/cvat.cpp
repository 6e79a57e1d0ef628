#include <algorithm>
#include <cstring>
#include <map>
#include <pugixml.hpp>

#include "extract/import/formats/formats.h"
#include "extract/import/parsing/labels.h"
#include "extract/import/parsing/text.h"
#include "extract/io/error.h"

namespace stride::imports {
namespace {

/// A point that somebody set; what CVAT drew between two of them is left to our tracker.
struct Mark {
  int frame;
  std::string person, label;
  Point point;
};

class CvatReader {
 public:
  CvatReader(std::string_view content, const std::string& file) : content_(content), file_(file) {}

  std::vector<Mark> read() {
    pugi::xml_document document;
    const auto parsed = document.load_buffer(content_.data(), content_.size());
    require(parsed, "{}:{}: not valid XML: {}", file_, line_at(parsed.offset),
            parsed.description());
    const pugi::xml_node root = document.child("annotations");
    require(root, "{}:1: expected CVAT's <annotations>", file_);
    for (const pugi::xml_node track : root.children("track")) read_track(track);
    require(!marks_.empty(),
            "{}: no <track> with <skeleton> or <points> set by hand: expected CVAT for video 1.1",
            file_);
    return std::move(marks_);
  }

 private:
  /// A track is a person if it holds skeletons or tracks, else one point of the only person.
  void read_track(const pugi::xml_node& track) {
    const std::string id = track.attribute("id").value();
    for (const pugi::xml_node skeleton : track.children("skeleton"))
      for (const pugi::xml_node points : skeleton.children("points"))
        read_points(points, frame_of(skeleton), id, points.attribute("label").value());
    for (const pugi::xml_node part : track.children("track"))
      for (const pugi::xml_node points : part.children("points"))
        read_points(points, frame_of(points), id, part.attribute("label").value());
    for (const pugi::xml_node points : track.children("points"))
      read_points(points, frame_of(points), "runner", track.attribute("label").value());
  }

  void read_points(const pugi::xml_node& node, int frame, const std::string& person,
                   const std::string& label) {
    if (!node.attribute("keyframe").as_bool(true)) return;
    Mark mark{frame, person, label, {}};
    if (!node.attribute("outside").as_bool(false)) {
      const std::string_view text = node.attribute("points").value();
      const auto comma = std::min(text.find(','), text.size());
      const auto x = cell_number(text.substr(0, comma));
      const auto y = cell_number(text.substr(std::min(comma + 1, text.size())));
      require(x && y && *x == *x && *y == *y, "{}:{}: points = '{}': expected one point \"x,y\"",
              file_, line_of(node), text);
      mark.point = {
          {*x, *y}, Source::detected, node.attribute("occluded").as_bool(false) ? 0.5 : 1.0};
    }
    marks_.push_back(mark);
  }

  int frame_of(const pugi::xml_node& node) const {
    const std::string text = node.attribute("frame").value();
    const auto frame = cell_number(text);
    require(frame && *frame >= 0 && *frame <= 1e9, "{}:{}: frame = '{}': expected a frame number",
            file_, line_of(node), text);
    return static_cast<int>(*frame);
  }

  long line_of(const pugi::xml_node& node) const { return line_at(node.offset_debug()); }
  long line_at(std::ptrdiff_t offset) const {
    const auto end =
        std::clamp<std::ptrdiff_t>(offset, 0, static_cast<std::ptrdiff_t>(content_.size()));
    return 1 + std::count(content_.begin(), content_.begin() + end, '\n');
  }

  std::string_view content_;
  const std::string& file_;
  std::vector<Mark> marks_;
};

ImportedFile read_cvat(std::string_view text, const std::string& file,
                       const ImportOptions& options) {
  const std::vector<Mark> marks = CvatReader(text, file).read();
  std::vector<std::string> labels;
  for (const Mark& mark : marks)
    if (std::ranges::find(labels, mark.label) == labels.end()) labels.push_back(mark.label);
  const LabelMap map(labels, options.labels, file);

  std::map<std::pair<std::string, int>, std::vector<Point>> frames;
  for (const Mark& mark : marks) {
    auto& points = frames[{mark.person, mark.frame}];
    points.resize(labels.size());
    points[static_cast<std::size_t>(std::ranges::find(labels, mark.label) - labels.begin())] =
        mark.point;
  }
  ImportedFile content;
  content.labels = labels;
  content.unused_labels = map.unused(labels);
  for (const auto& [key, points] : frames)
    content.people.push_back({key.second, key.first, map.parts(points)});
  return content;
}

}  // namespace

/// CVAT for video 1.1: skeletons, tracks in tracks, or a track a point.
const Format formats::cvat{[](const FileText& text) {
                             return if_so(text.is_xml() && text.has("<annotations"),
                                          Certainty::likely);
                           },
                           read_cvat};

}  // namespace stride::imports
