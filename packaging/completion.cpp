#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "extract/io/error.h"
#include "packaging/manual.h"

namespace stride::packaging {
namespace {

struct Word {
  std::string text, description;
};

/// --long and -s options of a command.
std::vector<Word> options_of(const CLI::App& app) {
  std::vector<Word> words;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames())
      words.push_back({"--" + name, option->get_description()});
    for (const std::string& name : option->get_snames())
      words.push_back({"-" + name, option->get_description()});
  }
  return words;
}

std::string joined(const std::vector<Word>& words) {
  std::string text;
  for (const Word& word : words) text += (text.empty() ? "" : " ") + word.text;
  return text;
}

/// Between single quotes of a shell; brackets and colons are zsh's own.
std::string quoted(const std::string& text, bool zsh = false) {
  std::string safe;
  for (const char c : text) {
    if (c == '\'')
      safe += "'\\''";
    else if (zsh && (c == '[' || c == ']' || c == ':'))
      safe += fmt::format("\\{}", c);
    else
      safe += c == '\n' ? ' ' : c;
  }
  return safe;
}

std::string bash(const CLI::App& app) {
  std::string names, cases;
  for (const CLI::App* command : commands_of(app)) {
    names += " " + command->get_name();
    cases +=
        fmt::format("    {}) words='{}' ;;\n", command->get_name(), joined(options_of(*command)));
  }
  return fmt::format(
      "_stride() {{\n"
      "  local word=${{COMP_WORDS[COMP_CWORD]}} words\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    COMPREPLY=($(compgen -W '{} {}' -- \"$word\"))\n"
      "    return\n"
      "  fi\n"
      "  case ${{COMP_WORDS[1]}} in\n{}  esac\n"
      "  case $word in\n"
      "    -*) COMPREPLY=($(compgen -W \"$words\" -- \"$word\")) ;;\n"
      "    *) COMPREPLY=($(compgen -f -- \"$word\")) ;;\n"
      "  esac\n"
      "}}\n"
      "complete -o filenames -F _stride stride\n",
      names.substr(1), joined(options_of(app)), cases);
}

std::string zsh(const CLI::App& app) {
  std::string commands, cases;
  for (const CLI::App* command : commands_of(app)) {
    commands +=
        fmt::format("    '{}:{}'\n", command->get_name(), quoted(command->get_description(), true));
    cases += fmt::format("    {}) _arguments", command->get_name());
    for (const Word& option : options_of(*command))
      cases += fmt::format(" '{}[{}]'", option.text, quoted(option.description, true));
    cases += " '*:file:_files' ;;\n";
  }
  return fmt::format(
      "#compdef stride\n"
      "_stride() {{\n"
      "  local -a commands=(\n{}  )\n"
      "  if ((CURRENT == 2)); then\n"
      "    _describe command commands\n"
      "    return\n"
      "  fi\n"
      "  local command=$words[2]\n"
      "  shift words\n"
      "  ((CURRENT--))\n"
      "  case $command in\n{}  esac\n"
      "}}\n"
      "if [ \"$funcstack[1]\" = _stride ]; then _stride \"$@\"; else compdef _stride stride; fi\n",
      commands, cases);
}

std::string fish(const CLI::App& app) {
  std::string text;
  for (const CLI::App* command : commands_of(app)) {
    text += fmt::format("complete -c stride -n __fish_use_subcommand -a {} -d '{}'\n",
                        command->get_name(), quoted(command->get_description()));
    for (const Word& option : options_of(*command)) {
      const bool is_long = option.text.starts_with("--");
      text += fmt::format("complete -c stride -n '__fish_seen_subcommand_from {}' -{} {} -d '{}'\n",
                          command->get_name(), is_long ? "l" : "s",
                          option.text.substr(is_long ? 2 : 1), quoted(option.description));
    }
  }
  return text;
}

}  // namespace

std::string completion(const CLI::App& app, const std::string& shell) {
  if (shell == "bash") return bash(app);
  if (shell == "zsh") return zsh(app);
  if (shell == "fish") return fish(app);
  throw Error(fmt::format("completion '{}': must be bash, zsh or fish", shell));
}

}  // namespace stride::packaging
