#include "extract/import/parsing/columns.h"

#include <algorithm>

#include "extract/io/error.h"

namespace stride::imports {

std::array<std::size_t, 3>& PointColumns::of(const std::string& label) {
  const auto known = std::ranges::find(labels, label);
  const auto i = static_cast<std::size_t>(known - labels.begin());
  if (known == labels.end()) {
    labels.push_back(label);
    columns.push_back({kNone, kNone, kNone});
  }
  return columns[i];
}

std::vector<Point> PointColumns::points(const TextLine& line, const std::string& file) const {
  std::vector<Point> points(labels.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [x, y, confidence] = columns[i];
    points[i].p_px = {number_in(line, x, file), number_in(line, y, file)};
    const double value = confidence == kNone ? 1 : number_in(line, confidence, file);
    points[i].confidence = value > 0 ? value : 0;
  }
  return points;
}

PointColumns find_point_columns(const TextLine& header, const std::string& file,
                                const std::array<std::string_view, 3>& suffixes) {
  PointColumns found;
  for (std::size_t c = 0; c < header.cells.size(); ++c) {
    const std::string_view cell = header.cells[c];
    for (std::size_t k = 0; k < suffixes.size(); ++k) {
      if (!cell.ends_with(suffixes[k]) || cell.size() == suffixes[k].size()) continue;
      std::size_t& column =
          found.of(std::string(cell.substr(0, cell.size() - suffixes[k].size())))[k];
      require(column == PointColumns::kNone, "{}:{}: column '{}' appears twice", file,
              header.number, cell);
      column = c;
      break;
    }
  }
  for (std::size_t i = found.labels.size(); i-- > 0;) {
    const auto [x, y, confidence] = found.columns[i];
    require((x == PointColumns::kNone) == (y == PointColumns::kNone),
            "{}:{}: expected both '{}{}' and '{}{}'", file, header.number, found.labels[i],
            suffixes[0], found.labels[i], suffixes[1]);
    if (x != PointColumns::kNone) continue;  // "instance.score" is no point
    found.labels.erase(found.labels.begin() + static_cast<std::ptrdiff_t>(i));
    found.columns.erase(found.columns.begin() + static_cast<std::ptrdiff_t>(i));
  }
  require(!found.labels.empty(), "{}:{}: expected columns of points, named like 'knee_r{}'", file,
          header.number, suffixes[0]);
  return found;
}

void check_width(const TextLine& line, const TextLine& header, const std::string& file) {
  require(line.cells.size() == header.cells.size(), "{}:{}: {} cells, but the header has {}", file,
          line.number, line.cells.size(), header.cells.size());
}

}  // namespace stride::imports
