#pragma once

#include <filesystem>

#include "extract/annotation/labelled_clip.h"
#include "extract/import/import.h"

namespace stride::tracking {

struct PointsOnVideoOptions {
  double slow_motion = 1;         // seconds of video a second of the runner
  bool repair_legs = true;        // of a detector's points, which are on most frames
  imports::ImportOptions import;  // what the user said of the file
};

/// Points of another program, or of a pose model, as marks on a video: the one place where such
/// points meet a picture, for every command. Decodes the video once.
///
/// What does not fit is put right where the file or the user says how (numbers of frames that count
/// from 1, the size of another picture), refused where it cannot be this video's (its hash, more
/// frames than there are), and otherwise told on stderr: points outside the picture, which are left
/// out where they are few, coordinates that are no pixels, points that do not go where the picture
/// goes, frames without points at the end, legs that were swapped.
LabelledClip points_on(const std::filesystem::path& video, const imports::Detections& detections,
                       const PointsOnVideoOptions& options);

}  // namespace stride::tracking
