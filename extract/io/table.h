#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stride {

/// A CSV file with a preamble, the format of all our time series:
///
///     # stride trajectory 1          format and version
///     # unit: px                     metadata, `key: value`
///     frame,time_s,pelvis_x          names of the columns
///     0,0,312.5                      numbers; an empty cell is NaN
///
/// Numbers are written with the fewest digits that read back as the same double.
struct Table {
  std::string format;  // "trajectory"
  int version = 1;
  std::vector<std::pair<std::string, std::string>> metadata;  // in file order
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;  // each as long as `columns`
  std::string file;                       // where it was loaded from, for error messages

  /// The value of a metadata key. Throws Error naming the file and the key if it is absent.
  const std::string& meta(std::string_view key) const;
  /// The same as a number. Throws Error naming file, key and value if it is not one.
  double meta_number(std::string_view key) const;
  bool has_meta(std::string_view key) const;
  void set_meta(std::string_view key, std::string_view value);

  /// Index of a column. Throws Error naming the file, the column and those that exist.
  std::size_t column(std::string_view name) const;
  bool has_column(std::string_view name) const;
};

/// Reads a table and checks that its format is `format` of at most `version`. Errors name file,
/// line and what was expected; for another format they say which it is.
Table load_table(const std::filesystem::path& file, std::string_view format, int version,
                 std::string_view cure = {});

/// Reads a plain CSV of numbers (no preamble required; `#` lines are skipped): the files that
/// others write.
Table load_csv(const std::filesystem::path& file);

/// Writes a table atomically.
void save(const Table& table, const std::filesystem::path& file);

}  // namespace stride
