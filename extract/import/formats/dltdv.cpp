#include "extract/import/formats/formats.h"
#include "extract/import/parsing/columns.h"
#include "extract/import/parsing/labels.h"
#include "extract/io/error.h"

namespace stride::imports {
namespace {

ImportedFile read_dltdv(std::string_view text, const std::string& file,
                        const ImportOptions& options) {
  const std::vector<TextLine> lines = read_text_table(text, file).lines;
  require(!lines.empty(), "{}:1: expected DLTdv's header pt1_cam1_X,pt1_cam1_Y,…", file);
  const PointColumns columns =
      find_point_columns(lines[0], file, {"_cam1_X", "_cam1_Y", "_cam1_confidence"});
  const LabelMap map(columns.labels, options.labels, file);
  ImportedFile content;
  content.labels = columns.labels;
  content.unused_labels = map.unused(columns.labels);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    check_width(lines[i], lines[0], file);
    std::vector<Point> points = columns.points(lines[i], file);
    // Their first pixel is (1, 1): at the top left in DLTdv8, at the bottom left before (--y-up).
    for (Point& point : points) point.p_px.array() -= 1;
    content.people.push_back({static_cast<int>(i) - 1, "runner", map.parts(points)});
  }
  return content;
}

}  // namespace

/// DLTdv and Argus xypts, first camera.
const Format formats::dltdv{
    [](const FileText& text) { return if_so(text.header_has("_cam1_X"), Certainty::likely); },
    read_dltdv};

}  // namespace stride::imports
