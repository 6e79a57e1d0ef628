#include <algorithm>
#include <cmath>

#include "extract/import/formats/formats.h"
#include "extract/import/parsing/columns.h"
#include "extract/import/parsing/labels.h"
#include "extract/io/error.h"

namespace stride::imports {
namespace {

/// Column of a value in the header's second and third line; throws if it is not named there.
std::size_t header_column(const TextLine& names, std::string_view name, const std::string& file) {
  for (std::size_t c = 0; c < names.cells.size(); ++c)
    if (names.cells[c] == name) return c;
  throw Error(fmt::format("{}:{}: expected '{}' among the names of TRC's second line", file,
                          names.number, name));
}

/// Marker names stand over the first of their three columns.
PointColumns markers(const TextLine& names, const std::string& file) {
  PointColumns columns;
  for (std::size_t c = 2; c < names.cells.size(); ++c)
    if (!names.cells[c].empty()) columns.of(names.cells[c]) = {c, c + 1, PointColumns::kNone};
  require(!columns.labels.empty() && names.cells[0] == "Frame#" && names.cells[1] == "Time",
          "{}:{}: expected Frame#, Time and names of markers, separated by tabs", file,
          names.number);
  return columns;
}

/// Files with frames from 0 (Sports2D) and from 1 (Vicon, OpenSim) both begin at time 0 of their
/// video, so the time decides.
int frame_at(const TextLine& line, double rate_hz, const std::string& file) {
  const int numbered = frame_in(line, 0, file);
  const double timed = std::round(number_in(line, 1, file) * rate_hz);
  return timed == numbered || timed == numbered - 1 ? static_cast<int>(timed) : numbered;
}

/// How many rows the header announces; 0 if it does not say (NaN counts as nothing too).
double announced_frames(const std::vector<TextLine>& lines) {
  const auto& names = lines[1].cells;
  const auto column =
      static_cast<std::size_t>(std::ranges::find(names, "NumFrames") - names.begin());
  return column < lines[2].cells.size() ? cell_number(lines[2].cells[column]).value_or(0) : 0;
}

ImportedFile read_trc(std::string_view text, const std::string& file,
                      const ImportOptions& options) {
  const std::vector<TextLine> lines = read_text_table(text, file, '\t').lines;
  require(
      lines.empty() || lines[0].cells.size() > 1 || !lines[0].cells[0].starts_with("PathFileType "),
      "{}:1: cells are separated by blanks: TRC separates them by tabs; save it so again", file);
  require(lines.size() > 4 && lines[0].cells[0] == "PathFileType",
          "{}:1: expected the five header lines of TRC, the first with PathFileType", file);
  const auto header_cell = [&](std::string_view name) {
    const std::size_t c = header_column(lines[1], name, file);
    require(c < lines[2].cells.size(), "{}:{}: expected a value of {}", file, lines[2].number,
            name);
    return c;
  };
  const double rate_hz = number_in(lines[2], header_cell("DataRate"), file);
  require(rate_hz > 0, "{}:{}: DataRate = {}: expected a rate in Hz", file, lines[2].number,
          rate_hz);
  const std::string& units = lines[2].cells[header_cell("Units")];

  const PointColumns columns = markers(lines[3], file);
  const LabelMap map(columns.labels, options.labels, file);
  ImportedFile content;
  content.labels = columns.labels;
  content.unused_labels = map.unused(columns.labels);
  double largest = 0;
  const int rows = static_cast<int>(lines.size()) - 5;
  const double announced = announced_frames(lines);
  if (announced > rows)
    content.warnings.push_back(fmt::format(
        "NumFrames = {}, but {} rows are there: the file was cut off{}", announced, rows,
        text.ends_with('\n') ? "" : ", perhaps inside its last number; that row is left out"));
  const std::size_t end = lines.size() - (announced > rows && !text.ends_with('\n') ? 1 : 0);
  for (std::size_t i = 5; i < end; ++i) {
    TextLine line = lines[i];
    line.cells.resize(std::max(line.cells.size(), lines[3].cells.size() + 2));
    content.people.push_back(
        {frame_at(line, rate_hz, file), "runner", map.parts(columns.points(line, file))});
    for (const Point& point : content.people.back().points)
      if (point.present()) largest = std::max(largest, point.p_px.lpNorm<Eigen::Infinity>());
  }
  // Sports2D says "m" even where it means pixels; nobody runs in a picture of 20 pixels.
  require(units != "mm" && (units != "m" || largest > 20),
          "{}:{}: Units = {}: these are not pixels; expected the file with _px in its name", file,
          lines[2].number, units);
  return content;
}

}  // namespace

/// Sports2D's pixels, OpenSim's form.
const Format formats::trc{[](const FileText& text) {
                            return if_so(text.first_cell().starts_with("PathFileType"),
                                         Certainty::likely);
                          },
                          read_trc};

}  // namespace stride::imports
