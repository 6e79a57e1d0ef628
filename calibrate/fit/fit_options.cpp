#include "calibrate/fit/fit_options.h"

#include <cmath>

#include "extract/io/error.h"

namespace stride::fit {

FitOptions fit_options(const RunnerSize& size) {
  const int given =
      size.height_m.has_value() + size.leg_m.has_value() + size.metres_per_pixel.has_value();
  require(given <= 1, "height, leg, scale: {} of them are given: give the one you know best",
          given);
  const auto check = [](const char* name, double value, double least, double most) {
    require(value >= least && value <= most, "{} = {}: must be in [{}, {}] m", name, value, least,
            most);
  };
  FitOptions options;
  options.size_given = given > 0;
  if (size.height_m) {
    check("height", *size.height_m, 0.4, 3);
    // For a known height only the proportion is uncertain: 0.476 (measured runners) to 0.491
    // (Drillis and Contini 1966).
    options.leg_m = {0.4835 * *size.height_m, 0.025};
  }
  if (size.leg_m) {
    check("leg", *size.leg_m, 0.2, 1.5);
    options.leg_m = {*size.leg_m, 0.005};
  }
  if (size.metres_per_pixel) {
    check("scale", *size.metres_per_pixel, 1e-5, 0.2);
    options.metres_per_pixel = size.metres_per_pixel;
  }
  return options;
}

}  // namespace stride::fit
