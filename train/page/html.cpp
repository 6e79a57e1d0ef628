#include "train/page/html.h"

#include <fmt/format.h>

#include <map>
#include <sstream>

#include "extract/io/data_file.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/gnuplot.h"

namespace stride::page {
namespace {

constexpr std::string_view kStyle = R"(
:root { color-scheme: light; }
body { font: 16px/1.5 system-ui, sans-serif; color: #222; background: #fff; max-width: 62rem;
       margin: 0 auto; padding: 1rem; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: .5rem 0; }
h2 { font-size: 1.2rem; margin: 2rem 0 .5rem; border-bottom: 1px solid #ddd; }
.verdict { font-size: 1.1rem; border-left: .3rem solid var(--first); padding: .3rem .8rem; background: #f3f7fa; }
figure { margin: 1rem 0; break-inside: avoid; }
figure img, figure video { max-width: 100%; height: auto; display: block; }
figcaption { color: #555; font-size: .9rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: .2rem .7rem .2rem 0; text-align: left; border-bottom: 1px solid #eee; }
td img { display: block; max-width: 9rem; }
pre { font-size: .8rem; overflow-x: auto; background: #f7f7f7; padding: .6rem; }
.strip { display: flex; flex-wrap: wrap; gap: .5rem; }
.strip figure { margin: 0; width: 12rem; }
footer { margin-top: 3rem; color: #777; font-size: .85rem; }
@media (max-width: 30rem) {
  table { font-size: .8rem; }
  th, td { padding-right: .4rem; }
  .strip figure { width: calc(50% - .25rem); }
}
@media print { body { max-width: none; font-size: 11pt; } details > pre { display: none; } }
)";

/// `code` and **strong** of a line, escaped.
std::string inline_markup(std::string_view line) {
  std::string text = escaped(line);
  for (const auto& [mark, tag] : {std::pair{"**", "strong"}, std::pair{"`", "code"}}) {
    const std::string sign = mark;
    for (std::size_t from = 0;;) {
      const std::size_t open = text.find(sign, from);
      const std::size_t close =
          open == std::string::npos ? open : text.find(sign, open + sign.size());
      if (close == std::string::npos) break;
      const std::string inside = text.substr(open + sign.size(), close - open - sign.size());
      const std::string whole = fmt::format("<{0}>{1}</{0}>", tag, inside);
      text.replace(open, close + sign.size() - open, whole);
      from = open + whole.size();
    }
  }
  return text;
}

std::vector<std::string> cells(std::string_view line) {
  std::vector<std::string> row;
  std::istringstream in{std::string(line.substr(1))};
  for (std::string cell; std::getline(in, cell, '|');) row.push_back(inline_markup(cell));
  return row;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) {
    if (c == '&')
      html += "&amp;";
    else if (c == '<')
      html += "&lt;";
    else if (c == '>')
      html += "&gt;";
    else if (c == '"')
      html += "&quot;";
    else
      html += c;
  }
  return html;
}

std::string data_uri(std::string_view bytes, std::string_view kind) {
  static const std::map<std::string_view, std::string_view> kinds{
      {"svg", "image/svg+xml"}, {"png", "image/png"}, {"jpg", "image/jpeg"}, {"mp4", "video/mp4"}};
  const auto type = kinds.find(kind);
  require(type != kinds.end(), "page: a file of kind '{}' cannot be shown; svg, png, jpg, mp4 can",
          kind);
  return fmt::format("data:{};base64,{}", type->second, base64_of(bytes));
}

std::string data_uri(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  return data_uri(read_file(file), std::string_view(extension).substr(extension.empty() ? 0 : 1));
}

std::string picture(const std::string& uri, std::string_view caption) {
  return fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
                     uri, escaped(caption), escaped(caption));
}

std::string film(const std::string& uri, std::string_view caption) {
  return fmt::format(
      "<figure><video src=\"{}\" controls loop muted autoplay playsinline></video>"
      "<figcaption>{}</figcaption></figure>\n",
      uri, escaped(caption));
}

std::string table(const std::vector<std::vector<std::string>>& rows) {
  std::string html = "<div class=\"wide\"><table>\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    html += "<tr>";
    for (const std::string& cell : rows[i])
      html += fmt::format("<{0}>{1}</{0}>", i == 0 ? "th" : "td", cell);
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string folded(std::string_view title, std::string_view text) {
  return fmt::format("<details><summary>{}</summary><pre>{}</pre></details>\n", escaped(title),
                     escaped(text));
}

std::string markdown(std::string_view text) {
  std::string html;
  std::vector<std::vector<std::string>> rows;
  bool in_list = false;
  std::istringstream in{std::string(text)};
  const auto close = [&] {
    if (!rows.empty()) html += table(rows);
    rows.clear();
    if (std::exchange(in_list, false)) html += "</ul>\n";
  };
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("|-") || line.starts_with("| -")) continue;
    if (line.starts_with("|")) {
      rows.push_back(cells(line));
      continue;
    }
    if (line.starts_with("- ")) {
      if (!std::exchange(in_list, true)) html += "<ul>\n";
      html += fmt::format("<li>{}</li>\n", inline_markup(line.substr(2)));
      continue;
    }
    close();
    if (line.empty() || line.starts_with("![")) continue;
    if (line.starts_with("# ")) continue;  // the page has its own
    if (line.starts_with("## "))
      html += fmt::format("<h2>{}</h2>\n", inline_markup(line.substr(3)));
    else if (line.starts_with("    "))
      html += fmt::format("<pre>{}</pre>\n", escaped(line.substr(4)));
    else
      html += fmt::format("<p>{}</p>\n", inline_markup(line));
  }
  close();
  return html;
}

std::string document(std::string_view title, std::string_view body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"generator\" content=\"stride\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n"
      "<title>{0}</title>\n<style>:root {{ --first: {4}; "
      "}}{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n{2}"
      "<footer>Written by stride {3}. SI units. This page is one file: it needs no network and no "
      "scripts.</footer>\n</body>\n</html>\n",
      escaped(title), kStyle, body, escaped(version()), kLineColours[0]);
}

}  // namespace stride::page
