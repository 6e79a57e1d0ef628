#include "train/experiments/experiment_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "extract/io/table.h"

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

double distance_at(const Table& curve, double decisions, double window) {
  const std::size_t x = curve.column("decisions"), y = curve.column("evaluation_distance_m");
  std::vector<double> values;
  double last = NAN;
  for (const auto& row : curve.rows) {
    if (row[x] > decisions + 0.1 * window) break;
    last = row[y];
    if (row[x] > decisions - 0.9 * window) values.push_back(last);
  }
  return values.empty() ? last : mean(values);
}

std::vector<ArmResult> results_of(const std::vector<Arm>& arms, std::int64_t decisions) {
  const auto budget = static_cast<double>(decisions);
  std::vector<ArmResult> results;
  for (const Arm& arm : arms) {
    ArmResult result{.label = arm.label, .distance_m = {}, .reached = {}};
    for (const std::filesystem::path& run : arm.runs) {
      const Table curve = load_table(run / "curve.csv", "curve", 1);
      const Table timing = load_table(run / "timing.csv", "timing", 1);
      for (std::size_t k = 0; k < kBudgetShares.size(); ++k)
        result.distance_m[k].push_back(
            distance_at(curve, kBudgetShares[k] * budget, kWindowShare * budget));
      for (std::size_t k = 0; k < kDistances_m.size(); ++k)
        result.reached[k].push_back(first_reached(curve, timing, kDistances_m[k]));
    }
    results.push_back(std::move(result));
  }
  return results;
}

PairedRatio paired_ratio(const std::vector<double>& treated, const std::vector<double>& control) {
  std::vector<double> logs;
  for (std::size_t i = 0; i < std::min(treated.size(), control.size()); ++i)
    logs.push_back(std::log(treated[i] / control[i]));
  if (logs.size() < 2) return {NAN, NAN, NAN};
  const double half_width = student_95(logs.size() - 1) * standard_deviation(logs) /
                            std::sqrt(static_cast<double>(logs.size()));
  return {std::exp(mean(logs)), std::exp(mean(logs) - half_width),
          std::exp(mean(logs) + half_width)};
}

std::string experiment_report(const std::string& title, const std::vector<ArmResult>& results,
                              std::int64_t decisions, const std::string& command) {
  const auto at = [decisions](double share) {
    return fmt::format("{:.0f} k", share * static_cast<double>(decisions) / 1000);
  };
  std::string text = fmt::format(
      "# {}\n\n    {}\n\n"
      "Distance in 10 s (m) without noise, mean ± standard error over {} seeds, after so many "
      "decisions (evaluations of the twentieth of the budget before):\n\n",
      title, command, results.front().distance_m[0].size());
  text += table(results, 0, kBudgetShares, at, [](const ArmResult& arm, std::size_t k) {
    return plus_minus(arm.distance_m[k], 1);
  });
  text += fmt::format("\nRatio to {}, geometric mean over paired seeds with 95 % interval:\n\n",
                      results.front().label);
  text += table(results, 1, kBudgetShares, at, [&results](const ArmResult& arm, std::size_t k) {
    return ratio_text(paired_ratio(arm.distance_m[k], results.front().distance_m[k]));
  });
  text += "\nFirst evaluation that reached so far, in decisions and wall clock:\n\n";
  text += table(
      results, 0, kDistances_m, [](double d) { return fmt::format("{:.0f} m", d); },
      [](const ArmResult& arm, std::size_t k) { return reached_text(arm.reached[k]); });
  text += "\nEach seed at the end, m:\n\n";
  for (const ArmResult& arm : results) {
    text += fmt::format("- {}:", arm.label);
    for (const double d : arm.distance_m.back()) text += fmt::format(" {:.1f}", d);
    text += "\n";
  }
  return text +
         "\n![distance against decisions](decisions.png)\n\n![against wall clock](wall.png)\n";
}

}  // namespace stride::experiments
