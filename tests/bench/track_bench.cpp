#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>
#include <string>

#include "extract/annotation/labelled_clip.h"

namespace stride {
namespace {

/// From the file on disk to every part in every frame, on one core. `real_time`: seconds of video
/// tracked in a second.
void track_clip(benchmark::State& state, const char* name, bool toes) {
  cv::setNumThreads(1);
  const std::filesystem::path video = STRIDE_SOURCE_DIR "/videos/" + std::string(name) + ".mp4";
  tracking::LabelledClip labelled = tracking::clicks_on(video, keypoints_file_of(video), 0);
  if (!toes)
    for (TrajectoryFrame& frame : labelled.marks.frames)
      frame[BodyPart::toe_r] = frame[BodyPart::toe_l] = Point();
  double seconds = 0;
  for (auto _ : state) {
    const Trajectory tracked = tracking::track(video, labelled).trajectory;
    seconds += static_cast<double>(tracked.frames.size()) / tracked.rate_hz;
  }
  state.counters["real_time"] = benchmark::Counter(seconds, benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(track_clip, five_parts, "human", false)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(track_clip, seven_parts, "human", true)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace stride
