#include "train/experiments/curve_axis.h"

#include <algorithm>
#include <array>

#include "extract/io/error.h"

namespace stride::experiments {
namespace {

constexpr std::array<CurveAxis, 3> kAxes{{{"decisions", "decisions", "decisions", false},
                                          {"simulated", "simulated_s", "simulated time", true},
                                          {"wall", "wall_s", "wall clock", true}}};

}  // namespace

const CurveAxis& curve_axis(const std::string& name) {
  const auto* const axis =
      std::ranges::find_if(kAxes, [&](const CurveAxis& a) { return name == a.name; });
  require(axis != kAxes.end(), "--against {}: must be decisions, simulated or wall", name);
  return *axis;
}

Table load_run_curve(const std::filesystem::path& run, const CurveAxis& axis) {
  Table curve = load_table(run / "curve.csv", "curve", 1);
  if (axis.column != std::string("wall_s")) return curve;
  const Table timing = load_table(run / "timing.csv", "timing", 1);
  const std::size_t wall = timing.column("wall_s");
  curve.columns.emplace_back("wall_s");
  curve.rows.resize(std::min(curve.rows.size(), timing.rows.size()));
  for (std::size_t i = 0; i < curve.rows.size(); ++i) curve.rows[i].push_back(timing.rows[i][wall]);
  return curve;
}

}  // namespace stride::experiments
