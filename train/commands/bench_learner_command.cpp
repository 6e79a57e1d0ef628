#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "extract/io/error.h"
#include "train/ddpg/agent.h"
#include "train/training/options.h"

namespace stride {
namespace {

using Clock = std::chrono::steady_clock;

/// Calls `work` repeatedly for so many seconds; returns seconds per call.
template <typename Work>
double time_of(double seconds, const Work& work) {
  work();
  const auto start = Clock::now();
  int calls = 0;
  double passed = 0;
  while (passed < seconds) {
    work();
    ++calls;
    passed = std::chrono::duration<double>(Clock::now() - start).count();
  }
  return passed / calls;
}

/// Multiplications and additions of the matrix products in one update. A weight costs two of them
/// for each sample forward, two for its own gradient, and two for the gradient of the layer below.
double operations(const ddpg::AgentOptions& options, int states, int actions) {
  struct Weights {
    double all = 0, first = 0;
  };
  const auto weights = [](int inputs, const std::vector<int>& hidden, int outputs) {
    Weights w;
    for (const int neurons : hidden) {
      w.all += static_cast<double>(inputs) * neurons;
      if (w.first == 0) w.first = w.all;
      inputs = neurons;
    }
    w.all += static_cast<double>(inputs) * outputs;
    return w;
  };
  const Weights actor = weights(states, options.actor_hidden, actions);
  const Weights critic = weights(states + actions, options.critic_hidden, 1);
  const double targets = actor.all + critic.all;
  const double fit = critic.all * 3 - critic.first;  // nothing asks for the gradient by its inputs
  const double improve = critic.all * 2 + actor.all * 3 - actor.first;
  return 2.0 * options.batch * (targets + options.critics * fit + improve);
}

template <typename Scalar>
nlohmann::ordered_json measure(const ddpg::AgentOptions& options, int states, int actions,
                               double seconds) {
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  Random random(1);
  ddpg::Agent<Scalar> agent(options, states, actions, random);
  ddpg::Batch<Scalar> batch;
  batch.states = Matrix::Random(states, options.batch);
  batch.next_states = Matrix::Random(states, options.batch);
  batch.actions = (Matrix::Random(actions, options.batch).array() + 1) / 2;
  batch.rewards = Matrix::Random(1, options.batch);
  batch.discounts.setConstant(options.batch, Scalar(0.97));
  const double update_s = time_of(seconds, [&] { agent.update(batch, 1); });

  typename network::Mlp<Scalar>::Workspace work;
  const Matrix one = Matrix::Random(states, 1);
  const double action_s = time_of(seconds / 4, [&] { agent.actor().forward(one, work); });

  const int width = options.critic_hidden.empty() ? 1 : options.critic_hidden.front();
  const Matrix a = Matrix::Random(width, width), b = Matrix::Random(width, options.batch);
  Matrix c(width, options.batch);
  const double product_s = time_of(seconds / 4, [&] { c.noalias() = a * b; });
  const double gemm_rate = 2.0 * width * width * options.batch / product_s;
  const double update_rate = operations(options, states, actions) / update_s;
  return {{"precision", std::is_same_v<Scalar, float> ? "float" : "double"},
          {"updates_per_s", 1 / update_s},
          {"actions_per_s", 1 / action_s},
          {"update_gflops", update_rate / 1e9},
          {"product_gflops", gemm_rate / 1e9},
          {"share_of_product_rate", update_rate / gemm_rate}};
}

struct Request {
  std::string preset = "paper";
  std::vector<std::string> assignments;
  int states = 112, actions = 18;
  double seconds = 2;
  bool json = false;
};

void bench(const Request& request) {
  training::TrainOptions options;
  training::read_toml(training::preset_file(request.preset), options);
  for (const std::string& assignment : request.assignments)
    training::set_option(assignment, options);
  options.check();
  require(request.seconds > 0 && request.states > 0 && request.actions > 0,
          "--seconds, --states, --actions: must be above 0");
  const ddpg::AgentOptions& agent = options.agent;
  for (const auto& result :
       {measure<float>(agent, request.states, request.actions, request.seconds),
        measure<double>(agent, request.states, request.actions, request.seconds)}) {
    if (request.json) {
      fmt::print("{}\n", result.dump());
      continue;
    }
    fmt::print(
        "{:6}  {:7.0f} updates/s  {:8.0f} actions/s  {:6.1f} GFLOP/s, {:.0f} % of the {:.1f} of "
        "its matrix product\n",
        result["precision"].get<std::string>(), result["updates_per_s"].get<double>(),
        result["actions_per_s"].get<double>(), result["update_gflops"].get<double>(),
        100 * result["share_of_product_rate"].get<double>(),
        result["product_gflops"].get<double>());
  }
}

}  // namespace

void add_bench_learner_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("bench-learner", "Measure the learner: updates/s, float against double");
  const auto request = std::make_shared<Request>();
  command->add_option("--preset", request->preset, "Networks and batch of this preset")
      ->capture_default_str();
  command->add_option("--set", request->assignments, "One setting, as agent.batch=256");
  command->add_option("--states", request->states, "Features")->capture_default_str();
  command->add_option("--seconds", request->seconds, "Of each measurement")->capture_default_str();
  command->add_flag("--json", request->json, "One object a line");
  command->callback([request] { bench(*request); });
}

}  // namespace stride
