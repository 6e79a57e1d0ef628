#pragma once

#include <array>
#include <vector>

namespace stride::gait {

/// Sagittal angles of measured runners against the stride from foot strike, rad: mean and range of
/// their strides (calibrate/data/human_running.csv names them).
struct HumanRunning {
  struct AngleBand {
    std::vector<double> mean, low, high;  // at `phase`
  };
  std::vector<double> phase;  // 0 … 1
  AngleBand hip, knee, ankle;

  /// Linear between the samples.
  double at(const std::vector<double>& curve, double phase) const;
};

HumanRunning load_human_running();

}  // namespace stride::gait
