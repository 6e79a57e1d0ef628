#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/outputs.h"
#include "train/network/policy_onnx.h"
#include "train/training/train.h"

namespace stride {
namespace {

struct ExportRequest {
  std::filesystem::path run, out;
  std::string agent = "best";
  bool onnx = false;
};

template <typename Scalar>
std::string onnx_of(const std::filesystem::path& file) {
  const network::PolicyNames names = network::load_policy_names(file);
  return network::to_onnx(network::load_policy<Scalar>(file, names.features, names.actions), names);
}

void export_policy(const ExportRequest& request) {
  require(request.onnx, "name a format: --onnx");
  const std::filesystem::path file = network::agent_file(request.run, request.agent);
  const std::string precision = training::load_run_options(request.run).run.precision;
  const std::filesystem::path out =
      request.out.empty() ? request.run / (request.agent + ".onnx") : request.out;
  check_outputs({file}, {{"-o", out, FileKind::onnx}});
  write_file_atomically(out, precision == "float" ? onnx_of<float>(file) : onnx_of<double>(file));
  fmt::print("{}\n", out.string());
}

}  // namespace

void add_export_command(CLI::App& app) {
  auto* command = app.add_subcommand("export", "Write a run's policy for other programs: ONNX");
  const auto request = std::make_shared<ExportRequest>();
  command->add_option("run", request->run, "Run folder")->required();
  command->add_flag("--onnx", request->onnx, "As ONNX, float32: features → actions");
  command->add_option("-o,--out", request->out, "File; RUN/best.onnx if not given");
  command->add_option("--agent", request->agent, "best, or agent: the last one")
      ->capture_default_str();
  command->callback([request] { export_policy(*request); });
}

}  // namespace stride
