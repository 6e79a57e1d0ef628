#pragma once

#include <string_view>

namespace stride::task {

/// Measures of a task that are worth telling apart in a report are so far apart, m. Throws Error
/// for an unknown task.
double milestone_m(std::string_view task);

}  // namespace stride::task
