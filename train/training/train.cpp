#include "train/training/train.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <optional>

#include "extract/io/data_file.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/parallel/ranks.h"
#include "train/training/checkpoint.h"
#include "train/training/curve.h"
#include "train/training/exchange.h"
#include "train/training/journal.h"
#include "train/training/run_folder.h"
#include "train/training/thread_pool.h"

namespace stride::training {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

/// Values beyond it count as divergence; rewards in metres cannot add up to it.
constexpr double kDivergedValue = 1e6;

/// Number of updates due: a fixed ratio to the decisions after the warm-up.
std::int64_t updates_due(const TrainOptions& options, const Progress& progress) {
  const auto learned = static_cast<double>(progress.decisions - options.run.warm_up);
  return static_cast<std::int64_t>(std::max(0.0, learned) * options.run.updates_per_decision) -
         progress.updates;
}

/// The learner's part of a round: samples from the rounds before it.
template <typename Scalar>
std::string learn(const TrainOptions& options, bool shaped, std::int64_t updates,
                  Training<Scalar>& training, ddpg::Batch<Scalar>& batch) {
  const ddpg::SampleOptions sample{.batch = options.agent.batch,
                                   .n_step = options.agent.n_step,
                                   .gamma = options.agent.gamma,
                                   .reward_scale = options.reward.scale,
                                   .shaped = shaped,
                                   .discounted = options.shaping.discounted,
                                   .mirror = options.replay.mirror};
  Progress::Sums& sums = training.progress.sums;
  const double age = std::min(
      1.0, static_cast<double>(training.progress.decisions) / options.agent.decay_decisions);
  const double rate = 1 + age * (options.agent.final_rate - 1);
  for (std::int64_t i = 0; i < updates; ++i) {
    training.buffer.sample(sample, training.random, batch);
    training.normaliser.apply(batch.states);
    training.normaliser.apply(batch.next_states);
    const ddpg::UpdateLosses losses = training.agent.update(batch, rate);
    sums.updates += 1;
    sums.critic_loss += losses.critic_loss;
    sums.q += losses.q;
    sums.target += losses.target;
    sums.actor_gradient += losses.actor_gradient_norm;
    sums.critic_gradient += losses.critic_gradient_norm;
    if (!std::isfinite(losses.critic_loss) || !std::isfinite(losses.actor_gradient_norm) ||
        !(std::abs(losses.q) < kDivergedValue))
      return fmt::format(
          "learning diverged at update {}: critic loss {}, mean Q {}, actor gradient {}; lower "
          "agent.critic_rate, agent.actor_rate, agent.tau or the weight of the potential",
          training.progress.updates + i, losses.critic_loss, losses.q, losses.actor_gradient_norm);
  }
  return {};
}

/// One environment's part of a round.
template <typename Scalar>
void explore(const TrainOptions& options, const network::Policy<Scalar>& policy, int slot,
             Training<Scalar>& training) {
  ddpg::ReplayBuffer<Scalar>& buffer = training.buffer;
  for (std::int64_t i = 0; i < options.run.round; ++i) {
    const std::int64_t round = buffer.rounds() + i;
    training.explorers[static_cast<std::size_t>(slot)].decide(
        policy, buffer, buffer.record(round, slot), buffer.features(round, slot),
        buffer.action(round, slot));
  }
}

/// After a round: adds its records to the memory, in the order of the slots.
template <typename Scalar>
void meet(const TrainOptions& options, std::int64_t updates, Training<Scalar>& training) {
  Progress& progress = training.progress;
  progress.updates += updates;
  const std::int64_t begin = training.buffer.rounds();
  training.buffer.publish(options.run.round);
  for (std::int64_t round = begin; round < training.buffer.rounds(); ++round)
    for (int slot = 0; slot < options.run.environments; ++slot) {
      if (training.buffer.record(round, slot).outcome == ddpg::RecordKind::ended) continue;
      ++progress.decisions;
      training.normaliser.add(training.buffer.features(round, slot).template cast<double>());
    }
  training.normaliser.publish();
  for (ddpg::Explorer<Scalar>& explorer : training.explorers)
    for (const network::EpisodeSummary& episode : explorer.take_finished()) progress.add(episode);
}

/// The loop.
template <typename Scalar>
TrainSummary train_with(const TrainOptions& options, const Potential* potential,
                        const fs::path& run, const EnvironmentFactory& make_environment,
                        const std::atomic<bool>& stop, std::FILE* messages,
                        parallel::Ranks& ranks) {
  Training<Scalar> training = start_training<Scalar>(options, potential, make_environment);
  // The first rank tidies up the folder before the others read in it.
  if (!ranks.first()) ranks.wait_for_all();
  if (fs::exists(checkpoint_file(run)))
    load_checkpoint(training, run);
  else if (ranks.first())
    fs::remove_all(run / "replay");  // left by a kill before the first checkpoint
  if (ranks.first()) ranks.wait_for_all();
  Progress& progress = training.progress;
  Journal journal(run, new_curve(options.environment.task.name), progress,
                  ranks.first() ? messages : nullptr);
  ThreadPool pool(options.run.threads);
  Evaluator evaluator(options, potential, make_environment, pool.size());
  TrainSummary summary;

  const auto evaluate = [&] {
    ++progress.rows;
    progress.last_row_decisions = progress.decisions;
    if (!ranks.first()) return;
    const network::Policy<Scalar> policy = policy_of(training, options);
    const CurveRow row =
        curve_row(progress, simulated_s(training), evaluator.evaluate(policy, pool));
    summary.distance_m = row.evaluation_distance_m;
    journal.keep_policy(policy,
                        {.features = training.feature_names,
                         .actions = training.action_names,
                         .action_repeat = options.run.action_repeat},
                        summary.distance_m, progress);
    progress.sums = {};
    journal.add_row(options, progress, row.values());
  };

  ddpg::Batch<Scalar> batch;
  auto last_checkpoint = Clock::now();
  bool stopped = !ranks.gather(stop ? "stop" : "")[0].empty();
  for (;;) {
    if (progress.decisions >= progress.next_evaluation) {
      evaluate();
      progress.next_evaluation += options.run.evaluate_every;
    }
    if (stopped || progress.decisions >= options.run.decisions) break;

    // A round. All environments act with the same copy of the actor; meanwhile the learner samples
    // from the rounds before. The result does not depend on timing.
    const network::Policy<Scalar> policy = policy_of(training, options);
    const std::int64_t updates = updates_due(options, progress);
    pool.run(1 + options.run.environments, [&](int task) {
      if (task == 0 && ranks.first())
        summary.divergence = learn(options, potential != nullptr, updates, training, batch);
      else if (task > 0 && explores(ranks, task - 1))
        explore(options, policy, task - 1, training);
    });
    const Orders orders =
        exchange_round(options,
                       {.stop = stop,
                        .checkpoint = seconds_since(last_checkpoint) > options.run.checkpoint_s,
                        .divergence = summary.divergence},
                       ranks, training);
    summary.divergence = orders.divergence;
    if (!summary.divergence.empty()) return summary;  // the last good checkpoint stays
    meet(options, updates, training);
    stopped = orders.stop;

    if (orders.checkpoint) {
      collect_explorers(ranks, training);
      if (ranks.first()) journal.keep([&] { save_checkpoint(training, run); });
      last_checkpoint = Clock::now();
    }
  }
  const auto keep_last = [&](const auto& write) {
    try {
      if (ranks.first()) write();
    } catch (const Error& error) {
      if (summary.unsaved.empty()) summary.unsaved = error.what();
    }
  };
  collect_explorers(ranks, training);
  keep_last([&] { save_checkpoint(training, run); });
  summary.finished = progress.decisions >= options.run.decisions;
  // After the checkpoint, so that a run that is continued with more decisions has no row that an
  // uninterrupted run would not have.
  if (summary.finished && progress.decisions > progress.last_row_decisions) evaluate();
  if (progress.rows > 0) keep_last([&] { journal.save_rows(); });
  summary.progress = progress;
  return summary;
}

}  // namespace

