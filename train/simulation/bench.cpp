#include "train/simulation/bench.h"

#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <random>
#include <thread>

#include "extract/io/random.h"
#include "train/simulation/engine/runner_layout.h"
#include "train/simulation/make_engine.h"

namespace stride::simulation {
namespace {

constexpr double kStep_s = 0.01;
constexpr int kHeldSteps = 10, kEpisodeSteps = 1000, kRecordedSteps = 100;
constexpr double kFallHeight_m = 0.65;

double wall_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double thread_cpu_s() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double resident_MiB() {
  std::ifstream statm("/proc/self/statm");
  double total = 0, resident = 0;
  statm >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// An engine that runs one episode after another.
class BenchedEngine {
 public:
  BenchedEngine(const std::string& name, const osim::Model& model, const BenchOptions& options,
                std::uint64_t seed)
      : engine_(simulation::make_engine(name, model, options.engine)),
        start_(simulation::default_state(model)),
        obstacles_(options.obstacles),
        running_(options.running ? &*options.running : nullptr),
        random_(seed) {
    result_.engine = name;
    result_.workload = running_ ? "running" : "random";
    begin_episode();
  }

  /// Runs for the given wall time or number of steps.
  void run(double seconds, long steps) {
    const double cpu = thread_cpu_s(), end = wall_s() + seconds;
    const long last = result_.steps + steps;
    while (steps > 0 ? result_.steps < last : wall_s() < end) step();
    result_.cpu_s += thread_cpu_s() - cpu;
  }

  const BenchResult& result() const { return result_; }
  Engine& engine() { return *engine_; }

  void begin_episode() {
    step_ = 0;
    if (running_) {
      engine_->set_state(running_->states[begin_]);
      return;
    }
    std::vector<Obstacle> obstacles;
    for (int i = 0; i < obstacles_; ++i) {
      const double radius = 0.05 + 0.1 * uniform(random_);
      obstacles.push_back(
          {0.3 + 5 * uniform(random_), radius * (0.5 * uniform(random_) - 0.25), radius});
    }
    engine_->set_obstacles(obstacles);
    engine_->set_state(start_);
    engine_->equilibrate_fibers();
  }

  /// False at the end of an episode.
  bool step_once() {
    if (running_)
      excitations_ = running_->excitations[begin_ + static_cast<std::size_t>(step_)];
    else if (step_ % kHeldSteps == 0)
      for (double& e : excitations_) e = uniform(random_);
    ++step_;
    const AdvanceReport report = engine_->advance(excitations_, kStep_s);
    ++result_.steps;
    result_.evaluations += report.evaluations;
    result_.integration_steps += report.steps;
    result_.rejected += report.rejected;
    if (!report.ok) {
      if (result_.failures++ == 0) result_.first_failure = report.failure;
      return false;
    }
    const bool fell = engine_->state().q[kPelvisY] < kFallHeight_m;
    const bool late = running_ ? step_ >= kRecordedSteps || at_end() : step_ >= kEpisodeSteps;
    result_.falls += fell;
    result_.time_limits += late && !fell;
    return !fell && !late;
  }

 private:
  void step() {
    if (step_once()) return;
    if (running_) begin_ = at_end() ? 0 : begin_ + static_cast<std::size_t>(step_);
    begin_episode();
  }
  bool at_end() const {
    return begin_ + static_cast<std::size_t>(step_) >= running_->states.size();
  }

  std::unique_ptr<Engine> engine_;
  RunnerState start_;
  int obstacles_;
  const Recording* running_;  // or null
  std::size_t begin_ = 0;     // of the episode in it
  std::mt19937_64 random_;
  Excitations excitations_{};
  int step_ = 0;
  BenchResult result_;
};

void add(BenchResult& sum, const BenchResult& part) {
  sum.steps += part.steps;
  sum.evaluations += part.evaluations;
  sum.integration_steps += part.integration_steps;
  sum.rejected += part.rejected;
  sum.falls += part.falls;
  sum.time_limits += part.time_limits;
  sum.failures += part.failures;
  if (sum.first_failure.empty()) sum.first_failure = part.first_failure;
  sum.cpu_s += part.cpu_s;
}

/// Engines of one kind, one a thread.
struct Team {
  std::vector<std::unique_ptr<BenchedEngine>> engines;
  BenchResult result;

  void run(double seconds, long steps) {
    const double start = wall_s();
    std::vector<std::thread> threads;
    for (std::size_t i = 1; i < engines.size(); ++i) {
      threads.emplace_back([&, i] { engines[i]->run(seconds, steps); });
    }
    engines[0]->run(seconds, steps);
    for (std::thread& thread : threads) thread.join();
    result.wall_s += wall_s() - start;
  }
};

/// Rollouts of a second: the coordinates after each step.
using Trace = std::vector<std::array<double, kCoordinates>>;

Trace trace(BenchedEngine& benched) {
  Trace all;
  benched.begin_episode();
  for (int i = 0; i < 100; ++i) {
    const bool on = benched.step_once();
    all.push_back(benched.engine().state().q);
    if (!on) break;
  }
  return all;
}

double difference(const Trace& a, const Trace& b) {
  double worst = 0;
  for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n) {
    for (int i = 0; i < kCoordinates; ++i) worst = std::max(worst, std::abs(a[n][i] - b[n][i]));
  }
  return worst;
}

}  // namespace

std::vector<BenchResult> bench(const std::vector<std::string>& engines, const osim::Model& model,
                               const BenchOptions& options) {
  constexpr int kTurns = 10;
  std::vector<Team> teams;
  for (const std::string& name : engines) {
    Team& team = teams.emplace_back();
    team.result.engine = name;
    team.result.workload = options.running ? "running" : "random";
    team.result.threads = options.threads;
    team.result.accuracy = options.engine.accuracy;
    for (int i = 0; i < options.threads; ++i) {
      team.engines.push_back(
          std::make_unique<BenchedEngine>(name, model, options, options.seed + i));
    }
  }
  const long first = options.steps / 100;  // to warm up, before memory is looked at
  for (Team& team : teams) {
    team.run(options.seconds / 100, first);
    team.result.resident_start_MiB = resident_MiB();
  }
  for (int turn = 0; turn < kTurns; ++turn) {
    const long steps =
        (options.steps - first) * (turn + 1) / kTurns - (options.steps - first) * turn / kTurns;
    for (Team& team : teams) team.run(0.99 * options.seconds / kTurns, steps);
  }
  std::vector<BenchResult> results;
  for (Team& team : teams) {
    for (const auto& benched : team.engines) add(team.result, benched->result());
    team.result.resident_MiB = resident_MiB();
    results.push_back(team.result);
  }
  return results;
}

std::vector<AccuracyRow> accuracy_table(const osim::Model& model, const AccuracyOptions& options) {
  const auto rollouts = [&](const std::string& engine, double accuracy, BenchResult& sum) {
    BenchOptions bench;
    bench.engine.accuracy = accuracy;
    std::vector<Trace> traces;
    for (int i = 0; i < options.rollouts; ++i) {
      BenchedEngine benched(engine, model, bench, options.seed + i);
      const double cpu = thread_cpu_s();
      traces.push_back(trace(benched));
      sum.cpu_s += thread_cpu_s() - cpu;
      add(sum, benched.result());
    }
    return traces;
  };
  BenchResult ignored;
  const std::vector<Trace> reference = rollouts("planar", 1e-9, ignored);
  std::vector<AccuracyRow> rows;
  for (const std::string& engine : options.engines) {
    for (const double accuracy : options.accuracies) {
      BenchResult sum;
      const std::vector<Trace> traces = rollouts(engine, accuracy, sum);
      std::vector<double> errors;
      for (std::size_t i = 0; i < traces.size(); ++i) {
        errors.push_back(difference(traces[i], reference[i]));
      }
      std::sort(errors.begin(), errors.end());
      rows.push_back({engine, accuracy, sum.evaluations_per_step(), sum.steps_per_cpu_s(),
                      errors[errors.size() / 2], errors[errors.size() * 9 / 10], errors.back()});
    }
  }
  return rows;
}

}  // namespace stride::simulation
