#include "train/experiments/experiment_report.h"
#include "train/task/task.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/students_t.hpp>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/random.h"
#include "extract/io/table.h"
#include "extract/skeleton/movement.h"

namespace stride::experiments {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double standard_deviation(const std::vector<double>& values) {
  const double m = mean(values);
  double squares = 0;
  for (const double v : values) squares += (v - m) * (v - m);
  return std::sqrt(squares / (static_cast<double>(values.size()) - 1));
}

/// Student's t for a two-sided 95 % interval.
double student_95(std::size_t degrees) {
  return boost::math::quantile(boost::math::students_t(static_cast<double>(degrees)), 0.975);
}

/// 95 % interval of the mean: percentiles over samples of as many values drawn with replacement.
std::pair<double, double> bootstrap_95(const std::vector<double>& values) {
  constexpr int kSamples = 10000;
  Random random(1);  // always the same samples
  std::vector<double> means;
  for (int i = 0; i < kSamples; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < values.size(); ++k)
      sum += values[uniform_index(random, values.size())];
    means.push_back(sum / static_cast<double>(values.size()));
  }
  std::ranges::sort(means);
  return {means[kSamples / 40], means[kSamples - 1 - kSamples / 40]};
}

/// NaN where the run was not evaluated, or it did not come to a stride.
GaitFigures gait_of(const std::filesystem::path& run) {
  GaitFigures gait{NAN, NAN, NAN, NAN, NAN};
  if (!std::filesystem::exists(run / "evaluation.json")) return gait;
  const auto json = nlohmann::json::parse(read_file(run / "evaluation.json"), nullptr, false);
  const auto number = [&](const char* part, const char* key) -> double {
    if (!json.is_object() || !json.contains(part) || !json[part].is_object()) return NAN;
    const auto& value = json[part];
    return value.contains(key) && value[key].is_number() ? value[key].get<double>() : NAN;
  };
  return {.leg_phase = number("gait", "leg_phase"),
          .duty_factor = number("gait", "duty_factor"),
          .cadence_per_min = number("gait", "cadence_per_min"),
          .inside_share = number("clip", "inside_share"),
          .angle_rms_deg = number("clip", "angle_rms_deg")};
}

std::optional<Reached> first_reached(const Table& curve, const Table& timing, double distance_m) {
  const std::size_t x = curve.column("decisions"), y = curve.column("evaluation_distance_m");
  const std::size_t timing_x = timing.column("decisions"), wall = timing.column("wall_s");
  for (const auto& row : curve.rows) {
    if (!(row[y] >= distance_m)) continue;
    for (const auto& t : timing.rows)
      if (t[timing_x] == row[x]) return Reached{row[x], t[wall]};
    return Reached{row[x], NAN};
  }
  return std::nullopt;
}

double mean_of_column(const Table& curve, const char* name) {
  const std::size_t y = curve.column(name);
  std::vector<double> values;
  for (const auto& row : curve.rows) values.push_back(row[y]);
  return values.empty() ? NAN : mean(values);
}

/// Mean over the seeds of one of the figures; seeds without it are left out.
std::string gait_text(const ArmResult& arm, double GaitFigures::*figure, int digits) {
  std::vector<double> values;
  for (const GaitFigures& gait : arm.gait)
    if (std::isfinite(gait.*figure)) values.push_back(gait.*figure);
  return plus_minus(values, digits);
}

std::string gait_table(const std::vector<ArmResult>& results) {
  std::string text =
      "| arm | phase of the legs | duty factor | steps a minute | joint angles inside the clip's "
      "band | their rms difference, deg |\n|---|---|---|---|---|---|\n";
  for (const ArmResult& arm : results)
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", arm.label,
                        gait_text(arm, &GaitFigures::leg_phase, 2),
                        gait_text(arm, &GaitFigures::duty_factor, 2),
                        gait_text(arm, &GaitFigures::cadence_per_min, 0),
                        gait_text(arm, &GaitFigures::inside_share, 2),
                        gait_text(arm, &GaitFigures::angle_rms_deg, 0));
  return text;
}

