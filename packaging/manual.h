#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace stride::packaging {

/// The commands that --help lists.
std::vector<const CLI::App*> commands_of(const CLI::App& app);

/// The manual page of a command, in roff, made of what --help says. `name` is "stride" or
/// "stride-train"; `version` stands in its foot.
std::string manual_page(const CLI::App& app, const std::string& name, const std::string& version);

/// What a shell needs to complete commands and options: `shell` is bash, zsh or fish. Throws Error
/// otherwise.
std::string completion(const CLI::App& app, const std::string& shell);

/// Writes manual pages and completions where a system looks for them below `prefix`:
/// share/man/man1/stride.1, share/bash-completion/completions/stride, and so on.
void write_manual(const CLI::App& app, const std::string& version,
                  const std::filesystem::path& prefix);

/// Adds the commands `completion SHELL` and `manual FOLDER`.
void add_packaging_commands(CLI::App& app, const std::string& version);

}  // namespace stride::packaging
