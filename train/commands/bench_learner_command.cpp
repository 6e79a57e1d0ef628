#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "extract/io/error.h"
#include "train/ddpg/learner_speed.h"
#include "train/training/options.h"

namespace stride {
namespace {

struct BenchLearnerRequest {
  std::string preset = "paper";
  std::vector<std::string> assignments;
  int states = 112, actions = 18;
  double seconds = 2;
  bool json = false;
};

void print_json(const char* precision, const ddpg::LearnerSpeed& speed) {
  const nlohmann::ordered_json object{
      {"precision", precision},
      {"updates_per_s", speed.updates_per_s},
      {"actions_per_s", speed.actions_per_s},
      {"update_gflops", speed.update_flops / 1e9},
      {"product_gflops", speed.product_flops / 1e9},
      {"share_of_product_rate", speed.update_flops / speed.product_flops}};
  fmt::print("{}\n", object.dump());
}

void print_text(const char* precision, const ddpg::LearnerSpeed& speed) {
  fmt::print(
      "{:6}  {:7.0f} updates/s  {:8.0f} actions/s  {:6.1f} GFLOP/s, {:.0f} % of the {:.1f} of its "
      "matrix product\n",
      precision, speed.updates_per_s, speed.actions_per_s, speed.update_flops / 1e9,
      100 * speed.update_flops / speed.product_flops, speed.product_flops / 1e9);
}

void bench(const BenchLearnerRequest& request) {
  training::TrainOptions options;
  training::read_preset(request.preset, options);
  for (const std::string& assignment : request.assignments)
    training::set_option(assignment, options);
  options.check();
  require(request.seconds > 0 && request.states > 0 && request.actions > 0,
          "--seconds, --states, --actions: must be above 0");
  const auto print = request.json ? print_json : print_text;
  print("float", ddpg::measure_learner<float>(options.agent, request.states, request.actions,
                                              request.seconds));
  print("double", ddpg::measure_learner<double>(options.agent, request.states, request.actions,
                                                request.seconds));
}

}  // namespace

void add_bench_learner_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("bench-learner", "Measure the learner: updates/s, float against double");
  const auto request = std::make_shared<BenchLearnerRequest>();
  command->add_option("--preset", request->preset, "Networks and batch of this preset")
      ->capture_default_str();
  command->add_option("--set", request->assignments, "One setting, as agent.batch=256");
  command->add_option("--states", request->states, "Features")->capture_default_str();
  command->add_option("--seconds", request->seconds, "Of each measurement")->capture_default_str();
  command->add_flag("--json", request->json, "One object a line");
  command->callback([request] { bench(*request); });
}

}  // namespace stride
