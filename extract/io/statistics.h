#pragma once

#include <vector>

namespace stride {

/// The upper of the two in the middle where their number is even; NaN where there are none.
double median(std::vector<double> values);

}  // namespace stride
