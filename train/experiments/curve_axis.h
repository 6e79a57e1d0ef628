#pragma once

#include <filesystem>
#include <string>

#include "extract/io/table.h"

namespace stride::experiments {

/// What the curves of runs are drawn and compared against.
struct CurveAxis {
  const char* name;      // after --against: decisions, simulated or wall
  const char* column;    // of load_run_curve()
  const char* quantity;  // in a heading
  bool seconds;          // the column's unit; otherwise it counts
};

/// Throws Error for a name that is none of the three.
const CurveAxis& curve_axis(const std::string& name);

/// RUN/curve.csv. Against wall clock with the column wall_s of timing.csv, whose rows are of the
/// same evaluations; of a run that goes on, as many rows as both files have.
Table load_run_curve(const std::filesystem::path& run, const CurveAxis& axis);

}  // namespace stride::experiments
