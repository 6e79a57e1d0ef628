#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "extract/io/option_range.h"
#include "train/evaluation/evaluate.h"

namespace stride {

void add_evaluate_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "evaluate", "Run an agent without noise: distance, gait, film, OpenSim's .mot and .sto");
  struct Request {
    std::string run;
    evaluation::EvaluateOptions options;
    bool no_film = false;
  };
  const auto request = std::make_shared<Request>();
  evaluation::EvaluateOptions& options = request->options;
  command->add_option("run", request->run, "Run folder")->required();
  command->add_option("--episodes", options.episodes, "Episodes, each of another seed")
      ->check(in_range(1, 1e6))
      ->capture_default_str();
  command
      ->add_option("--first", options.first_seed,
                   "The first seed: choose an agent on some scenes, report it on others")
      ->capture_default_str();
  command->add_option("--obstacles", options.obstacles, "At most; -1: as in training")
      ->check(in_range(-1, 1000))
      ->capture_default_str();
  command->add_option("--threads", options.threads, "0: one a core")
      ->check(in_range(0, 1024))
      ->capture_default_str();
  command->add_option("--agent", options.agent, "best, or agent: the last one")
      ->capture_default_str();
  command->add_option("--difficulty", options.difficulty, "0, 1, 2; -1: as in training")
      ->check(in_range(-1, 2))
      ->capture_default_str();
  command->add_option("--rules", options.rules, "clean or nips2017; as in training if not given");
  command->add_option("--engine", options.engine, "planar or simbody; as in training if not given");
  command->add_option("--out", options.out, "Folder of what is written; the run's if not given");
  command->add_option("--trajectory", options.trajectory,
                      "Write this run as a demonstration, NAME.calibrated.csv");
  command->add_option("--from", options.from_s, "Where the demonstration begins, s")
      ->check(in_range(0, 1000))
      ->capture_default_str();
  command->add_option("--clip", options.clip,
                      "Compare the joint angles with this run, NAME.calibrated.csv");
  command->add_flag("--no-film", request->no_film, "No evaluation.mp4");
  command->callback([request] {
    request->options.film = !request->no_film;
    const evaluation::Evaluation evaluation = evaluation::evaluate(request->run, request->options);
    fmt::print("{}\n{}\n", evaluation.brief_report(), evaluation.file.string());
  });
}

}  // namespace stride