std::string claim_text(const ExperimentFile& experiment, const std::vector<ArmResult>& results,
                       int digits) {
  const ExperimentClaim& claim = experiment.claim;
  const Verdict verdict = verdict_on(claim, results);
  const std::string after = fmt::format(
      "after {:.0f} k decisions", claim.at * static_cast<double>(experiment.decisions) / 1000);
  std::string text = fmt::format("Claim: {}.\n\n**{}**: ", claim.text, verdict.word);
  if (std::isfinite(verdict.ratio.ratio))
    return text + fmt::format(
                      "{} over {} {} {} over {} pairs of seeds, bootstrap {:.2f} … {:.2f}; a ratio "
                      "of {:.2f} would have been told from 1.\n\n",
                      claim.better, claim.than, after, ratio_text(verdict.ratio), verdict.pairs,
                      verdict.ratio.bootstrap_low, verdict.ratio.bootstrap_high,
                      verdict.ratio.detectable());
  if (std::isfinite(verdict.difference.low_m))
    return text + fmt::format("{} less {} {} {} m over {} pairs of seeds.\n\n", claim.better,
                              claim.than, after, difference_text(verdict.difference, digits),
                              verdict.pairs);
  return text + fmt::format("no interval; the pairs of seeds are too few: {}.\n\n", verdict.pairs);
}

/// If every arm has a ratio to the first one at the end.
bool have_ratios(const std::vector<ArmResult>& results) {
  return std::ranges::all_of(results, [&](const ArmResult& arm) {
    const auto &own = arm.distance_m.back(), &first = results.front().distance_m.back();
    return std::isfinite(paired_ratio(own, first).ratio) ||
           !std::isfinite(paired_difference(own, first).low_m);
  });
}

std::string reached_text(const std::vector<std::optional<Reached>>& seeds) {
  std::vector<double> thousands, minutes;
  for (const auto& seed : seeds)
    if (seed) {
      thousands.push_back(seed->decisions / 1000);
      minutes.push_back(seed->wall_s / 60);
    }
  if (thousands.empty()) return "never";
  std::string text = fmt::format("{} k; {} min", plus_minus(thousands, 0), plus_minus(minutes, 1));
  if (thousands.size() < seeds.size())
    text += fmt::format(" ({} of {})", thousands.size(), seeds.size());
  return text;
}

template <std::size_t N, class Head, class Cell>
std::string table(const std::vector<ArmResult>& results, std::size_t from,
                  const std::array<double, N>& columns, Head head, Cell cell) {
  std::string text = "| arm |", rule = "|---|";
  for (const double column : columns) {
    text += fmt::format(" {} |", head(column));
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (std::size_t i = from; i < results.size(); ++i) {
    text += fmt::format("| {} |", results[i].label);
    for (std::size_t k = 0; k < N; ++k) text += fmt::format(" {} |", cell(results[i], k));
    text += "\n";
  }
  return text;
}

}  // namespace

std::string plus_minus(const std::vector<double>& values, int digits) {
  if (values.empty() || !std::isfinite(mean(values))) return "–";
  if (values.size() < 2) return fmt::format("{:.{}f}", mean(values), digits);
  const double error = standard_deviation(values) / std::sqrt(static_cast<double>(values.size()));
  return fmt::format("{:.{}f} ± {:.{}f}", mean(values), digits, error, digits);
}

std::string ratio_text(const PairedRatio& r) {
  if (!std::isfinite(r.ratio)) return "–";
  return fmt::format("{:.2f} ({:.2f} … {:.2f})", r.ratio, r.low, r.high);
}

std::string difference_text(const PairedDifference& d, int digits) {
  if (!std::isfinite(d.low_m)) return "–";
  return fmt::format("{0:.{3}f} ({1:.{3}f} … {2:.{3}f})", d.mean_m, d.low_m, d.high_m, digits);
}

