#include "extract/skeleton/calibration_line.h"

#include <fmt/format.h>

#include <cmath>

#include "extract/io/error.h"

namespace stride {

double CalibrationLine::relative_sd() const {
  constexpr double kClick_px = 1.5, kPlane = 0.015;
  return std::hypot(std::sqrt(2.0) * kClick_px / length_px(), kPlane);
}

void check(const CalibrationLine& line, const std::string& what) {
  constexpr double kLeast_m = 0.05, kMost_m = 200, kFinest = 1e-5, kCoarsest = 0.2;  // m per px
  require(line.frame >= 0, "{}: frame {}: must not be negative", what, line.frame);
  require(
      line.from_px.allFinite() && line.to_px.allFinite() && line.length_px() >= kShortestLine_px,
      "{}: {:.1f} px long: must be {} px or more, for two clicks to tell a length", what,
      line.length_px(), kShortestLine_px);
  require(line.length_m >= kLeast_m && line.length_m <= kMost_m,
          "{}: length {} m: must be {} to {} m", what, line.length_m, kLeast_m, kMost_m);
  require(line.metres_per_pixel() >= kFinest && line.metres_per_pixel() <= kCoarsest,
          "{}: {} m on {:.1f} px, {:.3g} m per pixel: must be {} to {}", what, line.length_m,
          line.length_px(), line.metres_per_pixel(), kFinest, kCoarsest);
}

std::string text_of(const CalibrationLine& line) {
  return fmt::format("{:.4g} m on {:.1f} px at frame {}: {:.3f} mm per pixel", line.length_m,
                     line.length_px(), line.frame, 1000 * line.metres_per_pixel());
}

}  // namespace stride
