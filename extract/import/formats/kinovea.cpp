#include <cmath>

#include "extract/import/formats/formats.h"
#include "extract/import/parsing/columns.h"
#include "extract/import/parsing/labels.h"
#include "extract/io/error.h"
#include "extract/io/statistics.h"

namespace stride::imports {
namespace {

/// The usual step of the time column, whose unit is Kinovea's user's choice.
double median_step(const std::vector<double>& times, const std::string& file) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  require(!steps.empty(), "{}: expected at least two rows, so that the frame rate can be told",
          file);
  return median(std::move(steps));
}

}  // namespace

DetectedPeople read_kinovea(std::string_view content, const std::string& file,
                            const ImportOptions& options) {
  // Separator and decimal sign follow the language of the computer that wrote the file.
  const bool semicolons = content.substr(0, content.find('\n')).find(';') != content.npos;
  const char decimal_sign = semicolons && content.find(',') != content.npos ? ',' : '.';
  std::vector<TextLine> lines = split_lines(content, semicolons ? ';' : ',');
  require(!lines.empty() && lines[0].cells[0] == "Time",
          "{}:1: expected Kinovea's header Time,\"TRACK/0/X\",\"TRACK/0/Y\",…", file);
  PointColumns columns = find_point_columns(lines[0], file, {"/X", "/Y", "/confidence"});
  for (std::string& label : columns.labels)
    if (label.ends_with("/0")) label.resize(label.size() - 2);
  const LabelMap map(columns.labels, options.labels, file);

  std::vector<double> times;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    check_width(lines[i], lines[0], file);
    times.push_back(number_in(lines[i], 0, file, decimal_sign));
    require(times.back() >= 0 && (i == 1 || times[i - 1] > times[i - 2]),
            "{}:{}: Time = '{}': expected times that grow, from 0", file, lines[i].number,
            lines[i].cells[0]);
  }
  const double step = options.rate_hz > 0 ? 1 / options.rate_hz : median_step(times, file);
  DetectedPeople people;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const double frame = std::round(times[i - 1] / step);
    require(frame <= 1e9,
            "{}:{}: Time = '{}': {} frames after the start; expected the times of "
            "consecutive frames, or say the frame rate with --import-rate",
            file, lines[i].number, lines[i].cells[0], frame);
    std::vector<Point> points = columns.points(lines[i], file, decimal_sign);
    if (options.y_up_height_px > 0)
      for (Point& point : points) point.p_px.y() = options.y_up_height_px - 1 - point.p_px.y();
    people.push_back({static_cast<int>(frame), "runner", map.parts(points)});
  }
  return people;
}

}  // namespace stride::imports
