#include "train/experiments/compare.h"

#include <fmt/format.h>

#include <algorithm>

#include "extract/io/error.h"
#include "extract/io/table.h"
#include "train/experiments/curve_axis.h"
#include "train/experiments/experiment_report.h"

namespace stride::experiments {
namespace fs = std::filesystem;
namespace {

constexpr double kWindowDecisions = 40000;

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

std::vector<Table> curves_of(const std::vector<fs::path>& arms, const CurveAxis& axis) {
  std::vector<Table> curves;
  for (const fs::path& arm : arms)
    for (const std::string& seed : seeds_of(arm))
      curves.push_back(load_run_curve(arm / seed, axis));
  return curves;
}

std::vector<double> distances_at(const std::vector<Table>& curves, double at, double window,
                                 const CurveAxis& axis) {
  std::vector<double> distances_m;
  for (const Table& curve : curves)
    distances_m.push_back(distance_at(curve, at, window, axis.column));
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
  const CurveAxis& axis = curve_axis(options.against);
  require(options.window || !axis.seconds, "--against {}: --window is needed, in seconds",
          options.against);
  const double window = options.window.value_or(kWindowDecisions);
  const std::vector<Table> treated = curves_of(options.arms, axis),
                           control = curves_of(options.controls, axis);
  std::string text = fmt::format("| {}{} |", axis.quantity, axis.seconds ? ", s" : "");
  text += paired ? " control, m | arm, m | pairs | ratio |\n|---|---|---|---|---|\n"
                 : " runs | distance, m |\n|---|---|---|\n";
  for (const double at : options.at) {
    const std::vector<double> distances_m = distances_at(treated, at, window, axis);
    if (paired) {
      const std::vector<double> controls_m = distances_at(control, at, window, axis);
      text += fmt::format("| {:.0f} | {} | {} | {} |\n", at, plus_minus(controls_m, 1),
                          plus_minus(distances_m, 1), ratio_of(distances_m, controls_m));
    } else {
      text +=
          fmt::format("| {:.0f} | {} | {} |\n", at, distances_m.size(), plus_minus(distances_m, 1));
    }
  }
  return text;
}

}  // namespace stride::experiments
