#include "extract/import/formats/formats.h"
#include "extract/import/parsing/columns.h"
#include "extract/import/parsing/labels.h"
#include "extract/io/error.h"

namespace stride::imports {

DetectedPeople read_dltdv(std::string_view content, const std::string& file,
                          const ImportOptions& options) {
  const std::vector<TextLine> lines = split_lines(content, ',');
  require(!lines.empty(), "{}:1: expected DLTdv's header pt1_cam1_X,pt1_cam1_Y,…", file);
  const PointColumns columns =
      find_point_columns(lines[0], file, {"_cam1_X", "_cam1_Y", "_cam1_confidence"});
  const LabelMap map(columns.labels, options.labels, file);
  DetectedPeople people;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    check_width(lines[i], lines[0], file);
    std::vector<Point> points = columns.points(lines[i], file);
    for (Point& point : points) {
      // Their first pixel is (1, 1): at the top left in DLTdv8, at the bottom left before.
      point.p_px.x() -= 1;
      point.p_px.y() =
          options.y_up_height_px > 0 ? options.y_up_height_px - point.p_px.y() : point.p_px.y() - 1;
    }
    people.push_back({static_cast<int>(i) - 1, "runner", map.parts(points)});
  }
  return people;
}

}  // namespace stride::imports
