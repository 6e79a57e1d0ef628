#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "extract/import/parsing/detections.h"

namespace CLI {
class App;
}

namespace stride::imports {

/// Reads the points of one person from a file or a folder of files, whichever of the formats it is.
/// Throws Error naming the file, the line and what was expected there.
Detections import_points(const std::filesystem::path& file_or_folder,
                         const ImportOptions& options = ImportOptions());

/// The names that `ImportOptions::format` takes.
const std::vector<std::string>& import_formats();

/// Adds --person, --format, --labels, … to a command that imports.
void add_import_options(CLI::App& command, ImportOptions& options);

}  // namespace stride::imports
