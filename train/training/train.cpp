#include "train/training/train.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <ctime>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "train/training/checkpoint.h"
#include "train/training/curve.h"
#include "train/training/thread_pool.h"

namespace stride::training {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

/// Values beyond it count as divergence; rewards in metres cannot add up to it.
constexpr double kDivergedValue = 1e6;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Locks the folder against a second training program.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& run)
      : descriptor_(::open((run / "config.toml").c_str(), O_RDONLY | O_CLOEXEC)) {
    require(descriptor_ >= 0 && ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0,
            "{}: another stride is training in this folder", run.string());
  }
  ~FolderLock() { ::close(descriptor_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

/// Removes files that a kill left half written (write_file_atomically()).
void remove_unfinished_files(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  std::vector<fs::path> unfinished;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension().string().starts_with(".tmp")) unfinished.push_back(entry.path());
  for (const fs::path& file : unfinished) fs::remove(file);
}

std::string duration_text(double s) {
  if (!std::isfinite(s)) return "?";
  const auto t = static_cast<long>(s);
  if (t >= 3600) return fmt::format("{} h {:02} min", t / 3600, t / 60 % 60);
  if (t >= 60) return fmt::format("{} min {:02} s", t / 60, t % 60);
  return fmt::format("{} s", t);
}

/// The files that grow during training, and the progress line.
class Journal {
 public:
  Journal(const fs::path& run, const Progress& progress, std::FILE* messages)
      : run_(run), messages_(messages), terminal_(messages && ::isatty(::fileno(messages))) {
    if (progress.rows > 0) {
      curve_ = load_rows(run / "curve.csv", curve_, progress.rows);
      timing_ = load_rows(run / "timing.csv", timing_, progress.rows);
      wall_before_s_ = timing_.rows.back()[1];
    }
    last_decisions_ = progress.decisions;
    last_updates_ = progress.updates;
  }

  double wall_s() const { return wall_before_s_ + seconds_since(start_); }

  void add_row(const TrainOptions& options, const Progress& progress, std::vector<double> row) {
    const double s = seconds_since(last_row_);
    const auto decisions = static_cast<double>(progress.decisions - last_decisions_);
    const auto updates = static_cast<double>(progress.updates - last_updates_);
    const double steps_per_s = decisions * options.run.action_repeat / s;
    timing_.rows.push_back({row[0], wall_s(), steps_per_s, updates / s});
    distance_m_ = row[6];
    curve_.rows.push_back(std::move(row));
    keep([&] { save_rows(); });
    last_row_ = Clock::now();
    last_decisions_ = progress.decisions;
    last_updates_ = progress.updates;
    tell(options, progress, steps_per_s, decisions / s);
  }

  /// Runs a function that writes to the disk; a failure is reported, and training continues.
  template <typename Write>
  void keep(const Write& write) {
    try {
      write();
    } catch (const Error& error) {
      say("warning: {}; training goes on, writing is tried again later", error.what());
    }
  }

  void save_rows() const {
    save(curve_, run_ / "curve.csv");
    save(timing_, run_ / "timing.csv");
  }

  template <typename... Args>
  void say(fmt::format_string<Args...> text, Args&&... args) {
    if (messages_ == nullptr) return;
    fmt::print(messages_, "{}{}\n", std::exchange(line_open_, false) ? "\n" : "",
               fmt::format(text, std::forward<Args>(args)...));
    std::fflush(messages_);
  }

 private:
  /// On a terminal the line is rewritten; elsewhere one is printed every minute.
  void tell(const TrainOptions& options, const Progress& progress, double steps_per_s,
            double decisions_per_s) {
    if (messages_ == nullptr) return;
    if (!terminal_ && curve_.rows.size() > 1 && seconds_since(last_line_) < 60) return;
    last_line_ = Clock::now();
    const auto left = static_cast<double>(options.run.decisions - progress.decisions);
    fmt::print(
        messages_, "{}{} of {} decisions, {:.0f} steps/s, {:.2f} m, best {:.2f} m, {} left{}",
        terminal_ ? "\r\033[K" : "", progress.decisions, options.run.decisions, steps_per_s,
        distance_m_, progress.best_distance_m,
        duration_text(decisions_per_s > 0 ? left / decisions_per_s : NAN), terminal_ ? "" : "\n");
    std::fflush(messages_);
    line_open_ = terminal_;
  }

  fs::path run_;
  std::FILE* messages_;
  bool terminal_, line_open_ = false;
  Table curve_ = new_curve(), timing_ = new_timing();
  double wall_before_s_ = 0, distance_m_ = 0;
  std::int64_t last_decisions_ = 0, last_updates_ = 0;
  Clock::time_point start_ = Clock::now(), last_row_ = start_, last_line_ = start_;
};

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
      if (training.buffer.record(round, slot).outcome == ddpg::Outcome::ended) continue;
      ++progress.decisions;
      training.normaliser.add(training.buffer.features(round, slot).template cast<double>());
    }
  training.normaliser.publish();
  for (ddpg::Explorer<Scalar>& explorer : training.explorers)
    for (const network::EpisodeSummary& episode : explorer.take_finished()) {
      ++progress.episodes;
      progress.falls += episode.fell;
      progress.failures += episode.failed;
      progress.sums.episodes += 1;
      progress.sums.distance_m += episode.distance_m;
      progress.sums.reward += episode.reward;
    }
}

