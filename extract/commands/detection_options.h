#pragma once

#include "extract/import/import.h"
#include "extract/pose/pose_points.h"

namespace CLI {
class App;
}

namespace stride {

/// Adds to a command the options of points from another program: --format, --person, …
void add_import_options(CLI::App& command, imports::ImportOptions& options);
/// Adds to a command the options of points from a pose model: --pose, …
void add_pose_options(CLI::App& command, pose::PoseOptions& options);

/// Throws Error if one of these options was given and has no effect: of an imported file without
/// `import_from`, of a user's network without one.
void require_effect(const CLI::App& command, const std::filesystem::path& import_from,
                    const pose::PoseOptions& pose);

}  // namespace stride
