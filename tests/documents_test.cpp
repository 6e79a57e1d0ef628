// The Markdown files: links lead to something, and every number of the first page is in
// BENCHMARK.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = STRIDE_SOURCE_DIR;

std::string read(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<fs::path> markdown_files() {
  const std::set<std::string> skipped{".git", "build", "runs"};
  std::vector<fs::path> files;
  for (auto entry = fs::recursive_directory_iterator(kRoot);
       entry != fs::recursive_directory_iterator(); ++entry) {
    if (entry.depth() == 0 && skipped.contains(entry->path().filename()))
      entry.disable_recursion_pending();
    else if (entry->path().extension() == ".md")
      files.push_back(entry->path());
  }
  return files;
}

/// Without fenced code, in which nothing is a link or a heading.
std::string prose_of(const fs::path& file) {
  std::istringstream lines(read(file));
  std::string prose;
  bool code = false;
  for (std::string line; std::getline(lines, line);) {
    const bool fence = line.starts_with("```");
    if (!code && !fence) prose += line + "\n";
    if (fence) code = !code;
  }
  return prose;
}

/// The anchor that GitHub makes of a heading.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == ' ')
      anchor += '-';
    else if (byte >= 0x80 || std::isalnum(byte) != 0 || c == '-' || c == '_')
      anchor += static_cast<char>(std::tolower(byte));
  }
  return anchor;
}

std::set<std::string> anchors_of(const fs::path& file) {
  std::set<std::string> anchors;
  std::istringstream lines(prose_of(file));
  const std::regex heading("#+ (.*)");
  for (std::string line; std::getline(lines, line);)
    if (std::smatch match; std::regex_match(line, match, heading))
      anchors.insert(anchor_of(match[1]));
  return anchors;
}

TEST(Documents, LinksLeadToFilesAndHeadings) {
  const std::vector<fs::path> files = markdown_files();
  ASSERT_GT(files.size(), 15U);
  const std::regex link(R"(\]\(([^)#\s]*)(#([^)\s]*))?\))");
  for (const fs::path& file : files) {
    const std::string prose = prose_of(file);
    for (auto match = std::sregex_iterator(prose.begin(), prose.end(), link);
         match != std::sregex_iterator(); ++match) {
      const std::string path = match->str(1), anchor = match->str(3);
      if (path.find("://") != std::string::npos) continue;
      const fs::path target = path.empty() ? file : file.parent_path() / path;
      EXPECT_TRUE(fs::exists(target)) << file << ": " << match->str();
      if (anchor.empty() || target.extension() != ".md" || !fs::exists(target)) continue;
      EXPECT_TRUE(anchors_of(target).contains(anchor)) << file << ": " << match->str();
    }
  }
}

/// A preset that names a suite of an older name would leave it out without a word.
std::string sources_of_tests() {
  std::string tests;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(kRoot / "tests"))
    if (entry.path().extension() == ".cpp") tests += read(entry.path());
  return tests;
}

TEST(Documents, PresetsRunSuitesThatExist) {
  const std::string tests = sources_of_tests();
  const std::string presets = read(kRoot / "CMakePresets.json");
  const std::regex filter("\"include\": \\{\"name\": \"\\^\\(([^)]*)\\)"), word("\\w+");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(presets, found, filter));
  const std::string names = found[1];
  for (auto name = std::sregex_iterator(names.begin(), names.end(), word);
       name != std::sregex_iterator(); ++name)
    EXPECT_TRUE(std::regex_search(tests, std::regex("TEST(_F|_P)?\\(" + name->str() + ",")))
        << name->str();
}

TEST(Documents, WhatTheSanitizersLeaveOutExists) {
  const std::string tests = sources_of_tests(), lists = read(kRoot / "tests/CMakeLists.txt");
  const std::size_t begin = lists.find("string(CONCAT STRIDE_LEFT_OUT");
  ASSERT_NE(begin, std::string::npos);
  const std::string list = lists.substr(begin, lists.find("endif()", begin) - begin);
  const std::regex entry(R"((?:\w+/)?(\w+)\.(\w+|\*))");
  int count = 0;
  for (auto left_out = std::sregex_iterator(list.begin(), list.end(), entry);
       left_out != std::sregex_iterator(); ++left_out, ++count) {
    const std::string name = (*left_out)[2] == "*" ? "\\w+" : (*left_out)[2].str();
    EXPECT_TRUE(std::regex_search(
        tests, std::regex("TEST(_F|_P)?\\(" + (*left_out)[1].str() + ",\\s*" + name + "\\)")))
        << (*left_out)[0];
  }
  EXPECT_GT(count, 10);
}

TEST(Documents, NumbersOfTheFirstPageAreOnThePageOfClaims) {
  const std::string readme = read(kRoot / "README.md");
  const std::string claims = read(kRoot / "tests/bench/BENCHMARK.md");
  const std::string table = readme.substr(0, readme.find("\n## "));
  const std::regex bold(R"(\*\*([^*]+)\*\*)");
  const std::vector<std::smatch> numbers(std::sregex_iterator(table.begin(), table.end(), bold),
                                         std::sregex_iterator());
  EXPECT_GE(numbers.size(), 4U);
  for (const std::smatch& number : numbers)
    EXPECT_THAT(claims, ::testing::HasSubstr(number.str(1)));
}

}  // namespace
