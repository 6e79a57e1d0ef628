#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stride::video {

/// A piece of the recording that a QuickTime or MPEG-4 file has players show: an entry of the
/// `elst` of its first video track.
struct Edit {
  double lasts_s = 0;  // as played
  double from_s = 0;   // of the recording; NaN: nothing is shown
  double rate = 1;     // recorded seconds a played second; 0: one picture stands
};

/// Of a movie's `moov` box, without its header. Empty where it has none that can be read.
std::vector<Edit> edits_in(std::string_view moov);

/// Of a file; empty for other formats.
std::vector<Edit> read_edits(const std::filesystem::path& file);

/// What players make of the recording, where that is more than its plain course; else empty. Of
/// many pieces the first three are told, and how many more there are.
std::string text_of(const std::vector<Edit>& edits);

}  // namespace stride::video
