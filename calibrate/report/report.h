#pragma once

#include <filesystem>
#include <string>

#include "calibrate/calibrate.h"

namespace stride::report {

/// The result as text: verdict, stride, camera, runner, residuals.
std::string report_text(const Trajectory& trajectory, const SagittalModel& model,
                        const Calibration& calibration);

/// Draws, as SVG: the keyframes on frames of the video (on white if `video` is empty); labelled
/// points and the fit with 95 % bands over the clip and over the stride; the angles and the range
/// of measured runners. Throws Error if gnuplot cannot be run.
void draw_report(const Trajectory& trajectory, const SagittalModel& model,
                 const Calibration& calibration, const std::filesystem::path& video,
                 const std::filesystem::path& file);

/// OpenSim's storage of the nine coordinates, degrees and metres: NAME.mot.
void save_mot(const CalibratedTrajectory& run, const std::filesystem::path& file);

}  // namespace stride::report
