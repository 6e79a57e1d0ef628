#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "extract/io/file.h"
#include "train/page/page.h"

namespace stride {

void add_report_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "report", "One HTML file about a clip, a run or an experiment: pictures and films inside");
  struct Request {
    std::filesystem::path subject, out = "page.html", video;
  };
  const auto request = std::make_shared<Request>();
  command
      ->add_option("subject", request->subject,
                   "NAME.trajectory.csv, a run folder, or the folder of an experiment's report")
      ->required();
  command->add_option("-o,--out", request->out, "The page")->capture_default_str();
  command->add_option("--video", request->video, "Of a clip, where it does not lie beside it");
  command->callback([request] {
    write_file_atomically(request->out, page::page_of(request->subject, request->video));
    fmt::print("{}\n", request->out.string());
  });
}

}  // namespace stride
