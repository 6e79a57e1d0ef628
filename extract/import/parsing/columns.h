#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "extract/import/parsing/text.h"
#include "extract/skeleton/trajectory.h"

namespace stride::imports {

/// The columns of a table's points.
struct PointColumns {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  std::vector<std::string> labels;
  std::vector<std::array<std::size_t, 3>> columns;  // of x, y and confidence, which may be kNone

  /// The columns of `label`; adds it (kNone) if it is new.
  std::array<std::size_t, 3>& of(const std::string& label);

  /// The points of one line. Without a confidence column a point has confidence 1.
  std::vector<Point> points(const TextLine& line, const std::string& file,
                            char decimal_sign = '.') const;
};

/// Finds columns named LABEL + suffix. Throws Error if a label has x without y or y without x, or
/// one of them twice, or if there is no such label.
PointColumns find_point_columns(const TextLine& header, const std::string& file,
                                const std::array<std::string_view, 3>& suffixes);

/// Throws Error unless the line has as many cells as the header.
void check_width(const TextLine& line, const TextLine& header, const std::string& file);

}  // namespace stride::imports
