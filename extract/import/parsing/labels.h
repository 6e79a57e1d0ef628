#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "extract/skeleton/trajectory.h"

namespace stride::imports {

/// Maps the points of a file to our parts. Made once from the names of the file's points, in order.
class LabelMap {
 public:
  /// Recognises the usual spellings (knee_r, RKnee, right_knee, Right Knee, …) and, before them,
  /// `own` (our part → label). Throws Error naming `where`, the labels and the cure when none of
  /// them is a part of ours, or when an entry of `own` is not in the file.
  LabelMap(std::span<const std::string> labels, const std::map<std::string, std::string>& own,
           const std::string& where);

  /// The points of our parts from those of the file, in the order of its labels. Absent points are
  /// those without finite coordinates.
  std::array<Point, kBodyPartCount> parts(std::span<const Point> points) const;

  /// Labels that are no part of ours.
  std::vector<std::string> unused(std::span<const std::string> labels) const;

 private:
  struct Target {
    BodyPart part;
    int priority;  // the highest present one is used; equal ones are averaged
  };
  std::vector<std::vector<Target>> targets_;  // by label
};

/// Names of the points of the fixed layouts of 15 (OpenPose MPI), 17 (COCO), 18 (OpenPose COCO),
/// 25 (OpenPose BODY_25), 26 and 136 (HALPE), 33 (MediaPipe) and 133 (COCO-WholeBody) points; empty
/// otherwise. A point that we do not use has an empty name. Source: the projects' own keypoint
/// lists.
std::vector<std::string> layout_of(std::size_t points);

}  // namespace stride::imports
