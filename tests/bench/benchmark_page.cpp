// Runs the commands of BENCHMARK.md and writes what they print into the page.
//
//     <!-- KIND: COMMAND -->
//     … replaced …
//     <!-- end -->
//
// KIND is `data` (computed from committed results, the same on every machine), `quick` (measured
// within a minute) or `long`. --check runs the `data` commands only, changes nothing, and fails
// where the page says something else.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <regex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "extract/io/error.h"
#include "extract/io/file.h"

namespace stride {
namespace {

struct PageOptions {
  std::string page;
  std::string path;  // folders of the programs, separated by colons
  std::vector<std::string> kinds;
  bool check = false;
};

std::string output_of(const std::string& command, const std::string& path) {
  const std::string in_shell = fmt::format("export PATH='{}':\"$PATH\"; {}", path, command);
  std::FILE* pipe = ::popen(in_shell.c_str(), "r");
  require(pipe != nullptr, "{}: cannot be started", command);
  std::string output;
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, n);
  const int status = ::pclose(pipe);
  require(status == 0, "{}: ended with {}", command, WEXITSTATUS(status));
  return output;
}

/// As Markdown: tables as they are, anything else as code.
std::string as_markdown(const std::string& output) {
  return output.starts_with('|') ? output : fmt::format("```\n{}```\n", output);
}

std::string this_machine_today() {
  std::string processor = "unknown processor";
  std::ifstream info("/proc/cpuinfo");
  const std::regex model("model name\\s*: (.*)");
  for (std::string line; std::getline(info, line);)
    if (std::smatch match; std::regex_match(line, match, model)) processor = match[1];
  const std::time_t now = std::time(nullptr);
  return fmt::format("{}, {} virtual cores, {:%d %B %Y}", processor,
                     std::thread::hardware_concurrency(), fmt::localtime(now));
}

/// What stands between the markers of a block.
std::string block(const std::string& kind, const std::string& command, const std::string& output) {
  std::string text = fmt::format("\n`{}`\n\n{}\n", command, as_markdown(output));
  if (kind != "data") text += fmt::format("*{}*\n\n", this_machine_today());
  return text;
}

/// The page with the blocks of the chosen kinds made anew.
std::string updated(const std::string& page, const PageOptions& options) {
  const std::regex begin("<!-- (data|quick|long): (.*) -->");
  const std::string end = "<!-- end -->";
  std::string result;
  std::size_t at = 0;
  const auto first = std::sregex_iterator(page.begin(), page.end(), begin);
  for (auto match = first; match != std::sregex_iterator(); ++match) {
    const auto body = static_cast<std::size_t>(match->position() + match->length()) + 1;
    const std::size_t stop = page.find(end, body);
    const std::string kind = match->str(1), command = match->str(2);
    require(stop != std::string::npos, "{}: has no {} after it", command, end);
    result += page.substr(at, body - at);
    if (std::ranges::find(options.kinds, kind) == options.kinds.end())
      result += page.substr(body, stop - body);
    else
      result += block(kind, command, output_of(command, options.path));
    at = stop;
  }
  require(at > 0, "{}: has no block <!-- data|quick|long: COMMAND -->", options.page);
  return result + page.substr(at);
}

/// The first line that differs.
std::string difference(const std::string& page, const std::string& now) {
  std::istringstream old_lines(page), new_lines(now);
  std::string was, is;
  while (std::getline(old_lines, was) && std::getline(new_lines, is))
    if (was != is) break;
  return fmt::format("the page says\n  {}\nthe committed results say\n  {}", was, is);
}

void run(const PageOptions& options) {
  const std::string page = read_file(options.page);
  const std::string now = updated(page, options);
  if (!options.check) return write_file_atomically(options.page, now);
  require(page == now, "{}: {}\nbring it up to date with the target `benchmark`", options.page,
          difference(page, now));
}

}  // namespace
}  // namespace stride

int main(int argc, char** argv) try {
  stride::PageOptions options;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--check")
      options.check = true, options.kinds = {"data"};
    else if (argument == "data" || argument == "quick" || argument == "long")
      options.kinds.push_back(argument);
    else if (options.page.empty())
      options.page = argument;
    else
      options.path = argument;
  }
  stride::require(!options.path.empty(), "benchmark_page PAGE FOLDER[:FOLDER...] --check|KIND...");
  stride::run(options);
} catch (const std::exception& error) {
  fmt::print(stderr, "benchmark_page: {}\n", error.what());
  return 1;
}