std::string TrainSummary::brief_report() const {
  if (!divergence.empty()) return divergence;
  return fmt::format("{} decisions, {} updates, {} episodes, {} falls; {:.2f} m, best {:.2f} m",
                     progress.decisions, progress.updates, progress.episodes, progress.falls,
                     distance_m, progress.best_distance_m);
}

void make_run_folder(const TrainOptions& options, const Demonstration& demonstration,
                     const fs::path& run) {
  options.check();
  require(!fs::exists(run / "config.toml"),
          "{}: holds a run already; continue it with --resume, or choose another folder",
          run.string());
  require(!fs::exists(run) || fs::is_directory(run), "--out {}: is a file: name a new folder",
          run.string());
  if (fs::exists(run))
    for (const fs::directory_entry& entry : fs::directory_iterator(run))
      require(entry.path().filename().string().starts_with('.'),
              "--out {}: holds {} already; a run takes a folder of its own: name a new one",
              run.string(), entry.path().filename().string());
  TrainOptions written = options;
  save(demonstration, run, written);
  write_run_options(written, run);
}

void require_same_run(const TrainOptions& options, const Demonstration& demonstration,
                      const fs::path& run) {
  constexpr std::string_view kCure = "remove that folder, or choose another for the runs";
  TrainOptions wanted = options;
  name_copies(demonstration, wanted);
  const TrainOptions held = load_run_options(run);
  const std::string difference = first_difference(held, wanted);
  require(difference.empty(), "{}: holds a run with {}: {}", run.string(), difference, kCure);
  if (!demonstration.potential) return;
  const fs::path copy = run / held.shaping.potential;
  require(to_json_text(load_potential(copy)) == to_json_text(*demonstration.potential),
          "{}: is another potential than the {} that is to shape this run: {}", copy.string(),
          held.shaping.source, kCure);
}

void write_run_options(const TrainOptions& options, const fs::path& run) {
  const std::string heading = fmt::format(
      "# stride config 1, written by stride {}\n"
      "# Everything that this run uses, in SI units. It reads back with --config.\n",
      version());
  write_file_atomically(run / "config.toml", to_toml(options, heading));
}

TrainOptions load_run_options(const fs::path& run) {
  require(fs::is_directory(run), "{}: no such run folder", run.string());
  require(fs::exists(run / "config.toml"), "{}: not a run folder: it has no config.toml",
          run.string());
  TrainOptions options;
  read_toml(run / "config.toml", options);
  options.check();
  return options;
}

TrainSummary train(const fs::path& run, const EnvironmentFactory& make_environment,
                   const std::atomic<bool>& stop, std::FILE* messages, parallel::Ranks& ranks) {
  const TrainOptions options = load_run_options(run);
  const std::optional<Potential> potential = load_run_demonstration(options, run).potential;
  std::optional<FolderLock> lock;
  if (ranks.first()) {
    lock.emplace(run);
    remove_unfinished_files(run);
    remove_unfinished_files(run / "replay");
  }
  require(options.run.learner == "ddpg", "{}: run.learner = {}: this is the loop of ddpg",
          run.string(), options.run.learner);
  const auto with = options.run.precision == "float" ? train_with<float> : train_with<double>;
  return with(options, potential ? &*potential : nullptr, run, make_environment, stop, messages,
              ranks);
}

}  // namespace stride::training
