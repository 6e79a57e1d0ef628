#include "calibrate/gait/human_running.h"

#include <cmath>
#include <filesystem>

#include "extract/io/data_file.h"
#include "extract/io/table.h"
#include "extract/skeleton/units.h"

namespace stride::gait {

double HumanRunning::at(const std::vector<double>& curve, double at_phase) const {
  const double position = (at_phase - std::floor(at_phase)) * static_cast<double>(phase.size() - 1);
  const auto i = static_cast<std::size_t>(position);
  const double part = position - static_cast<double>(i);
  return (1 - part) * curve[i] + part * curve[std::min(i + 1, curve.size() - 1)];
}

HumanRunning load_human_running() {
  const Table table = load_csv(data_file("calibrate/data/human_running.csv"));
  const auto column = [&](const std::string& name, double unit) {
    std::vector<double> values;
    for (const auto& row : table.rows) values.push_back(unit * row[table.column(name)]);
    return values;
  };
  const auto joint = [&](const std::string& name) {
    return HumanRunning::AngleBand{column(name + "_mean", kDegree), column(name + "_low", kDegree),
                                   column(name + "_high", kDegree)};
  };
  return {column("percent", 0.01), joint("hip"), joint("knee"), joint("ankle")};
}

}  // namespace stride::gait
