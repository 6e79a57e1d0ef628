#include "train/film/evaluation_film.h"

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "calibrate/runner/calibrated.h"
#include "extract/io/data_file.h"
#include "extract/io/error.h"
#include "extract/video/video_writer.h"
#include "train/film/film.h"

namespace stride::film {
namespace fs = std::filesystem;
namespace {

constexpr int kStepsPerFrame = 2;

/// `NAME.calibrated.csv` or `NAME.trajectory.csv` of a video, in the first folder that has it.
fs::path sibling(const fs::path& video, const fs::path& other, const char* extension) {
  for (const fs::path& folder : {video.parent_path(), other}) {
    fs::path file = folder / (video.stem().string() + extension);
    if (fs::exists(file)) return file;
  }
  return {};
}

}  // namespace

std::optional<SourceStride> find_source(const Potential& potential, const fs::path& near) {
  std::vector<fs::path> folders{near, near.parent_path()};
  for (const fs::path& folder : data_folders()) folders.push_back(folder / "videos");
  for (const fs::path& folder : folders) {
    const fs::path video = folder / fs::path(potential.source).filename();
    if (potential.source.empty() || !fs::exists(video)) continue;
    const fs::path calibrated = sibling(video, near, ".calibrated.csv");
    if (calibrated.empty()) continue;
    const CalibratedTrajectory run = load_calibrated(calibrated);
    const fs::path points = sibling(video, near, ".trajectory.csv");
    const std::optional<Trajectory> trajectory =
        points.empty() ? std::nullopt : std::optional(load_trajectory(points));
    if (!potential.repeats) {
      SourceStride source =
          read_source_stride(video, run.samples.front().time_s, potential.period_s, 1,
                             trajectory ? &*trajectory : nullptr);
      source.repeats = false;
      return source;
    }
    for (std::size_t i = 1; i < run.samples.size(); ++i)
      if (run.samples[i].phase < run.samples[i - 1].phase)
        return read_source_stride(video, run.samples[i].time_s, potential.period_s, 1,
                                  trajectory ? &*trajectory : nullptr);
  }
  return std::nullopt;
}

void write_film(const rollout::Rollout& rollout, const osim::Model& model, const std::string& title,
                const std::optional<SourceStride>& source, const fs::path& file) {
  const auto& frames = rollout.frames;
  require(frames.size() > kStepsPerFrame, "{}: the episode is too short to be filmed",
          file.string());
  const double step_s = frames[1].state.time_s - frames[0].state.time_s;
  const FilmModel film = film_model(model);
  const FilmOptions options{.title = title};
  video::VideoWriter writer(file, 1 / (kStepsPerFrame * step_s));
  const std::size_t still = frames.size() / 2 / kStepsPerFrame * kStepsPerFrame;
  for (std::size_t i = 0; i < frames.size(); i += kStepsPerFrame) {
    const cv::Mat runner =
        film_frame(film, {frames[i].state, frames[i].kinematics, rollout.obstacles}, options);
    const cv::Mat frame = source ? side_by_side(source->at(frames[i].phase), runner) : runner;
    writer.write(frame);
    if (i == still) cv::imwrite(fs::path(file).replace_extension(".jpg").string(), frame);
  }
  writer.finish();
}

}  // namespace stride::film
