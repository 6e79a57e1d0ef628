#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stride::page {

/// Text as HTML shows it.
std::string escaped(std::string_view text);

/// A file, or bytes, as a data: URI; the kind follows from the extension: svg, png, jpg, mp4.
/// Throws Error for another.
std::string data_uri(const std::filesystem::path& file);
std::string data_uri(std::string_view bytes, std::string_view kind);

/// A picture or film with a sentence below it. A film shows its first frame in print, repeats
/// itself and needs no script.
std::string picture(const std::string& uri, std::string_view caption);
std::string film(const std::string& uri, std::string_view caption);

/// A table whose first row is its heading. Cells are HTML.
std::string table(const std::vector<std::vector<std::string>>& rows);

/// Text of fixed width, folded up under its title.
std::string folded(std::string_view title, std::string_view text);

/// What results.md uses of Markdown: headings, paragraphs, lists, tables, indented code. Pictures
/// are left out.
std::string markdown(std::string_view text);

/// The whole file: style inside, nothing loaded from elsewhere.
std::string document(std::string_view title, std::string_view body);

}  // namespace stride::page
