#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stride::experiments {

/// What is compared: folders with one run a seed (ARM/1, ARM/2, …), each with its curve.csv.
struct CompareOptions {
  std::vector<std::filesystem::path> arms;      // pooled
  std::vector<std::filesystem::path> controls;  // of each arm, in the same order; or none at all
  std::string against = "decisions";            // decisions, simulated (s) or wall (clock, s)
  std::vector<double> at;                       // where the curves are compared, of `against`
  std::optional<double> window = {};            // before it, averaged; 40 000 decisions if none
};

/// A table in Markdown, one row for each of `at`: the mean distance over all runs and,
/// with controls, the ratio over the pairs of equal seed in all experiments (geometric mean with
/// Student's 95 % interval). A pair with a distance ≤ 0 has no ratio and is left out; the table
/// says how many pairs remain. Throws Error if arms and controls differ in number, a folder has no
/// runs, a seed is missing on one side, `against` is another word, or seconds have no window.
std::string compare(const CompareOptions& options);

}  // namespace stride::experiments
