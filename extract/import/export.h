#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "extract/skeleton/trajectory.h"

namespace stride::imports {

/// Writes a trajectory for other programs, in pixels as in `Point`. `format` is one of
/// export_formats(); empty: by the name (.csv, .json, .trc; a name without a dot is a folder of
/// OpenPose files).
/// - csv: frame, time_s, <part>_x, <part>_y, <part>_confidence; empty cells where absent.
/// - json: {"format": "stride points", "version": 1, …, "frames": [{"frame", "time_s", "points":
///   {"knee_r": [x, y, confidence]}}]}.
/// - trc: as Sports2D's pixel files (y down, z = 0), Units px. It has no confidence.
/// - deeplabcut: CSV of an analysed video, parts by our names, likelihood = confidence.
/// - openpose: a folder of BODY_25 JSON, one file a frame. Points without confidence are missing.
/// Every format reads back with import_points(). Throws Error naming the file.
void export_points(const Trajectory& trajectory, const std::filesystem::path& to,
                   const std::string& format = "");

/// Throws Error as export_points() would for the name, before anything is done.
void check_export(const std::filesystem::path& to, const std::string& format = "");

const std::vector<std::string>& export_formats();

}  // namespace stride::imports
