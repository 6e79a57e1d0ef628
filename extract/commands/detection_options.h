#pragma once

#include "extract/import/import.h"
#include "extract/pose/pose_points.h"

namespace CLI {
class App;
}

namespace stride {

/// Adds to a command the options of points that are not clicked: of another program's --format,
/// --person, …, of a pose network's --pose, …, and of both --no-leg-repair.
void add_detection_options(CLI::App& command, imports::ImportOptions& import,
                           pose::PoseOptions& pose, bool& repair_legs);

/// Throws Error if one of these options was given and has no effect: of an imported file without
/// `import_from`, of a user's network without one.
void require_effect(const CLI::App& command, const std::filesystem::path& import_from,
                    const pose::PoseOptions& pose);

}  // namespace stride
