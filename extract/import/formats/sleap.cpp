#include <algorithm>

#include "extract/import/formats/formats.h"
#include "extract/import/parsing/columns.h"
#include "extract/import/parsing/labels.h"
#include "extract/io/error.h"

namespace stride::imports {
namespace {

ImportedFile read_sleap(std::string_view text, const std::string& file,
                        const ImportOptions& options) {
  const std::vector<TextLine> lines = read_text_table(text, file).lines;
  require(!lines.empty(), "{}:1: expected SLEAP's header track,frame_idx,…", file);
  const TextLine& header = lines.front();
  const auto column = [&](const char* name) {
    const auto found = std::ranges::find(header.cells, name);
    require(found != header.cells.end(), "{}:{}: expected a column '{}'", file, header.number,
            name);
    return static_cast<std::size_t>(found - header.cells.begin());
  };
  const std::size_t track = column("track"), frame = column("frame_idx");
  const PointColumns columns = find_point_columns(header, file, {".x", ".y", ".score"});
  const LabelMap map(columns.labels, options.labels, file);
  ImportedFile content;
  content.labels = columns.labels;
  content.unused_labels = map.unused(columns.labels);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    check_width(lines[i], header, file);
    content.people.push_back({frame_in(lines[i], frame, file), lines[i].cells[track],
                              map.parts(columns.points(lines[i], file))});
  }
  return content;
}

}  // namespace

/// Analysis CSV.
const Format formats::sleap{
    [](const FileText& text) {
      return if_so(text.first_cell() == "track" && text.header_has("frame_idx"), Certainty::likely);
    },
    read_sleap};

}  // namespace stride::imports
