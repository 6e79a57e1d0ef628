#pragma once

#include <filesystem>
#include <vector>

namespace stride::video {

/// Presentation times of the frames as the file has them, growing; empty if it cannot be read.
std::vector<double> packet_times_s(const std::filesystem::path& file);

}  // namespace stride::video
