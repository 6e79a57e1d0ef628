#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "extract/io/file.h"
#include "extract/io/outputs.h"
#include "train/page/page.h"

namespace stride {
namespace {

namespace fs = std::filesystem;

struct Request {
  fs::path subject, out, video;
};

/// In the folder of now: NAME.html of NAME.trajectory.csv, NAME.mp4 or a folder NAME.
fs::path page_file(const fs::path& subject) {
  fs::path name = fs::absolute(subject / "").lexically_normal().parent_path().filename();
  for (const char* ending : {".csv", ".trajectory"})
    if (name.extension() == ending) name = name.stem();
  if (!fs::is_directory(subject) && name == subject.filename()) name = name.stem();
  return name.string() + ".html";
}

void run(const Request& request) {
  const fs::path out = request.out.empty() ? page_file(request.subject) : request.out;
  check_outputs({request.subject, request.video}, {{"-o", out, FileKind::page}});
  write_file_atomically(out, page::page_of(request.subject, request.video));
  fmt::print("{}\n", out.string());
}

}  // namespace

void add_report_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "report", "One HTML file about a clip, a run or an experiment: pictures and films inside");
  const auto request = std::make_shared<Request>();
  command
      ->add_option("subject", request->subject,
                   "NAME.trajectory.csv, a run folder, or the folder of an experiment's report")
      ->required();
  command->add_option("-o,--out", request->out, "The page (default: NAME.html, here)");
  command->add_option("--video", request->video, "Of a clip, where it does not lie beside it");
  command->callback([request] { run(*request); });
}

}  // namespace stride
