#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "extract/import.h"

/// One reader a format: content of a file in, everybody that it holds out. `file` is for the error
/// messages. All throw Error with file, line and what was expected; none guesses.
namespace stride {

/// One person in one frame.
struct DetectedPerson {
  int frame = 0;
  std::string id;  // the file's name for this person; empty: not said
  std::array<Point, kBodyPartCount> points;
};
using DetectedPeople = std::vector<DetectedPerson>;

/// One frame of OpenPose (15, 18 or 25 points).
DetectedPeople read_openpose(std::string_view content, const std::string& file, int frame);
/// Analysis or labels, one or several animals.
DetectedPeople read_deeplabcut(std::string_view content, const std::string& file,
                               const ImportOptions& options);

}  // namespace stride
