#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>

#include "videos/clip.h"

namespace stride::videos {

/// Renders the frames of a clip (8-bit BGR).
class Renderer {
 public:
  explicit Renderer(const Clip& clip);
  ~Renderer();
  cv::Mat frame(int index) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// Writes the clip as H.264. `progress` is called after each frame.
void write_video(const Clip& clip, const std::filesystem::path& file,
                 const std::function<void(int)>& progress = {});

}  // namespace stride::videos
