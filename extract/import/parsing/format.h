#pragma once

#include <string>
#include <string_view>

#include "extract/import/parsing/detections.h"
#include "extract/io/csv.h"

namespace stride::imports {

/// A file's text, as a format is told from it.
class FileText {
 public:
  FileText(std::string_view text, const std::string& file);

  bool is_list() const { return first_ == '['; }    // of JSON
  bool is_object() const { return first_ == '{'; }  // of JSON
  bool is_json() const { return is_list() || is_object(); }
  bool is_xml() const { return first_ == '<'; }
  bool has(std::string_view part) const { return text_.find(part) != text_.npos; }

  /// A table's first line; no cells where it is no table.
  const TextLine& header() const { return header_; }
  std::string_view first_cell() const;
  bool header_has(std::string_view part) const;  // in one of its cells

 private:
  std::string_view text_;
  char first_ = 0;  // that is no blank
  TextLine header_;
};

/// How surely a text is of a format: the surest one reads it, the first in the list of equals.
enum class Certainty { no, perhaps, likely, certain };

inline Certainty if_so(bool is_it, Certainty certainty) {
  return is_it ? certainty : Certainty::no;
}

struct Format {
  Certainty (*is_it)(const FileText& text);
  /// All detected people. `file` is for error messages. Throws Error with file, line and what was
  /// expected.
  ImportedFile (*read)(std::string_view text, const std::string& file,
                       const ImportOptions& options);
  bool in_folders = false;  // also as a folder of files of a frame each
};

}  // namespace stride::imports
