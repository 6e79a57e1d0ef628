#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "extract/skeleton/trajectory.h"
#include "extract/video/camera_motion.h"
#include "extract/video/video.h"

namespace stride::video {

/// The runner on a frame.
struct Crop {
  cv::Mat gray;
  cv::Point origin;  // of its top left pixel in the frame
};

/// What tracking needs of a video, kept in memory: frames are decoded only once.
struct DecodedClip {
  std::vector<double> times_s;     // of every frame that could be decoded
  int first_frame = 0;             // of the two below: that of the first mark
  std::vector<Crop> crops;         // of each frame until the last mark, of one size; or none
  std::vector<CameraStep> camera;  // likewise, or none
  std::string shortfall;           // as Video::shortfall()
};

/// Hands out the frames front to back, from frame 0.
using FrameSource = std::function<bool(VideoFrame&)>;

struct DecodeOptions {
  bool crops = true;
  bool camera = true;
  std::function<void(int frame, int last)> progress;  // called for each frame that was decoded
};

/// Reads all frames; keeps of those between the first mark and the last a crop around the pelvis,
/// as wide as the marked parts ever are from it. The background is what lies outside the runner.
DecodedClip decode_clip(const Trajectory& marks, const FrameSource& frames,
                        const DecodeOptions& options = {});

/// Median distance of the farthest marked part from the pelvis: the size of what is followed.
double body_size_px(const Trajectory& marks);

}  // namespace stride::video
