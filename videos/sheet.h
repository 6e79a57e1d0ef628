#pragma once

#include <filesystem>
#include <vector>

#include "videos/clip.h"

namespace stride::videos {

/// A picture of the clips in `folder`, with a row for each: crops of the eight clicked positions of
/// one stride, with the clicks.
void write_sheet(const std::vector<Clip>& clips, const std::filesystem::path& folder,
                 const std::filesystem::path& picture);

}  // namespace stride::videos
