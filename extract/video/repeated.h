#pragma once

#include <filesystem>

namespace stride::video {

/// Writes a clip that is a loop, as a GIF of one stride or one step, several times over, as an mp4.
/// Throws Error as Video and VideoWriter do, and if the clip has one frame only.
void write_repeated(const std::filesystem::path& video, int times,
                    const std::filesystem::path& out);

}  // namespace stride::video
