#include "train/training/journal.h"

#include <unistd.h>

#include <cmath>

#include "train/training/curve.h"

namespace stride::training {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

namespace {

std::string duration_text(double s) {
  if (!std::isfinite(s)) return "?";
  const auto t = static_cast<long>(s);
  if (t >= 3600) return fmt::format("{} h {:02} min", t / 3600, t / 60 % 60);
  if (t >= 60) return fmt::format("{} min {:02} s", t / 60, t % 60);
  return fmt::format("{} s", t);
}

}  // namespace

Journal::Journal(const std::filesystem::path& run, const Table& curve, const Progress& progress,
                 std::FILE* messages)
    : run_(run),
      messages_(messages),
      terminal_(messages && ::isatty(::fileno(messages))),
      curve_(curve),
      timing_(new_timing()) {
  if (progress.rows > 0) {
    curve_ = load_rows(run / "curve.csv", curve_, progress.rows);
    timing_ = load_rows(run / "timing.csv", timing_, progress.rows);
    wall_before_s_ = timing_.rows.back()[timing_.column("wall_s")];
  }
  last_decisions_ = progress.decisions;
  last_updates_ = progress.updates;
}

void Journal::add_row(const TrainOptions& options, const Progress& progress,
                      std::vector<double> row) {
  const double s = seconds_since(last_row_);
  const auto decisions = static_cast<double>(progress.decisions - last_decisions_);
  const auto updates = static_cast<double>(progress.updates - last_updates_);
  const double steps_per_s = decisions * options.run.action_repeat / s;
  timing_.rows.push_back({static_cast<double>(progress.decisions),
                          wall_before_s_ + seconds_since(start_), steps_per_s, updates / s});
  distance_m_ = row[curve_.column("evaluation_distance_m")];
  curve_.rows.push_back(std::move(row));
  keep([&] { save_rows(); });
  last_row_ = Clock::now();
  last_decisions_ = progress.decisions;
  last_updates_ = progress.updates;
  tell(options, progress, steps_per_s, decisions / s);
}

void Journal::save_rows() const {
  save(curve_, run_ / "curve.csv");
  save(timing_, run_ / "timing.csv");
}

/// On a terminal the line is rewritten; elsewhere one is printed every minute.
void Journal::tell(const TrainOptions& options, const Progress& progress, double steps_per_s,
                   double decisions_per_s) {
  if (messages_ == nullptr) return;
  if (!terminal_ && curve_.rows.size() > 1 && seconds_since(last_line_) < 60) return;
  last_line_ = Clock::now();
  const auto left = static_cast<double>(options.run.decisions - progress.decisions);
  fmt::print(messages_, "{}{} of {} decisions, {:.0f} steps/s, {:.2f} m, best {:.2f} m, {} left{}",
             terminal_ ? "\r\033[K" : "", progress.decisions, options.run.decisions, steps_per_s,
             distance_m_, progress.best_distance_m,
             duration_text(decisions_per_s > 0 ? left / decisions_per_s : NAN),
             terminal_ ? "" : "\n");
  std::fflush(messages_);
  line_open_ = terminal_;
}

}  // namespace stride::training
