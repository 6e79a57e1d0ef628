#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stride {

struct TextLine {
  int number = 0;  // from 1
  std::vector<std::string> cells;
};

/// A table as a text, before anything is known of its columns.
struct TextTable {
  std::vector<TextLine> comments;  // lines that begin with #, without it, in one cell
  std::vector<TextLine> lines;     // all others that are not blank
};

/// Whatever a spreadsheet or another program makes of a table of numbers: UTF-8 or UTF-16, with a
/// byte order mark or without; lines that end in LF, CR LF or CR; cells separated by comma,
/// semicolon or tab, as the first line is, and quoted as in RFC 4180 (but no line breaks inside
/// quotes); decimal commas where the comma does not separate, which become points; empty cells that
/// a spreadsheet adds at the end of lines, which are left out. White space around a cell too.
/// `separator`: told beforehand; then nothing is left out. Throws Error naming `file` if its UTF-16
/// is broken.
TextTable read_text_table(std::string_view content, const std::string& file, char separator = 0);

/// The text in UTF-8 without a byte order mark, lines ending in LF.
std::string decoded_text(std::string_view content, const std::string& file);

/// A text as the metadata of a table hold it, `# key: text`: as it is or, where that would not read
/// back as the same from one line (line breaks, blanks at an end, …), in double quotes with \n, \t,
/// \", \\ and \xHH.
std::string one_line(std::string_view text);
/// The text that one_line() was given; anything else as it is.
std::string from_one_line(std::string_view written);

/// "line 3, column 5", both from 1: where a byte is, for a message about a text of any kind.
std::string place_of_byte(std::string_view text, std::size_t byte);

/// A cell or line without surrounding blanks, tabs and carriage returns.
std::string_view trimmed(std::string_view text);

/// A finite number, or NaN for an empty cell and for what pandas, R and Excel write where there is
/// none: nan, NA, N/A, null, None, <NA>, …; nothing for anything else.
std::optional<double> cell_number(std::string_view cell);

}  // namespace stride
