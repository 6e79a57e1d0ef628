#include "train/ppo/train.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "train/ppo/exchange.h"
#include "train/ppo/training.h"
#include "train/training/checkpoint.h"
#include "train/training/curve.h"
#include "train/training/journal.h"
#include "train/training/run_folder.h"

namespace stride::ppo {
namespace fs = std::filesystem;
using network::EpisodeSummary;
using training::TrainOptions;
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kSharedColumns = 12;  // of the curve, with the other learner's

Table new_ppo_curve(const std::string& task) {
  Table table = training::new_curve(task);
  table.columns.resize(kSharedColumns);
  for (const char* name : {"kl", "entropy", "value_loss", "explained_variance", "actor_rate"})
    table.columns.emplace_back(name);
  return table;
}

std::vector<double> row_of(const training::CurveRow& shared, const PpoTraining& training) {
  std::vector<double> row = shared.values();
  row.resize(kSharedColumns);
  const BatchSums& sums = training.sums;
  for (const double sum : {sums.kl, sums.entropy, sums.value_loss, sums.explained_variance})
    row.push_back(sums.batches > 0 ? sum / sums.batches : NAN);
  row.push_back(training.learner.rate());
  return row;
}

double simulated_s(const PpoTraining& training) {
  double total = 0;
  for (const Slot& slot : training.slots) total += slot.state().simulated_s;
  return total;
}

/// What is learnt from a batch of decisions. Empty, or why learning stopped.
std::string learn(const TrainOptions& options, PpoTraining& training, training::ThreadPool& threads,
                  RolloutBatch& batch) {
  training.learner.assess(threads, batch);
  const auto decisions = static_cast<double>(training.progress.decisions);
  const UpdateReport report = training.learner.update(
      batch, std::min(1.0, decisions / options.ppo.decay_decisions), training.random, threads);
  if (!std::isfinite(report.kl + report.value_loss + report.actor_gradient))
    return fmt::format(
        "learning diverged after {} decisions: divergence {}, value loss {}; lower ppo.rate or "
        "ppo.kl",
        decisions, report.kl, report.value_loss);
  training.progress.updates += report.steps;
  training.sums.batches += 1;
  training.sums.kl += report.kl;
  training.sums.entropy += report.entropy;
  training.sums.value_loss += report.value_loss;
  training.sums.explained_variance += report.explained_variance;
  return {};
}

/// The loop.
training::TrainSummary train_with(const TrainOptions& options, const Potential* potential,
                                  const fs::path& run,
                                  const training::EnvironmentFactory& make_environment,
                                  const std::atomic<bool>& stop, std::FILE* messages,
                                  parallel::Ranks& ranks) {
  PpoTraining training = start_training(options, potential, make_environment);
  if (!ranks.first()) ranks.wait_for_all();  // until the first has tidied up the folder
  if (fs::exists(training::checkpoint_file(run)))
    load_checkpoint(training, run);
  else if (!options.ppo.start.empty())
    begin_with(training, run / options.ppo.start);
  if (ranks.first()) ranks.wait_for_all();
  training::Progress& progress = training.progress;
  training::Journal journal(run, new_ppo_curve(options.environment.task.name), progress,
                            ranks.first() ? messages : nullptr);
  training::ThreadPool threads(options.run.threads);
  training::Evaluator evaluator(options, potential, make_environment, threads.size());
  training::TrainSummary summary;

  const auto evaluate = [&] {
    ++progress.rows;
    progress.last_row_decisions = progress.decisions;
    if (!ranks.first()) return;
    const network::Policy<float> policy = policy_of(training);
    const training::CurveRow shared =
        training::curve_row(progress, simulated_s(training), evaluator.evaluate(policy, threads));
    summary.distance_m = shared.evaluation_distance_m;
    std::vector<double> row = row_of(shared, training);
    journal.keep_policy(policy,
                        {.features = training.feature_names,
                         .actions = training.action_names,
                         .action_repeat = options.run.action_repeat},
                        summary.distance_m, progress);
    journal.add_row(options, progress, std::move(row));
    progress.sums = {};
    training.sums = {};
  };

  RolloutBatch batch;
  auto last_checkpoint = Clock::now();
  bool stopped = !ranks.gather(stop ? "stop" : "")[0].empty();
  for (;;) {
    if (progress.decisions >= progress.next_evaluation) {
      evaluate();
      progress.next_evaluation += options.run.evaluate_every;
    }
    if (stopped || progress.decisions >= options.run.decisions) break;
    collect(options, training, threads, ranks, batch);
    if (ranks.first()) summary.divergence = learn(options, training, threads, batch);
    const std::chrono::duration<double> unsaved = Clock::now() - last_checkpoint;
    const training::Orders orders =
        exchange_actor(ranks,
                       {.stop = stop,
                        .checkpoint = unsaved.count() > options.run.checkpoint_s,
                        .divergence = summary.divergence},
                       training.learner.actor().parameters());
    stopped = orders.stop;
    summary.divergence = orders.divergence;
    if (!summary.divergence.empty()) return summary;  // the last good checkpoint stays
    training.normaliser.publish();
    if (orders.checkpoint) {
      collect_slots(ranks, kGroup, training.slots);
      if (ranks.first()) journal.keep([&] { save_checkpoint(training, run); });
      last_checkpoint = Clock::now();
    }
  }
  collect_slots(ranks, kGroup, training.slots);
  summary.finished = progress.decisions >= options.run.decisions;
  summary.progress = progress;
  if (!ranks.first()) return summary;
  try {
    save_checkpoint(training, run);
    // After the checkpoint, so that a run that is continued with more decisions has no row that an
    // uninterrupted run would not have.
    if (summary.finished && progress.decisions > progress.last_row_decisions) evaluate();
    if (progress.rows > 0) journal.save_rows();
  } catch (const Error& error) {
    summary.unsaved = error.what();
  }
  summary.progress = progress;
  return summary;
}

}  // namespace

training::TrainSummary train(const fs::path& run,
                             const training::EnvironmentFactory& make_environment,
                             const std::atomic<bool>& stop, std::FILE* messages,
                             parallel::Ranks& ranks) {
  const TrainOptions options = training::load_run_options(run);
  const std::optional<Potential> potential =
      training::load_run_demonstration(options, run).potential;
  std::optional<training::FolderLock> lock;
  if (ranks.first()) {
    lock.emplace(run);
    training::remove_unfinished_files(run);
  }
  return train_with(options, potential ? &*potential : nullptr, run, make_environment, stop,
                    messages, ranks);
}

}  // namespace stride::ppo
