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

}  // namespace stride
