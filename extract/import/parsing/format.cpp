#include "extract/import/parsing/format.h"

#include <algorithm>

namespace stride::imports {

FileText::FileText(std::string_view text, const std::string& file) : text_(text) {
  const auto start = text.find_first_not_of(" \t\n");
  if (start == text.npos) return;
  first_ = text[start];
  if (is_json() || is_xml()) return;
  const TextTable table = read_text_table(text.substr(0, text.find('\n', 16384)), file);
  if (!table.lines.empty()) header_ = table.lines.front();
}

std::string_view FileText::first_cell() const {
  return header_.cells.empty() ? std::string_view() : header_.cells.front();
}

bool FileText::header_has(std::string_view part) const {
  return std::ranges::any_of(header_.cells,
                             [&](const std::string& cell) { return cell.find(part) != cell.npos; });
}

}  // namespace stride::imports
