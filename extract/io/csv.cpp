#include "extract/io/csv.h"

#include <fmt/format.h>
#include <iconv.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

#include "extract/io/error.h"

namespace stride {
namespace {

using namespace std::string_view_literals;

std::string from_utf16(std::string_view content, const std::string& file) {
  const iconv_t converter = ::iconv_open("UTF-8", "UTF-16");  // which follows the byte order mark
  // NOLINTNEXTLINE(performance-no-int-to-ptr): POSIX names a failure of iconv_open() so.
  require(converter != reinterpret_cast<iconv_t>(-1), "{}: is in UTF-16; save it as UTF-8", file);
  std::string text(2 * content.size(), '\0');
  char* in = const_cast<char*>(content.data());
  char* out = text.data();
  std::size_t in_left = content.size(), out_left = text.size();
  const bool is_whole =
      ::iconv(converter, &in, &in_left, &out, &out_left) != static_cast<std::size_t>(-1);
  ::iconv_close(converter);
  require(is_whole, "{}: is in UTF-16, broken after {} bytes; save it as UTF-8", file,
          content.size() - in_left);
  text.resize(text.size() - out_left);
  return text;
}

/// Takes the first cell off `line`.
std::string take_cell(std::string_view& line, char separator, bool& more) {
  std::string cell;
  // White space before a quote goes, but not a tab that ends an empty cell.
  const auto start = line.find_first_not_of(separator == '\t' ? " " : " \t");
  if (start != std::string_view::npos && line[start] == '"') {
    line.remove_prefix(start + 1);
    while (!line.empty()) {
      const char c = line.front();
      line.remove_prefix(1);
      if (c != '"') {
        cell += c;
      } else if (!line.empty() && line.front() == '"') {
        cell += '"';
        line.remove_prefix(1);
      } else {
        break;
      }
    }
  }
  const auto end = line.find(separator);
  cell += trimmed(line.substr(0, end));
  more = end != std::string_view::npos;
  line.remove_prefix(more ? end + 1 : line.size());
  return cell;
}

std::vector<std::string> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells;
  for (bool more = true; more;) cells.push_back(take_cell(line, separator, more));
  return cells;
}

/// What cuts the line into most cells.
char separator_of(std::string_view line) {
  constexpr std::array kSeparators{'\t', ';', ','};  // of equals, what is rarer in names
  return *std::ranges::max_element(
      kSeparators, {}, [&](char separator) { return cells_of(line, separator).size(); });
}

/// "3,5" or "-3,5e-2", but not "3" nor "a,b".
bool has_decimal_comma(std::string_view cell) {
  const auto comma = cell.find(',');
  return comma != cell.npos && cell.find(',', comma + 1) == cell.npos &&
         cell.find_first_not_of("+-0123456789,eE") == cell.npos &&
         std::ranges::any_of(cell, [](unsigned char c) { return std::isdigit(c) != 0; });
}

void drop_padding(std::vector<TextLine>& lines) {
  if (lines.empty()) return;
  std::size_t width = lines.front().cells.size();
  while (width > 1 && lines.front().cells[width - 1].empty()) --width;
  for (TextLine& line : lines)
    while (line.cells.size() > width && line.cells.back().empty()) line.cells.pop_back();
}

}  // namespace

std::string decoded_text(std::string_view content, const std::string& file) {
  std::string text;
  if (content.starts_with("\xff\xfe"sv) || content.starts_with("\xfe\xff"sv))
    text = from_utf16(content, file);
  else
    text = content.substr(content.starts_with("\xef\xbb\xbf"sv) ? 3 : 0);
  std::string lines;
  lines.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r')
      lines += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n')
      lines += '\n';
  }
  return lines;
}

TextTable read_text_table(std::string_view content, const std::string& file, char separator) {
  const std::string text = decoded_text(content, file);
  if (const auto nul = text.find('\0'); nul != text.npos)
    throw Error(
        fmt::format("{}: {}: a NUL, as no text has: the file is damaged, or UTF-16 without "
                    "its mark at the beginning",
                    file, place_of_byte(text, nul)));
  const bool is_told = separator != 0;
  TextTable table;
  int number = 0;
  for (std::string_view rest = text; !rest.empty();) {
    const auto newline = rest.find('\n');
    const std::string_view line = rest.substr(0, newline);
    rest.remove_prefix(newline == rest.npos ? rest.size() : newline + 1);
    ++number;
    const std::string_view bare = trimmed(line);
    if (bare.empty()) continue;
    if (bare.front() == '#') {
      std::string_view comment = trimmed(bare.substr(1));
      while (comment.ends_with(',') || comment.ends_with(';')) comment.remove_suffix(1);
      table.comments.push_back({number, {std::string(trimmed(comment))}});
      continue;
    }
    if (separator == 0) separator = separator_of(line);
    table.lines.push_back({number, cells_of(line, separator)});
  }
  if (separator != ',')
    for (TextLine& line : table.lines)
      for (std::string& cell : line.cells)
        if (has_decimal_comma(cell)) std::ranges::replace(cell, ',', '.');
  if (!is_told) drop_padding(table.lines);
  return table;
}

std::string one_line(std::string_view text) {
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  const bool reads_back = std::ranges::none_of(text, is_control) && trimmed(text) == text &&
                          !text.starts_with('"') && !text.ends_with(',') && !text.ends_with(';');
  if (reads_back) return std::string(text);
  std::string written = "\"";
  for (const char c : text) {
    if (c == '\n')
      written += "\\n";
    else if (c == '\t')
      written += "\\t";
    else if (c == '"' || c == '\\')
      written += {'\\', c};
    else if (is_control(static_cast<unsigned char>(c)))
      written += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      written += c;
  }
  return written + '"';
}

std::string from_one_line(std::string_view written) {
  std::string as_it_is(written);
  if (written.size() < 2 || !written.starts_with('"') || !written.ends_with('"')) return as_it_is;
  std::string text;
  for (std::string_view rest = written.substr(1, written.size() - 2); !rest.empty();) {
    const char c = rest.front();
    rest.remove_prefix(1);
    if (c == '"') return as_it_is;
    if (c != '\\') {
      text += c;
      continue;
    }
    if (rest.empty()) return as_it_is;
    const char escaped = rest.front();
    rest.remove_prefix(1);
    if (escaped == 'n' || escaped == 't') {
      text += escaped == 'n' ? '\n' : '\t';
    } else if (escaped == '"' || escaped == '\\') {
      text += escaped;
    } else if (escaped == 'x' && rest.size() >= 2) {
      unsigned char code = 0;
      const auto [end, error] = std::from_chars(rest.data(), rest.data() + 2, code, 16);
      if (error != std::errc() || end != rest.data() + 2) return as_it_is;
      text += static_cast<char>(code);
      rest.remove_prefix(2);
    } else {
      return as_it_is;
    }
  }
  return text;
}

std::string place_of_byte(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const std::size_t end = before.rfind('\n');
  return fmt::format("line {}, column {}", 1 + std::ranges::count(before, '\n'),
                     end == before.npos ? before.size() + 1 : before.size() - end);
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::optional<double> cell_number(std::string_view cell) {
  std::string_view text = trimmed(cell);
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  constexpr std::array kNone{""sv,     "nan"sv,  "-nan"sv, "na"sv,   "n/a"sv,
                             "null"sv, "none"sv, "<na>"sv, "#n/a"sv, "#na"sv};
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  if (std::ranges::find(kNone, lower) != kNone.end()) return kMissing;
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

}  // namespace stride
