#include <cmath>

#include "extract/import/formats/formats.h"
#include "extract/import/parsing/columns.h"
#include "extract/import/parsing/labels.h"
#include "extract/io/error.h"
#include "extract/io/statistics.h"

namespace stride::imports {
namespace {

/// Frames a unit of the time column. Its unit is Kinovea's user's choice: the usual step between
/// rows tells whether it counts seconds, milliseconds or frames, where the video's rate is known.
double frames_per_unit(const std::vector<double>& times, const ImportOptions& options,
                       const std::string& file) {
  if (options.rate_was_given) return options.rate_hz;
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  const double step = median(std::move(steps));
  if (options.rate_hz > 0)
    for (const double per_unit : {options.rate_hz, options.rate_hz / 1000, 1.0}) {
      const double frames = step * per_unit;  // from one row to the next
      if (frames > 0.7 && std::abs(frames - std::round(frames)) < 0.1 * frames) return per_unit;
    }
  require(step > 0, "{}: expected at least two rows, so that the frame rate can be told", file);
  return 1 / step;
}

ImportedFile read_kinovea(std::string_view text, const std::string& file,
                          const ImportOptions& options) {
  const std::vector<TextLine> lines = read_text_table(text, file).lines;
  require(!lines.empty() && lines[0].cells[0] == "Time",
          "{}:1: expected Kinovea's header Time,\"TRACK/0/X\",\"TRACK/0/Y\",…", file);
  PointColumns columns = find_point_columns(lines[0], file, {"/X", "/Y", "/confidence"});
  for (std::string& label : columns.labels)
    if (label.ends_with("/0")) label.resize(label.size() - 2);
  const LabelMap map(columns.labels, options.labels, file);

  std::vector<double> times;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    check_width(lines[i], lines[0], file);
    times.push_back(number_in(lines[i], 0, file));
    require(times.back() >= 0 && (i == 1 || times[i - 1] > times[i - 2]),
            "{}:{}: Time = '{}': expected times that grow, from 0", file, lines[i].number,
            lines[i].cells[0]);
  }
  const double per_unit = frames_per_unit(times, options, file);
  ImportedFile content;
  content.labels = columns.labels;
  content.unused_labels = map.unused(columns.labels);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const double frame = std::round(times[i - 1] * per_unit);
    require(frame <= 1e9,
            "{}:{}: Time = '{}': {} frames after the start; expected the times of "
            "consecutive frames, or say the frame rate with --import-rate",
            file, lines[i].number, lines[i].cells[0], frame);
    content.people.push_back(
        {static_cast<int>(frame), "runner", map.parts(columns.points(lines[i], file))});
  }
  return content;
}

}  // namespace

/// One table of all tracks.
const Format formats::kinovea{
    [](const FileText& text) { return if_so(text.first_cell() == "Time", Certainty::likely); },
    read_kinovea};

}  // namespace stride::imports
