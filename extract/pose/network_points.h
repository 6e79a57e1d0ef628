#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "extract/import/import.h"
#include "extract/pose/follow.h"

namespace stride::pose {

struct NetworkOptions {
  std::filesystem::path landmarks;  // .tflite; empty: the installed one
  int person = 0;                   // 1: who moves in strides for longest, 2 the next, …; 0: as 1
  std::function<void(int done, int of)> progress;
};

/// How well the network followed the runner, from the first frame on which it saw him to the last.
struct Followed {
  int frames = 0;    // of that range
  int lost = 0;      // of them: nobody was seen
  int doubtful = 0;  // of them: knees and ankles were hardly to be seen
};

struct NetworkPoints {
  imports::Detections detections;  // with a confidence that falls as the heat map does
  Followed followed;
  std::vector<int> also_running;  // other people, counted from 1, who make strides at least half as
                                  // long
};

/// The runner of a video as BlazePose sees him, without any click. Right and left are as the
/// network says: still to be repaired. Throws Error, with what to do instead, if there is no
/// network, if nobody is seen, and if the runner is lost or hardly seen on more than a quarter of
/// the frames.
NetworkPoints network_points(const std::filesystem::path& video,
                             const NetworkOptions& options = {});

/// The parts of one body, the more confident the higher their heat maps; those outside an image of
/// this size are absent, and both legs where the hips are so near to its side that one may be.
imports::ImportedFrame points_of(const PoseLandmarks& body, int frame, cv::Size image);

}  // namespace stride::pose
