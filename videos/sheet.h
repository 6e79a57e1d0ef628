#pragma once

#include <filesystem>
#include <vector>

#include "videos/clip.h"

namespace stride::videos {

/// A picture of the clips as they are in `folder`: a row a clip, the eight positions of one stride
/// at which it is clicked, cut out around the runner, the clicks marked.
void write_sheet(const std::vector<Clip>& clips, const std::filesystem::path& folder,
                 const std::filesystem::path& picture);

}  // namespace stride::videos
