#pragma once

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

#include "extract/io/error.h"
#include "extract/io/table.h"
#include "train/network/policy.h"
#include "train/training/training.h"

namespace stride::training {

double seconds_since(std::chrono::steady_clock::time_point start);

/// The files that grow during training, and the progress line.
class Journal {
 public:
  /// `curve`: an empty one. `messages` may be null.
  Journal(const std::filesystem::path& run, const Table& curve, const Progress& progress,
          std::FILE* messages);

  /// A row of the curve, which has a column evaluation_distance_m.
  void add_row(const TrainOptions& options, const Progress& progress, std::vector<double> row);

  /// Writes the policy to agent.safetensors, and if it came farther than any before also to
  /// best.safetensors; then progress.best_distance_m is that distance.
  template <typename Scalar>
  void keep_policy(const network::Policy<Scalar>& policy, const network::PolicyNames& names,
                   double distance_m, Progress& progress) {
    const auto keep_as = [&](const char* name) {
      keep([&] {
        network::save_policy(policy, names.features, names.actions, names.action_repeat,
                             run_ / name);
      });
    };
    keep_as("agent.safetensors");
    if (distance_m <= progress.best_distance_m) return;
    progress.best_distance_m = distance_m;
    keep_as("best.safetensors");
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

  void save_rows() const;

  template <typename... Args>
  void say(fmt::format_string<Args...> text, Args&&... args) {
    if (messages_ == nullptr) return;
    fmt::print(messages_, "{}{}\n", std::exchange(line_open_, false) ? "\n" : "",
               fmt::format(text, std::forward<Args>(args)...));
    std::fflush(messages_);
  }

 private:
  using Clock = std::chrono::steady_clock;
  void tell(const TrainOptions& options, const Progress& progress, double steps_per_s,
            double decisions_per_s);

  std::filesystem::path run_;
  std::FILE* messages_;
  bool terminal_, line_open_ = false;
  Table curve_, timing_;
  double wall_before_s_ = 0, distance_m_ = 0;
  std::int64_t last_decisions_ = 0, last_updates_ = 0;
  Clock::time_point start_ = Clock::now(), last_row_ = start_, last_line_ = start_;
};

}  // namespace stride::training
