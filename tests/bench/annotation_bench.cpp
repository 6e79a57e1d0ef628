#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "extract/annotation/asking.h"
#include "extract/annotation/session/session.h"
#include "extract/video/video_writer.h"
#include "tests/support/temporary_folder.h"

namespace stride {
namespace {

constexpr int kFrames = 300, kStride = 20, kWidth = 1920, kHeight = 1080;

/// Ten seconds of noise in full HD; the content of the picture does not matter.
std::filesystem::path long_clip(const TemporaryFolder& folder) {
  const auto file = folder / "clip.mp4";
  cv::Mat coarse(kHeight / 40, kWidth / 40, CV_8UC3), image;
  cv::RNG random(1);
  random.fill(coarse, cv::RNG::UNIFORM, 0, 255);
  cv::resize(coarse, image, {kWidth, kHeight}, 0, 0, cv::INTER_CUBIC);
  video::VideoWriter writer(file, 30);
  for (int i = 0; i < kFrames; ++i) writer.write(image);
  writer.finish();
  return file;
}

Eigen::Vector2d place(int frame, BodyPart part) {
  const double phase = 2 * std::numbers::pi * frame / kStride;
  return {600 + 2.0 * frame + 60 * std::sin(phase + static_cast<double>(index(part))),
          500 + 40.0 * static_cast<double>(index(part))};
}

/// Every phase frame clicked, every frame tracked.
Keypoints clicked(const video::VideoInfo& info) {
  Keypoints keypoints;
  keypoints.video = "clip.mp4";
  keypoints.video_sha256 = "00";
  keypoints.width_px = info.width_px;
  keypoints.height_px = info.height_px;
  keypoints.direction = Facing::right;
  keypoints.near_leg = Side::right;
  for (int frame = 0; frame < kFrames - 5; frame += kStride / 8) {
    keypoints.frames[frame].time_s = frame / 30.0;
    for (const BodyPart part : annotation::asking_order(Side::right, false, false))
      keypoints.frames[frame][part] = Click{place(frame, part), ClickState::seen, ""};
  }
  return keypoints;
}

annotation::Prediction tracked() {
  annotation::Prediction prediction;
  prediction.stride_frames = kStride;
  for (int i = 0; i < kFrames; ++i) {
    TrajectoryFrame& frame = prediction.trajectory.frames.emplace_back();
    frame.frame = i;
    for (const BodyPart part : kBodyParts) frame[part] = {place(i, part), 0.5};
  }
  return prediction;
}

/// From a click in a 1920×1080 clip to the picture that shows it, including the write to the disk.
/// The canvas has the size of the default window, or shows every pixel.
void click_to_picture(benchmark::State& state, const cv::Size& canvas_px, bool other_frame) {
  cv::setNumThreads(1);
  static const TemporaryFolder folder;
  static video::FrameStore frames(long_clip(folder));
  frames.wait();
  const TemporaryFolder clicks;
  annotation::AnnotationJournal journal(clicks / "clip.keypoints.json", clicked(frames.info()));
  annotation::AnnotationOptions options;
  options.canvas_px = canvas_px;
  annotation::AnnotationSession session(journal, frames, options);
  session.set_prediction(tracked());
  int n = 0;
  for (auto _ : state) {
    if (other_frame) session.go_to(n % 2 == 0 ? 150 : 155);
    annotation::AnnotationEvent event;
    event.p_canvas = session.view().to_canvas({300.0 + n % 50, 300.0});
    ++n;
    annotation::AnnotationEvent digit;
    digit.kind = annotation::AnnotationEvent::Kind::key;
    digit.key = '1';
    session.handle(digit);
    for (const auto kind :
         {annotation::AnnotationEvent::Kind::press, annotation::AnnotationEvent::Kind::release}) {
      event.kind = kind;
      session.handle(event);
    }
    benchmark::DoNotOptimize(session.picture().data);
  }
  if (session.has_problem()) state.SkipWithError(session.message().c_str());
}
BENCHMARK_CAPTURE(click_to_picture, same_frame, cv::Size(1280, 860), false)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(click_to_picture, other_frame, cv::Size(1280, 860), true)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(click_to_picture, full_size, cv::Size(1920, 1280), true)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

}  // namespace
}  // namespace stride