double distance_at(const Table& curve, double at, double window, const std::string& column) {
  const std::size_t x = curve.column(column), y = curve.column("evaluation_distance_m");
  std::vector<double> values;
  double last = NAN;
  for (const auto& row : curve.rows) {
    if (row[x] > at + 0.1 * window) break;
    last = row[y];
    if (row[x] > at - 0.9 * window) values.push_back(last);
  }
  return values.empty() ? last : mean(values);
}

std::vector<ArmResult> results_of(const std::vector<Arm>& arms, std::int64_t decisions,
                                  double milestone_m) {
  std::vector<ArmResult> results;
  for (const Arm& arm : arms) {
    const auto budget = static_cast<double>(arm.decisions > 0 ? arm.decisions : decisions);
    ArmResult result;
    result.label = arm.label;
    for (const std::filesystem::path& run : arm.runs) {
      const Table curve = load_table(run / "curve.csv", "curve", 1);
      const Table timing = load_table(run / "timing.csv", "timing", 1);
      for (std::size_t k = 0; k < kBudgetShares.size(); ++k)
        result.distance_m[k].push_back(
            distance_at(curve, kBudgetShares[k] * budget, kWindowShare * budget));
      for (std::size_t k = 0; k < kMilestones; ++k)
        result.reached[k].push_back(
            first_reached(curve, timing, milestone_m * static_cast<double>(k + 1)));
      result.mean_distance_m.push_back(mean_of_column(curve, "evaluation_distance_m"));
      result.gait.push_back(gait_of(run));
    }
    results.push_back(std::move(result));
  }
  return results;
}

PairedRatio paired_ratio(const std::vector<double>& treated, const std::vector<double>& control) {
  std::vector<double> logs;
  for (std::size_t i = 0; i < std::min(treated.size(), control.size()); ++i)
    logs.push_back(std::log(treated[i] / control[i]));
  PairedRatio unknown{NAN, NAN, NAN, NAN, NAN};
  if (logs.size() < 2 || !std::isfinite(mean(logs))) return unknown;
  const double half_width = student_95(logs.size() - 1) * standard_deviation(logs) /
                            std::sqrt(static_cast<double>(logs.size()));
  const auto [low, high] = bootstrap_95(logs);
  return {std::exp(mean(logs)), std::exp(mean(logs) - half_width),
          std::exp(mean(logs) + half_width), std::exp(low), std::exp(high)};
}

PairedDifference paired_difference(const std::vector<double>& treated,
                                   const std::vector<double>& control) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < std::min(treated.size(), control.size()); ++i)
    differences.push_back(treated[i] - control[i]);
  if (differences.size() < 2 || !std::isfinite(mean(differences))) return {NAN, NAN, NAN};
  const double m = mean(differences),
               half_width = student_95(differences.size() - 1) * standard_deviation(differences) /
                            std::sqrt(static_cast<double>(differences.size()));
  return {m, m - half_width, m + half_width};
}

Verdict verdict_on(const ExperimentClaim& claim, const std::vector<ArmResult>& results) {
  const auto better = std::ranges::find(results, claim.better, &ArmResult::label);
  const auto than = std::ranges::find(results, claim.than, &ArmResult::label);
  const auto share = std::ranges::find(kBudgetShares, claim.at);
  require(better != results.end() && than != results.end() && share != kBudgetShares.end(),
          "the claim compares {} with {}: there are no results of them", claim.better, claim.than);
  const auto k = static_cast<std::size_t>(share - kBudgetShares.begin());
  Verdict verdict{.ratio = paired_ratio(better->distance_m[k], than->distance_m[k]),
                  .difference = paired_difference(better->distance_m[k], than->distance_m[k]),
                  .pairs = better->distance_m[k].size(),
                  .word = "undecided"};
  const bool by_ratio = std::isfinite(verdict.ratio.ratio);
  if (by_ratio ? verdict.ratio.low > 1 : verdict.difference.low_m > 0) verdict.word = "holds";
  if (by_ratio ? verdict.ratio.high < 1 : verdict.difference.high_m < 0)
    verdict.word = "the opposite holds";
  return verdict;
}

