#pragma once

#include <vector>

namespace stride {

/// The median; of an even number of values the upper of the two middle ones. NaN if empty.
double median(std::vector<double> values);

}  // namespace stride
