#include "extract/video/repeated.h"

#include "extract/io/error.h"
#include "extract/video/video.h"
#include "extract/video/video_writer.h"

namespace stride::video {

void write_repeated(const std::filesystem::path& video, int times,
                    const std::filesystem::path& out) {
  const std::vector<double> times_s = video_times(video, 1).times_s;
  require(times_s.size() > 1, "{}: one frame only: no loop", video.string());
  VideoWriter writer(out, static_cast<double>(times_s.size() - 1) / times_s.back());
  for (int i = 0; i < times; ++i) {
    Video loop(video);
    for (VideoFrame frame; loop.read(frame);) writer.write(frame.image);
  }
  writer.finish();
}

}  // namespace stride::video
