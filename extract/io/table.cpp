#include "extract/io/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "extract/io/csv.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/outputs.h"

namespace stride {
namespace {

std::optional<double> number(std::string_view text) {
  if (const auto value = cell_number(text)) return value;
  double value = 0;  // ours may be infinite
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The format and version of a table in one of its comments, or metadata.
void read_comment(const TextLine& comment, Table& table, const std::string& file) {
  const std::string_view line = comment.cells.front();
  if (table.format.empty() && line.starts_with("stride ")) {
    const auto space = line.rfind(' ');
    const auto version = number(line.substr(space + 1));
    require(space > 7 && version.has_value() && std::abs(*version) < 1e9,
            "{}:{}: expected '# stride FORMAT VERSION', found '# {}'", file, comment.number, line);
    table.format = trimmed(line.substr(7, space - 7));
    table.version = static_cast<int>(*version);
  } else if (const auto colon = line.find(':'); colon != std::string_view::npos) {
    table.metadata.emplace_back(trimmed(line.substr(0, colon)),
                                from_one_line(trimmed(line.substr(colon + 1))));
  }
}

/// Reads the lines of a table: `# ` lines first, then the header, then the rows.
Table parse(std::string_view content, const std::string& file) {
  const TextTable text = read_text_table(content, file);
  Table table;
  table.file = file;
  for (const TextLine& comment : text.comments) read_comment(comment, table, file);
  require(!text.lines.empty(), "{}: has no header line: expected comma-separated names of columns",
          file);
  const TextLine& header = text.lines.front();
  table.columns = header.cells;
  for (auto name = table.columns.begin(); name != table.columns.end(); ++name)
    require(std::find(table.columns.begin(), name, *name) == name,
            "{}:{}: column '{}' appears twice", file, header.number, *name);
  for (std::size_t l = 1; l < text.lines.size(); ++l) {
    const TextLine& line = text.lines[l];
    require(line.cells.size() == table.columns.size(),
            "{}:{}: {} cells, but the header names {} columns", file, line.number,
            line.cells.size(), table.columns.size());
    std::vector<double>& row = table.rows.emplace_back();
    row.reserve(line.cells.size());
    for (std::size_t i = 0; i < line.cells.size(); ++i) {
      const auto value = number(line.cells[i]);
      require(value.has_value(), "{}:{}: column {} = '{}': must be a number or empty", file,
              line.number, table.columns[i], line.cells[i]);
      row.push_back(*value);
    }
  }
  return table;
}

}  // namespace

bool Table::has_meta(std::string_view key) const {
  return std::ranges::any_of(metadata, [&](const auto& entry) { return entry.first == key; });
}

const std::string& Table::meta(std::string_view key) const {
  for (const auto& [name, value] : metadata)
    if (name == key) return value;
  throw Error(fmt::format("{}: the line '# {}: …' is missing", file, key));
}

double Table::meta_number(std::string_view key) const {
  const std::string& text = meta(key);
  const auto value = number(text);
  require(value.has_value(), "{}: {} = '{}': must be a number", file, key, text);
  return *value;
}

void Table::set_meta(std::string_view key, std::string_view value) {
  for (auto& [name, old] : metadata)
    if (name == key) {
      old = value;
      return;
    }
  metadata.emplace_back(key, value);
}

bool Table::has_column(std::string_view name) const {
  return std::ranges::find(columns, name) != columns.end();
}

std::size_t Table::column(std::string_view name) const {
  const auto found = std::ranges::find(columns, name);
  require(found != columns.end(), "{}: column '{}' is missing; the file has {}", file, name,
          fmt::join(columns, ", "));
  return static_cast<std::size_t>(found - columns.begin());
}

Table load_csv(const std::filesystem::path& file) {
  require_plain_text(file, "a table (CSV)");
  return parse(read_file(file), file.string());
}

Table load_table(const std::filesystem::path& file, std::string_view format, int version,
                 std::string_view cure) {
  const FileKind kind = kind_of(file);
  require(!is_binary(kind) && !is_json(kind), "{}: is {}, a {} file is needed{}{}", file.string(),
          name(kind), format, cure.empty() ? "" : "; ", cure);
  Table table = load_csv(file);
  require(!table.format.empty(),
          "{}: not a file of ours: expected '# stride {} {}' in the first line", file.string(),
          format, version);
  require(table.format == format, "{}: is a stride {} file, a {} file is needed{}{}", file.string(),
          table.format, format, cure.empty() ? "" : "; ", cure);
  require(table.version >= 1 && table.version <= version,
          "{}: {} version {}: this program reads up to version {}; use a newer stride",
          file.string(), format, table.version, version);
  return table;
}

void save(const Table& table, const std::filesystem::path& file) {
  std::string out;
  if (!table.format.empty()) out += fmt::format("# stride {} {}\n", table.format, table.version);
  for (const auto& [key, value] : table.metadata)
    out += fmt::format("# {}: {}\n", key, one_line(value));
  out += fmt::format("{}\n", fmt::join(table.columns, ","));
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) out += ',';
      if (!std::isnan(row[i])) out += fmt::format("{}", row[i]);
    }
    out += '\n';
  }
  write_file_atomically(file, out);
}

}  // namespace stride
