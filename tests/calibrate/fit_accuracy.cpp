// Accuracy of the fit against the truth of the rendered clips over many seeds: the tables of
// tests/bench/BENCHMARK.md. Not among the tests; a short version of it is (rendered_test.cpp).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "calibrate/fit/ground_slope.h"
#include "extract/annotation/labelled_clip.h"
#include "extract/io/error.h"
#include "tests/calibrate/rendered.h"
#include "tests/calibrate/zero_clicks.h"
#include "videos/truth.h"

namespace stride {
namespace {

struct Options {
  std::vector<std::string> clips{"human", "game", "cartoon"};
  std::string from = "clicks";
  std::vector<std::string> heels{"fitted"};
  unsigned seeds = 10, first = 1;
  bool vary = false, known_leg = false, camera_turns = false;
};

/// The shipped video, tracked from clicks with another noise seed.
Trajectory tracked(const videos::Clip& clip, unsigned seed) {
  const std::filesystem::path video =
      std::filesystem::path(STRIDE_SOURCE_DIR) / "videos" / (clip.name + ".mp4");
  videos::Clip clicked = clip;
  clicked.click_seed = seed;
  const Keypoints clicks = videos::clicks(clicked);
  return tracking::track(video, {tracking::marks_of(clicks), clicks.slow_motion}).trajectory;
}

/// Mean and largest magnitude of a number over all fits.
template <typename Number>
std::string spread(const std::vector<Accuracy>& all, double unit, Number number) {
  double sum = 0, greatest = 0;
  for (const Accuracy& a : all) {
    sum += number(a) / unit;
    greatest = std::max(greatest, std::abs(number(a) / unit));
  }
  return fmt::format("{:+6.2f} {:5.2f}", sum / static_cast<double>(all.size()), greatest);
}

template <typename Number>
double share_inside(const std::vector<Accuracy>& all, Number z) {
  const auto inside =
      std::ranges::count_if(all, [&](const Accuracy& a) { return std::abs(z(a)) < 1.96; });
  return 100.0 * static_cast<double>(inside) / static_cast<double>(all.size());
}

/// How the roll of the ground is known before cameras that tilt and zoom.
struct Rolls {
  int clips = 0, given = 0, given_inside = 0, hinted = 0, fits = 0, fits_inside = 0;
  double worst_given = 0, worst_fit = 0;  // in standard deviations

  void add(const videos::Clip& clip, const Trajectory& trajectory, const Calibration& found) {
    ++clips;
    const auto roll = fit::ground_roll(trajectory);
    if (roll) {
      const double z = std::abs(roll->mean - clip.camera.roll_rad) / roll->sd;
      ++given, given_inside += z < 1.96, worst_given = std::max(worst_given, z);
    }
    hinted += found.verdict.text().find("mark the floor") != std::string::npos;
    if (found.verdict.refused) return;
    const double z =
        std::abs(found.run.camera_roll_rad - clip.camera.roll_rad) / found.fit.roll_sd_rad();
    ++fits, fits_inside += z < 1.96, worst_fit = std::max(worst_fit, z);
  }
  std::string text() const {
    return fmt::format(
        "  roll of the background given in {} of {}, inside its 95 % in {}, worst {:.1f} sd; floor "
        "asked for in {}; of the fit inside in {} of {}, worst {:.1f} sd\n",
        given, clips, given_inside, worst_given, hinted, fits_inside, fits, worst_fit);
  }
};

void measure(const Options& options, const std::string& name, const SagittalModel& model) {
  std::vector<Accuracy> all;
  std::string refused;
  Rolls rolls;
  unsigned worst = 0;
  double worst_m = 0;
  for (unsigned seed = options.first; seed < options.first + options.seeds; ++seed) {
    videos::Clip clip = videos::clip(name);
    if (options.from != "video") clip.seed = 1000 + seed;
    if (options.vary) clip = varied(clip, seed);
    if (options.camera_turns) clip = turned_camera(clip, seed);
    const Trajectory trajectory =
        options.from == "video"
            ? tracked(clip, seed)
            : observed(clip, {options.from == "frames", clip.click_sd_px, seed});
    fit::FitOptions fit;
    if (options.known_leg) fit.leg_m = known_leg(clip, seed);
    const Calibration found = calibrate(trajectory, model, fit);
    if (options.camera_turns) rolls.add(clip, trajectory, found);
    if (found.verdict.refused)
      refused += fmt::format("  seed {}: {}\n", seed, found.verdict.text());
    else
      all.push_back(accuracy(found, clip, model));
    if (!found.verdict.refused && all.back().worst_rms_m() > worst_m)
      worst_m = all.back().worst_rms_m(), worst = seed;
  }
  if (!all.empty()) {
    int inside = 0, coordinates = 0;
    for (const Accuracy& a : all) inside += a.inside, coordinates += a.coordinates;
    fmt::print("{:<10} {:4}  {}  {}  {}  {}  {}  {:7.1f} {:8.1f} {:7.1f}  {:5}\n", name, all.size(),
               spread(all, 0.01, [](const Accuracy& a) { return a.period; }),
               spread(all, 0.01, [](const Accuracy& a) { return a.scale; }),
               spread(all, 0.01, [](const Accuracy& a) { return a.speed; }),
               spread(all, M_PI / 180, [](const Accuracy& a) { return a.roll_rad; }),
               spread(all, 0.01, [](const Accuracy& a) { return a.worst_rms_m(); }),
               100.0 * inside / coordinates,
               share_inside(all, [](const Accuracy& a) { return a.period_z; }),
               share_inside(all, [](const Accuracy& a) { return a.scale_z; }), worst);
  }
  fmt::print("{}{}", refused, options.camera_turns ? rolls.text() : "");
  std::fflush(stdout);
}

}  // namespace
}  // namespace stride

