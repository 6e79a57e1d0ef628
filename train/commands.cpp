#include "train/commands.h"

#include <CLI/CLI.hpp>

namespace stride {

void add_bench_command(CLI::App& app);
void add_bench_learner_command(CLI::App& app);
void add_compare_command(CLI::App& app);
void add_evaluate_command(CLI::App& app);
void add_experiment_command(CLI::App& app);
void add_export_command(CLI::App& app);
void add_plot_command(CLI::App& app);
void add_simulate_command(CLI::App& app);
void add_train_command(CLI::App& app);

void add_train_commands(CLI::App& app) {
  add_train_command(app);
  add_evaluate_command(app);
  add_export_command(app);
  add_plot_command(app);
  add_experiment_command(app);
  add_compare_command(app);
  add_simulate_command(app);
  add_bench_command(app);
  add_bench_learner_command(app);
}

}  // namespace stride
