#include "extract/io/gnuplot.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <memory>

#include "extract/io/error.h"

namespace stride {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

/// A file without a name, for what a program reads or prints: unlike a pipe it cannot block.
File scratch_file() {
  File file(std::tmpfile(), &std::fclose);
  require(file != nullptr, "gnuplot: no temporary file can be created; is the disk full?");
  return file;
}

std::string content_of(std::FILE* file) {
  std::string content;
  std::rewind(file);
  char block[1 << 14];
  while (const std::size_t n = std::fread(block, 1, sizeof block, file)) content.append(block, n);
  return content;
}

/// The last line that says something.
std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  const auto newline = text.rfind('\n');
  const std::string line = newline == std::string::npos ? text : text.substr(newline + 1);
  const auto start = line.find_first_not_of(' ');
  return start == std::string::npos ? line : line.substr(start);
}

/// Exit status of gnuplot; 127 if there is none.
int spawned(std::FILE* in, std::FILE* out, std::FILE* complaints,
            const std::filesystem::path& folder) {
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  if (!folder.empty()) ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  ::posix_spawn_file_actions_adddup2(&actions, ::fileno(in), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, ::fileno(out), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, ::fileno(complaints), STDERR_FILENO);
  char name[] = "gnuplot";
  char* arguments[] = {name, nullptr};
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, name, &actions, nullptr, arguments, ::environ);
  ::posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (error != 0 || ::waitpid(child, &status, 0) != child || !WIFEXITED(status)) return 127;
  return WEXITSTATUS(status);
}

}  // namespace

std::string gnuplot_string(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'')
      quoted += R"('."'".')";  // a doubled one is misread beside another, and at the beginning
    else
      quoted += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return quoted + "'";
}

std::string gnuplot_file(std::string_view name) {
  for (const char c : name)
    require(static_cast<unsigned char>(c) >= 0x20,
            "{}: a picture's name must not hold a line end or another control character", name);
  return gnuplot_string(fmt::format("./{}", name));
}

std::string run_gnuplot(const std::string& script, const std::filesystem::path& folder) {
  const File in = scratch_file(), out = scratch_file(), complaints = scratch_file();
  require(std::fwrite(script.data(), 1, script.size(), in.get()) == script.size() &&
              std::fflush(in.get()) == 0,
          "gnuplot: the temporary file cannot be written; is the disk full?");
  std::rewind(in.get());
  const int status = spawned(in.get(), out.get(), complaints.get(), folder);
  require(status != 127, "gnuplot cannot be run: install the package gnuplot-nox");
  require(status == 0, "gnuplot failed: {}", last_line(content_of(complaints.get())));
  return content_of(out.get());
}

}  // namespace stride
