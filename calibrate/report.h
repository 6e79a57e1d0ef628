#pragma once

#include <filesystem>
#include <string>

#include "calibrate/calibrate.h"

namespace stride {

/// What was found out about a clip, for a person: verdict, stride, camera, runner, residuals.
std::string report_text(const Trajectory& trajectory, const SagittalModel& model,
                        const Calibration& calibration);

/// Draws marks against the fit, the eight poses, and the angles against the band of measured
/// runners, as SVG (or PNG, by the extension). Throws Error if gnuplot cannot be run.
void draw_report(const Trajectory& trajectory, const Calibration& calibration,
                 const std::filesystem::path& file);

/// OpenSim's storage of the nine coordinates, degrees and metres: NAME.mot.
void save_mot(const CalibratedTrajectory& run, const std::filesystem::path& file);

}  // namespace stride
