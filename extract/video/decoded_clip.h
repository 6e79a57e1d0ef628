#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "extract/skeleton/trajectory.h"
#include "extract/video/camera_motion.h"
#include "extract/video/video.h"

namespace stride::video {

/// A crop of a frame around the runner.
struct RunnerCrop {
  cv::Mat gray;      // or empty, and
  cv::Mat packed;    // one row of JPEG bytes
  cv::Point origin;  // of its top left pixel in the frame

  cv::Mat image() const;
};

/// What tracking needs of a video, in memory, so that frames are decoded once.
struct DecodedClip {
  std::vector<double> times_s;  // of every frame that could be decoded
  int first_frame = 0;          // of `crops` and `camera`: the first labelled frame
  std::vector<RunnerCrop>
      crops;  // of each frame to the last labelled one, all of one size; or none
  std::vector<CameraStep> camera;  // likewise, or none
  std::string shortfall;           // as Video::shortfall()
};

/// Returns the frames in order, from frame 0.
using FrameSource = std::function<bool(VideoFrame&)>;

struct DecodeOptions {
  bool crops = true;
  bool camera = true;
  double most_bytes = 400e6;  // of crops that are held as they are; further ones are packed
  std::function<void(int frame, int last)> progress;  // called for each frame that was decoded
};

/// Decodes all frames. Keeps crops around the pelvis between the first and the last labelled frame,
/// large enough for all labelled parts. The background is everything outside the runner.
DecodedClip decode_clip(const Trajectory& marks, const FrameSource& frames,
                        const DecodeOptions& options = {});

/// Size of the runner: median distance of the farthest labelled part from the pelvis.
double body_size_px(const Trajectory& marks);

}  // namespace stride::video
