#pragma once

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace stride::experiments {

/// A level that curves are compared with, dashed: the demonstration's own distance, say.
struct Level {
  double value = 0;
  std::string label;  // empty: none is drawn
};

struct PlotOptions {
  std::string against = "decisions";             // decisions, simulated (hours), wall (hours)
  std::string column = "evaluation_distance_m";  // of curve.csv
  std::string title = {};
  Level level = {};
  std::filesystem::path out = "plot";  // plot.svg, plot.png, plot.csv, plot.gnuplot
};

/// Runs of one arm of an experiment, which differ in their seed.
struct Arm {
  std::string label;
  std::vector<std::filesystem::path> runs;
  std::int64_t decisions = 0;  // of each run; 0: those of the experiment
};

/// Runs whose folders are named by a number are seeds of the arm that is the folder above:
/// baseline/1 baseline/2 shaped/1 are two arms. Any other run is an arm of its own.
std::vector<Arm> arms_of(const std::vector<std::filesystem::path>& runs);

/// Draws mean ± standard error over the runs of each arm with gnuplot; data and script stay beside
/// the picture. Runs are interpolated to common abscissae up to the end of the shortest. Throws
/// Error naming the run or column, or if gnuplot fails.
void plot(const std::vector<Arm>& arms, const PlotOptions& options);

/// Redraws whenever a curve grows, until `stop` is set. Waits for runs without data; `messages` (or
/// null) receives the reason, and a line for every picture.
void watch(const std::vector<Arm>& arms, const PlotOptions& options, const std::atomic<bool>& stop,
           std::FILE* messages);

}  // namespace stride::experiments
