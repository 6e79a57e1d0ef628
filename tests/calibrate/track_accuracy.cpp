// Accuracy of tracking against the truth of clips: the table of tests/bench/BENCHMARK.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "calibrate/fitted.h"
#include "extract/io/error.h"
#include "extract/tracking/track_score.h"

namespace stride {
namespace {

namespace fs = std::filesystem;

/// The truth beside a video: NAME.truth.csv or NAME_gt.csv.
fs::path truth_of(const fs::path& video) {
  for (const char* ending : {".truth.csv", "_gt.csv"})
    if (const fs::path file = video.parent_path() / (video.stem().string() + ending);
        fs::exists(file))
      return file;
  throw Error(fmt::format("{}: no NAME.truth.csv beside it", video.string()));
}

/// A row for each noise of the clicks: spline → tracked → tracked again with the fit as prior, px
/// rms.
void measure(const std::string& clip, tracking::ScoreOptions options, const SagittalModel& model) {
  const fs::path video = clip.find('/') == std::string::npos
                             ? fs::path(STRIDE_SOURCE_DIR "/videos") / (clip + ".mp4")
                             : fs::path(clip);
  options.predict = [&](const Trajectory& tracked) -> std::optional<Trajectory> {
    const Calibration result = calibrate(tracked, model);
    if (!result.fit.ok) return std::nullopt;
    return fitted_px(tracked, model, result);
  };
  double noise_px = -1;
  for (const tracking::TrackScore& s : tracking::score_tracking(video, truth_of(video), options)) {
    if (s.noise_px != noise_px)
      fmt::print("{}| {} | {} |", noise_px < 0 ? "" : "\n", video.stem().string(), s.noise_px);
    noise_px = s.noise_px;
    fmt::print(" {:.2f} → {:.2f} → {:.2f} |", s.spline_px, s.tracked_px, s.again_px);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

std::vector<tracking::TrackScore> scores_of(const std::string& clip,
                                            const tracking::ScoreOptions& options) {
  const fs::path video = fs::path(STRIDE_SOURCE_DIR "/videos") / (clip + ".mp4");
  return tracking::score_tracking(video, truth_of(video), options);
}

}  // namespace
}  // namespace stride

int main(int argc, char** argv) try {
  std::vector<std::string> clips{"human", "left", "game", "cartoon", "small", "walk"};
  stride::tracking::ScoreOptions options;
  CLI::App app("Measures tracking against the truth of rendered clips");
  app.add_option("clips", clips, "names in videos/, or video files with their truth beside them");
  app.add_option("--seeds", options.seeds, "how many sets of clicks each");
  app.add_option("--spacings", options.spacings, "frames between clicks");
  app.add_option("--noises", options.noises_px, "of the clicks, px");
  bool confidence = false;
  app.add_flag("--confidence", confidence,
               "instead: what share of the points of each confidence is right, over all clips");
  CLI11_PARSE(app, argc, argv);
  if (confidence) {
    std::vector<stride::tracking::TrackScore> all;
    for (const std::string& clip : clips) {
      const auto scores = stride::scores_of(clip, options);
      all.insert(all.end(), scores.begin(), scores.end());
    }
    fmt::print("{}", stride::tracking::confidence_table(all));
    return 0;
  }
  const auto model =
      stride::sagittal_model(stride::osim::load_osim(stride::osim::default_model_file()));
  std::string head = "| clip | noise, px |", rule = "|---|---|";
  for (const int spacing : options.spacings) {
    head += fmt::format(" every {} |", spacing);
    rule += "---|";
  }
  fmt::print("{}\n{}\n", head, rule);
  for (const std::string& clip : clips) stride::measure(clip, options, model);
} catch (const stride::Error& error) {
  fmt::print(stderr, "track_accuracy: {}\n", error.what());
  return 1;
}
