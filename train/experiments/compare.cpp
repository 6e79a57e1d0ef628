#include "train/experiments/compare.h"

#include <fmt/format.h>

#include <algorithm>

#include "extract/io/error.h"
#include "extract/io/table.h"
#include "train/experiments/experiment_report.h"

namespace stride::experiments {
namespace fs = std::filesystem;
namespace {

/// Names of the run folders of an arm, sorted.
std::vector<std::string> seeds_of(const fs::path& arm) {
  std::vector<std::string> seeds;
  if (fs::is_directory(arm))
    for (const auto& entry : fs::directory_iterator(arm))
      if (fs::exists(entry.path() / "curve.csv")) seeds.push_back(entry.path().filename().string());
  std::ranges::sort(seeds);
  require(!seeds.empty(), "{}: holds no run; an arm is a folder with a run for each seed",
          arm.string());
  return seeds;
}

std::vector<Table> curves_of(const std::vector<fs::path>& arms) {
  std::vector<Table> curves;
  for (const fs::path& arm : arms)
    for (const std::string& seed : seeds_of(arm))
      curves.push_back(load_table(arm / seed / "curve.csv", "curve", 1));
  return curves;
}

std::vector<double> distances_at(const std::vector<Table>& curves, double decisions,
                                 double window) {
  std::vector<double> distances_m;
  for (const Table& curve : curves) distances_m.push_back(distance_at(curve, decisions, window));
  return distances_m;
}

/// The ratio over the pairs that have one, and their number.
std::string ratio_of(const std::vector<double>& treated, const std::vector<double>& control) {
  std::vector<double> kept_treated, kept_control;
  for (std::size_t i = 0; i < treated.size(); ++i)
    if (treated[i] > 0 && control[i] > 0) {
      kept_treated.push_back(treated[i]);
      kept_control.push_back(control[i]);
    }
  return fmt::format("{} | {}", kept_treated.size(),
                     ratio_text(paired_ratio(kept_treated, kept_control)));
}

}  // namespace

std::string compare(const CompareOptions& options) {
  const bool paired = !options.controls.empty();
  if (paired) {
    require(options.arms.size() == options.controls.size(),
            "{} arms and {} controls: every arm needs its control", options.arms.size(),
            options.controls.size());
    for (std::size_t i = 0; i < options.arms.size(); ++i)
      require(seeds_of(options.arms[i]) == seeds_of(options.controls[i]),
              "{} and {}: must have the same seeds", options.arms[i].string(),
              options.controls[i].string());
  }
  const std::vector<Table> treated = curves_of(options.arms), control = curves_of(options.controls);
  std::string text = paired ? "| decisions | control, m | arm, m | pairs | ratio |\n"
                              "|---|---|---|---|---|\n"
                            : "| decisions | runs | distance, m |\n|---|---|---|\n";
  for (const double decisions : options.decisions) {
    const std::vector<double> distances_m = distances_at(treated, decisions, options.window);
    if (paired) {
      const std::vector<double> controls_m = distances_at(control, decisions, options.window);
      text += fmt::format("| {:.0f} | {} | {} | {} |\n", decisions, plus_minus(controls_m, 1),
                          plus_minus(distances_m, 1), ratio_of(distances_m, controls_m));
    } else {
      text += fmt::format("| {:.0f} | {} | {} |\n", decisions, distances_m.size(),
                          plus_minus(distances_m, 1));
    }
  }
  return text;
}

}  // namespace stride::experiments
