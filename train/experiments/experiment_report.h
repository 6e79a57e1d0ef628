#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "extract/io/table.h"
#include "train/experiments/experiment_file.h"
#include "train/experiments/plot.h"

namespace stride::experiments {

/// Shares of the budget at which arms are compared.
inline constexpr std::array kBudgetShares{0.1, 0.2, 0.3, 0.5, 1.0};
/// Arms are timed to so many multiples of task::milestone_m.
inline constexpr std::size_t kMilestones = 6;
/// The share of the budget over which evaluations are averaged.
inline constexpr double kWindowShare = 0.05;

/// Mean evaluation distance in (at − 0.9 window, at + 0.1 window] of a column, m: an evaluation
/// happens up to a round after its time. Where the window is empty, the last evaluation before it;
/// NaN if there is none.
double distance_at(const Table& curve, double at, double window,
                   const std::string& column = "decisions");

/// The first evaluation of a curve that reached a milestone.
struct Reached {
  double decisions = 0;
  double wall_s = 0;
};

/// Of a run's evaluation.json.
struct GaitFigures {
  double leg_phase = 0, duty_factor = 0, cadence_per_min = 0;  // GaitSummary
  double inside_share = 0, angle_rms_deg = 0;                  // ClipSimilarity
};

/// The results of one arm, with an element for each seed. Distances are the measure of the task.
struct ArmResult {
  std::string label;
  /// Mean of the evaluations in the twentieth of the budget that ends at each of kBudgetShares, or
  /// the last before, m; NaN where there is none.
  std::array<std::vector<double>, kBudgetShares.size()> distance_m;
  /// Mean of all evaluations of a curve: the area under it, divided by the budget, m.
  std::vector<double> mean_distance_m;
  /// How the agents run at the end; NaN where it is not known.
  std::vector<GaitFigures> gait;
  /// The first evaluation that reached each milestone; none if no evaluation did.
  std::array<std::vector<std::optional<Reached>>, kMilestones> reached;
};

/// Reads curve.csv and timing.csv of the runs. `decisions` is the budget of arms without their own.
std::vector<ArmResult> results_of(const std::vector<Arm>& arms, std::int64_t decisions,
                                  double milestone_m = 5);

/// A ratio over paired seeds: exp of the mean of log ratios, with Student's 95 % interval and that
/// of the bootstrap (percentiles over resampled pairs).
struct PairedRatio {
  double ratio = 0, low = 0, high = 0;  // NaN where there are too few seeds, or a distance ≤ 0
  double bootstrap_low = 0, bootstrap_high = 0;

  /// The smallest ratio above 1 that so many seeds with that scatter would have told from 1.
  double detectable() const { return ratio / low; }
};
PairedRatio paired_ratio(const std::vector<double>& treated, const std::vector<double>& control);

/// The mean difference over paired seeds with Student's 95 % interval, m: what is told where an arm
/// measures nothing, a jump that falls, so that there is no ratio.
struct PairedDifference {
  double mean_m = 0, low_m = 0, high_m = 0;  // NaN where there are too few seeds
};
PairedDifference paired_difference(const std::vector<double>& treated,
                                   const std::vector<double>& control);

/// What became of a claim.
struct Verdict {
  PairedRatio ratio;
  PairedDifference difference;
  std::size_t pairs = 0;
  /// "holds" if the interval of the ratio is above 1, or without one that of the difference above
  /// 0; "the opposite holds" if it is below, else "undecided".
  std::string word;
};
Verdict verdict_on(const ExperimentClaim& claim, const std::vector<ArmResult>& results);

/// Mean ± standard error, and ratio or difference (interval), for a table; "–" where there is none.
std::string plus_minus(const std::vector<double>& values, int digits);
std::string ratio_text(const PairedRatio& ratio);
std::string difference_text(const PairedDifference& difference, int digits);

/// results.md: the verdict, distances, ratios to the first arm, times to distances and gaits, as
/// tables.
std::string experiment_report(const ExperimentFile& experiment,
                              const std::vector<ArmResult>& results, const std::string& command);

}  // namespace stride::experiments
