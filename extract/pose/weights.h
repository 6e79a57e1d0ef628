#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stride::pose {

/// The two files of the pose network.
struct Weights {
  std::filesystem::path landmarks, detector;
};

/// Where `./setup.sh --pose` puts them: stride/pose in the user's data folder ($XDG_DATA_HOME,
/// ~/.local/share), or in one of the machine's ($XDG_DATA_DIRS, /usr/local/share, /usr/share).
std::vector<std::filesystem::path> weight_folders();

/// The files of the first folder that has both; nothing if none has.
std::optional<Weights> installed_weights();

/// `landmarks` and the detector beside it. Throws Error if one is missing.
Weights weights_at(const std::filesystem::path& landmarks);

/// What to do where there are none: a sentence for users.
std::string how_to_install_weights();

}  // namespace stride::pose