std::string experiment_report(const ExperimentFile& experiment,
                              const std::vector<ArmResult>& results, const std::string& command) {
  const task::TaskOptions& task = experiment.task();
  const double milestone_m = task::milestone_m(task.name);
  const int digits = milestone_m < 1 ? 2 : 1;
  std::string measure(task::measure_of(task.name));
  measure[0] = static_cast<char>(std::toupper(measure[0]));
  const auto at = [&experiment](double share) {
    return fmt::format("{:.0f} k", share * static_cast<double>(experiment.decisions) / 1000);
  };
  std::string text = fmt::format("# {}\n\n    {}\n\n", experiment.title, command);
  if (!experiment.claim.text.empty()) text += claim_text(experiment, results, digits);
  text += fmt::format(
      "{} (m) without noise, mean ± standard error over {} seeds, after so many "
      "decisions (evaluations of the twentieth of the budget before; of an arm with another "
      "budget after the same share of it):\n\n",
      measure, results.front().distance_m[0].size());
  text += table(results, 0, kBudgetShares, at, [digits](const ArmResult& arm, std::size_t k) {
    return plus_minus(arm.distance_m[k], digits);
  });
  const bool ratios = have_ratios(results);
  text +=
      ratios
          ? fmt::format("\nRatio to {}, geometric mean over paired seeds with 95 % interval:\n\n",
                        results.front().label)
          : fmt::format("\nDifference to {}, m, mean over paired seeds with 95 % interval:\n\n",
                        results.front().label);
  text += table(results, 1, kBudgetShares, at, [&](const ArmResult& arm, std::size_t k) {
    const auto &own = arm.distance_m[k], &first = results.front().distance_m[k];
    return ratios ? ratio_text(paired_ratio(own, first))
                  : difference_text(paired_difference(own, first), digits);
  });
  text += "\nFirst evaluation that reached so far, in decisions and wall clock:\n\n";
  std::array<double, kMilestones> milestones_m{};
  for (std::size_t k = 0; k < kMilestones; ++k)
    milestones_m[k] = milestone_m * static_cast<double>(k + 1);
  text += table(
      results, 0, milestones_m, [](double d) { return fmt::format("{:g} m", d); },
      [](const ArmResult& arm, std::size_t k) { return reached_text(arm.reached[k]); });
  text += "\nMean over the whole curve, m:\n\n";
  for (const ArmResult& arm : results)
    text += fmt::format("- {}: {}\n", arm.label, plus_minus(arm.mean_distance_m, digits));
  const bool evaluated = std::ranges::any_of(results, [](const ArmResult& arm) {
    return std::ranges::any_of(
        arm.gait, [](const GaitFigures& gait) { return std::isfinite(gait.duty_factor); });
  });
  if (evaluated && movement(task.movement).repeats)
    text += fmt::format("\nHow they {} at the end (½: legs in turn, 0: at once):\n\n",
                        task.movement == "walk" ? "walk" : "run") +
            gait_table(results);
  text += "\nEach seed at the end, m, and their standard deviation:\n\n";
  for (const ArmResult& arm : results) {
    text += fmt::format("- {}:", arm.label);
    for (const double d : arm.distance_m.back()) text += fmt::format(" {:.{}f}", d, digits);
    if (arm.distance_m.back().size() > 1)
      text += fmt::format("; {:.{}f}", standard_deviation(arm.distance_m.back()), digits);
    text += "\n";
  }
  return text + fmt::format("\n![{} against {}]({}.png)\n\n![against wall clock](wall.png)\n",
                            task.name == "distance" ? "distance" : task::measure_of(task.name),
                            experiment.against(), experiment.against());
}

}  // namespace stride::experiments