/// Evaluates the agent without noise, in episodes that start by the rules.
template <typename Scalar>
class Evaluator {
 public:
  Evaluator(const TrainOptions& options, const Potential* potential,
            const EnvironmentFactory& make_environment)
      : options_(options),
        potential_(potential),
        environment_(make_environment(-1)),
        observer_(make_observer(options, potential, environment_->spec())) {}

  std::vector<network::EpisodeSummary> evaluate(const network::Policy<Scalar>& policy) {
    std::vector<network::EpisodeSummary> episodes;
    for (int i = 0; i < options_.run.evaluation_episodes; ++i)
      episodes.push_back(network::run_episode(policy, *environment_, observer_, potential_,
                                              options_.run.action_repeat,
                                              static_cast<std::uint64_t>(i), nullptr));
    return episodes;
  }

 private:
  const TrainOptions& options_;
  const Potential* potential_;
  std::unique_ptr<environment::Environment> environment_;
  environment::Observer observer_;
};

/// The loop.
template <typename Scalar>
TrainSummary train_with(const TrainOptions& options, const Potential* potential,
                        const fs::path& run, const EnvironmentFactory& make_environment,
                        const std::atomic<bool>& stop, std::FILE* messages) {
  Training<Scalar> training = start_training<Scalar>(options, potential, make_environment);
  if (fs::exists(checkpoint_file(run)))
    load_checkpoint(training, run);
  else
    fs::remove_all(run / "replay");  // left by a kill before the first checkpoint
  Progress& progress = training.progress;
  Journal journal(run, progress, messages);
  ThreadPool pool(options.run.threads);
  Evaluator<Scalar> evaluator(options, potential, make_environment);
  TrainSummary summary;

  const auto evaluate = [&] {
    const network::Policy<Scalar> policy = policy_of(training, options);
    std::vector<double> row =
        curve_row(progress, simulated_s(training), evaluator.evaluate(policy));
    summary.distance_m = row[6];
    const auto keep_as = [&](const char* name) {
      journal.keep([&] {
        network::save_policy(policy, training.feature_names, training.action_names,
                             options.run.action_repeat, run / name);
      });
    };
    keep_as("agent.safetensors");
    if (summary.distance_m > progress.best_distance_m) {
      progress.best_distance_m = summary.distance_m;
      keep_as("best.safetensors");
    }
    progress.sums = {};
    ++progress.rows;
    progress.last_row_decisions = progress.decisions;
    journal.add_row(options, progress, std::move(row));
  };

  ddpg::Batch<Scalar> batch;
  auto last_checkpoint = Clock::now();
  for (;;) {
    if (progress.decisions >= progress.next_evaluation) {
      evaluate();
      progress.next_evaluation += options.run.evaluate_every;
    }
    if (stop || progress.decisions >= options.run.decisions) break;

    // A round. All environments act with the same copy of the actor; meanwhile the learner samples
    // from the rounds before. The result does not depend on timing.
    const network::Policy<Scalar> policy = policy_of(training, options);
    const std::int64_t updates = updates_due(options, progress);
    pool.run(1 + options.run.environments, [&](int task) {
      if (task == 0)
        summary.divergence = learn(options, potential != nullptr, updates, training, batch);
      else
        explore(options, policy, task - 1, training);
    });
    if (!summary.divergence.empty()) return summary;  // the last good checkpoint stays
    meet(options, updates, training);

    if (seconds_since(last_checkpoint) > options.run.checkpoint_s) {
      journal.keep([&] { save_checkpoint(training, run); });
      last_checkpoint = Clock::now();
    }
  }
  const auto keep_last = [&](const auto& write) {
    try {
      write();
    } catch (const Error& error) {
      if (summary.unsaved.empty()) summary.unsaved = error.what();
    }
  };
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
  if (fs::exists(run))
    for (const fs::directory_entry& entry : fs::directory_iterator(run))
      require(entry.path().filename().string().starts_with('.'),
              "--out {}: holds {} already; a run takes a folder of its own: name a new one",
              run.string(), entry.path().filename().string());
  TrainOptions written = options;
  save(demonstration, run, written);
  write_run_options(written, run);
}

void write_run_options(const TrainOptions& options, const fs::path& run) {
  constexpr const char* kHeading =
      "# stride config 1, written by stride " STRIDE_VERSION
      "\n# Everything that this run uses, in SI units. It reads back with --config.\n";
  write_file_atomically(run / "config.toml", to_toml(options, kHeading));
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
                   const std::atomic<bool>& stop, std::FILE* messages) {
  const TrainOptions options = load_run_options(run);
  const std::optional<Potential> potential = load_run_demonstration(options, run).potential;
  const FolderLock lock(run);
  remove_unfinished_files(run);
  remove_unfinished_files(run / "replay");
  const auto with = options.run.precision == "float" ? train_with<float> : train_with<double>;
  return with(options, potential ? &*potential : nullptr, run, make_environment, stop, messages);
}

}  // namespace stride::training
