#include "packaging/manual.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <vector>

#include "extract/io/error.h"
#include "extract/io/file.h"

namespace stride::packaging {
namespace fs = std::filesystem;
namespace {

/// Text as roff takes it: a backslash, a leading dot or quote and hyphens are special.
std::string roff(const std::string& text) {
  std::string escaped;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool line_start = i == 0 || text[i - 1] == '\n';
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else if (line_start && (c == '.' || c == '\''))
      escaped += std::string("\\&") + c;
    else
      escaped += c;
  }
  return escaped;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

/// "--seed INT", "NAME": an option as it is typed.
std::string spelling(const CLI::Option& option) {
  std::string names = option.get_name(false, true);
  for (std::size_t comma; (comma = names.find(',')) != std::string::npos && names[0] == '-';)
    names.replace(comma, 1, "\x01");
  std::ranges::replace(names, '\x01', ' ');
  const std::string type = option.get_type_size() == 0 ? "" : option.get_type_name();
  return type.empty() || option.get_positional() ? names : names + " " + type;
}

std::string described_options(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) {
    text += fmt::format(
        ".TP\n.B {}\n{}", roff(spelling(*option)),
        roff(option->get_description().empty() ? "see the README" : option->get_description()));
    if (!option->get_default_str().empty() && option->get_type_size() != 0)
      text += fmt::format(" [{}]", roff(option->get_default_str()));
    if (option->get_required()) text += " (required)";
    text += "\n";
  }
  return text;
}

}  // namespace

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); });
}

std::string manual_page(const CLI::App& app, const std::string& name, const std::string& version) {
  const auto commands = commands_of(app);
  std::string spoken = name;
  std::ranges::replace(spoken, '-', ' ');
  std::string text = fmt::format(
      ".TH {} 1 \"\" \"stride {}\" \"Stride\"\n.SH NAME\n{} \\- {}\n.SH SYNOPSIS\n.B {}\n",
      upper(name), roff(version), roff(name), roff(app.get_description()), roff(spoken));
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional())
      text += fmt::format(".I {}{}\n", roff(option->get_name(true)),
                          option->get_expected_max() > 1 ? "..." : "");
  text += commands.empty() ? "[options]\n" : "command [options]\n";
  if (!commands.empty()) {
    text += ".SH COMMANDS\n";
    for (const CLI::App* command : commands)
      text += fmt::format(".TP\n.BR {}\\-{} (1)\n{}\n", roff(name), roff(command->get_name()),
                          roff(command->get_description()));
  }
  text += ".SH OPTIONS\n" + described_options(app);
  if (commands.empty()) return text + ".SH SEE ALSO\n.BR stride (1)\n";
  return text +
         ".SH ENVIRONMENT\n.TP\n.B STRIDE_DATA\nFolder of models, presets, agents and clips; "
         "without it ../share/stride from the program\n";
}

void write_manual(const CLI::App& app, const std::string& version, const fs::path& prefix) {
  const fs::path pages = prefix / "share/man/man1";
  write_file_atomically(pages / "stride.1", manual_page(app, "stride", version));
  for (const CLI::App* command : commands_of(app)) {
    const std::string name = "stride-" + command->get_name();
    write_file_atomically(pages / (name + ".1"), manual_page(*command, name, version));
  }
  write_file_atomically(prefix / "share/bash-completion/completions/stride",
                        completion(app, "bash"));
  write_file_atomically(prefix / "share/zsh/vendor-completions/_stride", completion(app, "zsh"));
  write_file_atomically(prefix / "share/fish/vendor_completions.d/stride.fish",
                        completion(app, "fish"));
}

void add_packaging_commands(CLI::App& app, const std::string& version) {
  const auto word = std::make_shared<std::string>();
  auto* completes = app.add_subcommand(
      "completion",
      "Print what a shell needs to complete commands: source <(stride completion bash)");
  completes->add_option("shell", *word, "bash, zsh or fish")->required();
  completes->callback([&app, word] { fmt::print("{}", completion(app, *word)); });
  auto* manual = app.add_subcommand(
      "manual", "Write the manual pages and completions of all commands below a folder");
  manual->add_option("folder", *word, "Such as /usr/local: share/man/man1/stride.1 and others")
      ->required();
  manual->callback([&app, word, version] { write_manual(app, version, *word); });
}

}  // namespace stride::packaging
