#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "extract/skeleton/body_part.h"
#include "extract/skeleton/trajectory.h"

namespace stride::imports {

struct ImportOptions {
  std::string format;         // one of import_formats(); empty: by the content
  int person = 0;             // 1: the largest for the longest time, 2: the next, …; 0: as 1
  double min_confidence = 0;  // points below it are absent
  /// Labels of the file for our parts ("knee_r" → "pt3"); tried before the usual spellings.
  std::map<std::string, std::string> labels;
  int y_up_height_px = 0;  // height of the video where the file's y grows upwards; 0: y down
  double rate_hz = 0;      // frame rate of the video, for files that say times and no frames
};

/// One frame of a file. Parts that were not seen are absent (`Point::present()`).
struct ImportedFrame {
  int frame = 0;  // index in decoding order, from 0
  std::array<Point, kBodyPartCount> points;

  const Point& operator[](BodyPart part) const { return points[index(part)]; }
  Point& operator[](BodyPart part) { return points[index(part)]; }
};

struct ImportedPerson {
  int first_frame = 0, last_frame = 0, frames = 0;
  double height_px = 0;  // median extent of the points
};

/// One person's points, detected or labelled, in pixels as in `Point`. The pelvis is the file's own
/// middle of the hips, else the mean of its two hips; the head is the file's, else the mean of the
/// ears, else the nose. Confidence is the file's, clamped to [0, 1]; labels have 1, hidden ones
/// 0.5.
struct Detections {
  std::string format;                  // one of import_formats()
  std::vector<ImportedFrame> frames;   // growing `frame`, each with at least one point
  std::vector<ImportedPerson> people;  // everybody in the file, largest sustained first
  int person = 1;                      // the one taken, counted from 1
};

/// One person in one frame.
struct DetectedPerson {
  int frame = 0;
  std::string id;  // the file's name for this person; empty: not said
  std::array<Point, kBodyPartCount> points;
};
using DetectedPeople = std::vector<DetectedPerson>;

}  // namespace stride::imports
