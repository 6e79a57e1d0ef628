#include "train/ppo/train.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <ctime>

#include "extract/error.h"
#include "train/checkpoint.h"
#include "train/curve.h"
#include "train/ppo/training.h"

namespace stride::ppo {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Table new_ppo_curve() {
  Table table = new_curve();
  table.columns.resize(12);
  for (const char* name : {"kl", "entropy", "value_loss", "explained_variance", "actor_rate"})
    table.columns.push_back(name);
  return table;
}

Table new_ppo_timing() {
  Table table = new_timing();
  table.columns.push_back("cpu_s");
  return table;
}

std::vector<double> row_of(const Training& training,
                           const std::vector<EpisodeSummary>& evaluation) {
  const Progress& progress = training.progress;
  const Progress::Sums& sums = progress.sums;
  double simulated_s = 0;
  for (const Slot& slot : training.slots) simulated_s += slot.state().simulated_s;
  stride::Progress shared;
  shared.decisions = progress.decisions;
  shared.updates = progress.updates;
  shared.episodes = progress.episodes;
  shared.falls = progress.falls;
  shared.failures = progress.failures;
  shared.sums.episodes = sums.episodes;
  shared.sums.distance_m = sums.distance_m;
  shared.sums.reward = sums.reward;
  std::vector<double> row = curve_row(shared, simulated_s, evaluation);
  row.resize(12);
  for (const double sum : {sums.kl, sums.entropy, sums.value_loss, sums.explained_variance})
    row.push_back(sums.batches > 0 ? sum / sums.batches : NAN);
  row.push_back(training.learner.rate());
  return row;
}

}  // namespace

TrainSummary train(const TrainOptions& options, const Potential* potential, const fs::path& run,
                   const EnvironmentFactory& make_environment, const std::atomic<bool>& stop,
                   std::FILE* messages) {
  Training training = start_training(options, potential, make_environment);
  if (fs::exists(checkpoint_file(run))) load_checkpoint(training, run);
  Progress& progress = training.progress;
  Table curve = new_ppo_curve(), timing = new_ppo_timing();
  double wall_before = 0, cpu_before = 0;
  if (progress.rows > 0) {
    curve = load_rows(run / "curve.csv", curve, progress.rows);
    timing = load_rows(run / "timing.csv", timing, progress.rows);
    wall_before = timing.rows.back()[1];
    cpu_before = timing.rows.back()[4];
  }
  Crew crew(options.run.threads);
  std::vector<std::unique_ptr<Environment>> arenas;
  const int lanes = std::min(options.run.evaluation_episodes, 2);
  for (int i = 0; i < lanes; ++i) arenas.push_back(make_environment(-1));
  const Observer observer = make_observer(options, potential, arenas.front()->spec());
  TrainSummary summary;
  const auto start = Clock::now();
  const auto wall_s = [&] {
    return wall_before + std::chrono::duration<double>(Clock::now() - start).count();
  };
  const double cpu_start = cpu_s();

  const auto evaluate = [&] {
    const Policy<float> policy = policy_of(training);
    std::vector<EpisodeSummary> episodes(static_cast<std::size_t>(options.run.evaluation_episodes));
    crew.run(lanes, [&](int lane) {
      Observer own = observer;
      for (int i = lane; i < options.run.evaluation_episodes; i += lanes)
        episodes[static_cast<std::size_t>(i)] =
            run_episode(policy, *arenas[static_cast<std::size_t>(lane)], own, potential,
                        options.run.action_repeat, static_cast<std::uint64_t>(i), nullptr);
    });
    std::vector<double> row = row_of(training, episodes);
    summary.distance_m = row[6];
    const auto keep_as = [&](const char* name) {
      save_policy(policy, training.feature_names, training.action_names, options.run.action_repeat,
                  run / name);
    };
    keep_as("agent.safetensors");
    if (summary.distance_m > progress.best_distance_m) {
      progress.best_distance_m = summary.distance_m;
      keep_as("best.safetensors");
    }
    progress.sums = {};
    ++progress.rows;
    const double cpu = cpu_before + cpu_s() - cpu_start;
    timing.rows.push_back({row[0], wall_s(), NAN, NAN, cpu});
    curve.rows.push_back(std::move(row));
    save(curve, run / "curve.csv");
    save(timing, run / "timing.csv");
    if (messages != nullptr) {
      const std::vector<double>& r = curve.rows.back();
      fmt::print(
          messages,
          "{} decisions, {:.0f} s cpu, {:.2f} m ({:.2f} falls), best {:.2f} m; training "
          "{:.2f} m, kl {:.4f}, entropy {:.2f}, loss {:.3f}, explained {:.2f}, rate {:.2e}\n",
          progress.decisions, cpu, r[6], r[9], progress.best_distance_m, r[10], r[12], r[13], r[14],
          r[15], r[16]);
      std::fflush(messages);
    }
  };

  RolloutBatch batch;
  auto last_checkpoint = Clock::now();
  for (;;) {
    if (progress.decisions >= progress.next_evaluation) {
      evaluate();
      progress.next_evaluation += options.run.evaluate_every;
    }
    if (stop || progress.decisions >= options.run.decisions) break;

    collect(options, training, crew, batch);
    training.learner.assess(crew, batch);
    const double age =
        std::min(1.0, static_cast<double>(progress.decisions) / options.ppo.decay_decisions);
    const UpdateReport report = training.learner.update(batch, age, training.random, crew);
    if (!std::isfinite(report.kl + report.value_loss + report.actor_gradient)) {
      summary.divergence = fmt::format(
          "learning diverged after {} decisions: divergence {}, value loss {}; lower ppo.rate or "
          "ppo.kl",
          progress.decisions, report.kl, report.value_loss);
      return summary;  // the last good checkpoint stays
    }
    training.normaliser.publish();
    progress.updates += report.steps;
    progress.sums.batches += 1;
    progress.sums.kl += report.kl;
    progress.sums.entropy += report.entropy;
    progress.sums.value_loss += report.value_loss;
    progress.sums.explained_variance += report.explained_variance;

    if (std::chrono::duration<double>(Clock::now() - last_checkpoint).count() >
        options.run.checkpoint_s) {
      save_checkpoint(training, run);
      last_checkpoint = Clock::now();
    }
  }
  save_checkpoint(training, run);
  summary.finished = progress.decisions >= options.run.decisions;
  summary.progress.decisions = progress.decisions;
  summary.progress.updates = progress.updates;
  summary.progress.episodes = progress.episodes;
  summary.progress.falls = progress.falls;
  summary.progress.best_distance_m = progress.best_distance_m;
  return summary;
}

}  // namespace stride::ppo