int main(int argc, char** argv) try {
  stride::Options options;
  CLI::App app("Measures the fit against the truth of rendered clips");
  app.add_option("clips", options.clips, "clips of videos/")->capture_default_str();
  app.add_option("--from", options.from,
                 "clicks: eight frames a stride; frames: every frame, as noisy; video: the shipped "
                 "video tracked from other clicks; network: from none; corrections: from up to ten "
                 "on the network's points (both once, "
                 "as a Markdown table)")
      ->check(CLI::IsMember({"clicks", "frames", "video", "network", "corrections"}));
  app.add_option(
         "--heels", options.heels,
         "of a network: fitted, tracked without a say in the fit, or dropped; several for a "
         "row each")
      ->check(CLI::IsMember({"fitted", "tracked", "dropped"}))
      ->capture_default_str();
  app.add_option("--seeds", options.seeds, "how many of each clip");
  app.add_option("--first", options.first, "the first seed");
  app.add_flag("--vary", options.vary, "other proportions, cameras and cadences, too");
  app.add_flag("--camera-turns", options.camera_turns, "the camera tilts, zooms, or both");
  app.add_flag("--known-leg", options.known_leg, "the leg's length is given, to 2 %");
  CLI11_PARSE(app, argc, argv);
  const auto model =
      stride::sagittal_model(stride::osim::load_osim(stride::osim::default_model_file()));
  if (options.from == "network" || options.from == "corrections") {
    const bool corrected = options.from == "corrections";
    fmt::print("{}", corrected ? stride::correction_head() : stride::ZeroClicks::table_head());
    for (const std::string& name : options.clips) {
      const stride::videos::Clip clip = stride::videos::clip(name);
      if (corrected) {
        fmt::print("{}", stride::correction_row(clip, model));
      } else {
        const stride::pose::NetworkPoints seen = stride::seen_by_network(clip);
        for (const std::string& heels : options.heels)
          fmt::print("{}",
                     stride::without_clicks(clip, model, seen, *stride::kSeenHeels.find(heels))
                         .row(clip, model));
      }
      std::fflush(stdout);
    }
    return 0;
  }
  fmt::print(
      "clip       fits  period, %     scale, %      speed, %      roll, deg     worst rms, cm "
      "inside: coords, period, scale  worst seed\n"
      "                 mean   most   mean   most   mean   most   mean   most   mean   most\n");
  for (const std::string& clip : options.clips) stride::measure(options, clip, model);
} catch (const stride::Error& error) {
  fmt::print(stderr, "fit_accuracy: {}\n", error.what());
  return 1;
}
