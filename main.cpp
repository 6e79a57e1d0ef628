// The program `stride`: its commands, in the order of the pipeline.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numeric>

#include "calibrate/commands.h"
#include "extract/commands.h"
#include "extract/io/data_file.h"
#include "extract/parallel/ranks.h"
#include "packaging/manual.h"
#include "shaping/commands.h"
#include "train/commands.h"

namespace {

/// Levenshtein's distance.
std::size_t edits(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t above = row[j + 1];
      row[j + 1] = std::min({above + 1, row[j] + 1, diagonal + (a[i] == b[j] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row.back();
}

/// Names in it may hold anything: what would command the terminal is shown, not sent.
std::string shown(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if ((code < 0x20 && c != '\n' && c != '\t') || code == 0x7f)
      safe += fmt::format("\\x{:02x}", code);
    else
      safe += c;
  }
  return safe;
}

/// An empty argument is a variable of a script that was not set; it is not the same as none.
void refuse_empty_arguments(CLI::App& app) {
  const CLI::Validator filled(
      [](std::string& text) {
        return text.empty() ? std::string("an empty text: give a value, or leave the option out")
                            : std::string();
      },
      "", "");
  for (CLI::App* command : app.get_subcommands({}))
    for (CLI::Option* option : command->get_options())
      if (option->get_items_expected_min() > 0) option->check(filled);
}

/// What is wrong with the command line, and where to read on.
int explain(const CLI::App& app, int argc, char** argv, const CLI::ParseError& e) {
  const std::string command = argc > 1 ? argv[1] : "";
  std::string nearest;
  bool known = false;
  for (const CLI::App* each : app.get_subcommands({})) {
    known = known || each->get_name() == command;
    if (nearest.empty() || edits(each->get_name(), command) < edits(nearest, command))
      nearest = each->get_name();
  }
  if (known)
    fmt::print(stderr, "error: {}\nsee: stride {} --help\n", shown(e.what()), command);
  else if (command.starts_with('-'))
    fmt::print(stderr, "error: {}\nsee: stride --help\n", shown(e.what()));
  else
    fmt::print(stderr, "error: '{}' is no command; did you mean stride {}? see: stride --help\n",
               shown(command), nearest);
  return 2;
}

int run(int argc, char** argv) {
  CLI::App app{"Stride: from a running video to a muscle-driven runner"};
  app.require_subcommand(1);
  app.set_version_flag("--version", stride::version());
  try {
    stride::add_extract_commands(app);
    stride::add_calibrate_commands(app);
    stride::add_shaping_commands(app);
    stride::add_train_commands(app);
    stride::packaging::add_packaging_commands(app, stride::version());
    refuse_empty_arguments(app);
    if (argc == 1) {
      fmt::print("{}", app.help());
      return 0;
    }
    stride::parallel::Ranks& ranks = stride::parallel::Ranks::world();
    app.parse(argc, argv);
    ranks.finish();
    return 0;
  } catch (const CLI::ParseError& e) {
    return e.get_exit_code() == 0 ? app.exit(e) : explain(app, argc, argv, e);
  } catch (const std::filesystem::filesystem_error& e) {
    fmt::print(stderr, "error: {}: {}\n", shown(e.path1().string()), e.code().message());
    return 1;
  } catch (const std::exception& e) {
    fmt::print(stderr, "error: {}\n", shown(e.what()));
    return 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (...) {  // where not even the message can be written
    return 1;
  }
}
