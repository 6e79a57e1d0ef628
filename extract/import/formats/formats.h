#pragma once

#include <string>
#include <string_view>

#include "extract/import/parsing/detections.h"

/// One reader for each format, from the content of a file to all detected people. `file` is for
/// error messages. All throw Error with file, line and what was expected.
namespace stride::imports {

/// One frame of OpenPose (15, 18 or 25 points).
DetectedPeople read_openpose(std::string_view content, const std::string& file, int frame);
/// Analysis or labels, one or several animals.
DetectedPeople read_deeplabcut(std::string_view content, const std::string& file,
                               const ImportOptions& options);
/// Results of COCO and AlphaPose (a list), annotations of COCO (an object).
DetectedPeople read_coco(std::string_view content, const std::string& file,
                         const ImportOptions& options);
/// What MMPose's demo writes with --save-predictions.
DetectedPeople read_mmpose(std::string_view content, const std::string& file,
                           const ImportOptions& options);
/// Analysis CSV.
DetectedPeople read_sleap(std::string_view content, const std::string& file,
                          const ImportOptions& options);
/// Sports2D's pixels, OpenSim's form.
DetectedPeople read_trc(std::string_view content, const std::string& file,
                        const ImportOptions& options);
/// CVAT for video 1.1: skeletons, tracks in tracks, or a track a point.
DetectedPeople read_cvat(std::string_view content, const std::string& file,
                         const ImportOptions& options);
/// One table of all tracks.
DetectedPeople read_kinovea(std::string_view content, const std::string& file,
                            const ImportOptions& options);
/// DLTdv and Argus xypts, first camera.
DetectedPeople read_dltdv(std::string_view content, const std::string& file,
                          const ImportOptions& options);
/// What export_points() writes, and NAME.trajectory.csv.
DetectedPeople read_own_csv(std::string_view content, const std::string& file,
                            const ImportOptions& options);
DetectedPeople read_own_json(std::string_view content, const std::string& file);

}  // namespace stride::imports
