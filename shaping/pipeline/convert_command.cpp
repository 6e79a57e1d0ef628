#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <memory>

#include "extract/annotation/points_of_video.h"
#include "extract/commands/direction_option.h"
#include "extract/io/error.h"
#include "extract/io/option_range.h"
#include "extract/parallel/ranks.h"
#include "extract/skeleton/movement.h"
#include "shaping/commands.h"
#include "shaping/pipeline/convert.h"

namespace stride {
namespace {

struct ConvertCommand {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path config;
  pipeline::ConvertOptions options;
  std::string function = "pf3", index = "time";
  bool no_pictures = false, asymmetric = false;
};

/// Throws Error if an option was given that none of the inputs heeds.
void require_effect(const CLI::App& command, const std::vector<std::filesystem::path>& inputs,
                    const pipeline::ConvertOptions& options) {
  const auto require_any = [&](std::initializer_list<const char*> names, const auto& heeds,
                               const char* who) {
    for (const char* name : names)
      require(command.count(name) == 0 || std::ranges::any_of(inputs, heeds),
              "{}: has no effect on {}: it is for {}", name,
              inputs.size() == 1 ? inputs[0].string() : "any of the inputs", who);
  };
  require_any({"--height", "--leg", "--scale", "--direction", "--movement"},
              std::not_fn(pipeline::is_calibrated), "videos and trajectories");
  require_any({"--slow-motion", "--loop", "--pose", "--overlay"}, pipeline::is_video, "videos");
  tracking::PointsOptions points;
  points.network = options.network;
  require_any(
      {"--person"},
      [&](const std::filesystem::path& input) {
        return pipeline::is_video(input) && tracking::is_seen_by_network(input, points);
      },
      "videos that the pose network sees: without clicks, or with --pose");
}

void run(const CLI::App& app, ConvertCommand command) {
  pipeline::ConvertOptions& options = command.options;
  KeyframeOptions& keyframes = options.clip.keyframes;
  keyframes.function = inverse_distance(command.function);
  keyframes.index = potential_index(command.index);
  keyframes.symmetric = !command.asymmetric;
  options.pictures = !command.no_pictures;
  if (!options.clip.movement.empty())
    options.clip.movement = movement(options.clip.movement, "--movement").name;
  if (!command.config.empty()) pipeline::load_convert_config(command.config, options);
  options.progress = [](const std::string& line) { fmt::print(stderr, "{}\n", line); };

  const auto inputs = pipeline::expand_inputs(command.inputs, options.progress);
  require_effect(app, inputs, options);
  for (const auto& [name, settings] : options.by_clip)
    if (std::ranges::find(inputs, name, pipeline::clip_name) == inputs.end())
      options.progress(fmt::format("not used: {}: [clip.{}]: no input has that name",
                                   command.config.string(), name));
  parallel::Ranks& ranks = parallel::Ranks::world();
  if (ranks.size() > 1) {
    // Each rank converts its share; then the first one finds it done, and tells of all.
    std::vector<std::filesystem::path> share;
    for (std::size_t i = 0; i < inputs.size(); ++i)
      if (ranks.owns(static_cast<int>(i))) share.push_back(inputs[i]);
    pipeline::convert(share, options);
    ranks.wait_for_all();
    if (!ranks.first()) return;
    options.again = false;
    options.progress = nullptr;
  }
  const std::vector<pipeline::Converted> results = pipeline::convert(inputs, options);
  fmt::print("{}", pipeline::table_of(results));
  const auto failures = std::ranges::count_if(results, &pipeline::Converted::failed);
  require(failures == 0, "{} of {} clips were not converted, see the table", failures,
          results.size());
  fmt::print("{}\n", results.size() == 1
                         ? (options.out / (results[0].name + ".potential.json")).string()
                         : options.out.string());
}

}  // namespace

void add_convert_command(CLI::App& app) {
  const auto command = std::make_shared<ConvertCommand>();
  CLI::App* convert = app.add_subcommand(
      "convert", "the left half of the pipeline: videos with their clicks become potential files");
  pipeline::ConvertOptions& options = command->options;
  pipeline::ClipOptions& clip = options.clip;
  convert
      ->add_option("inputs", command->inputs,
                   "videos (NAME.keypoints.json beside them, or the pose network finds the "
                   "joints), NAME.trajectory.csv, "
                   "NAME.calibrated.csv, or folders of videos")
      ->required();
  convert->add_option("-o,--out", options.out, "folder for the results")->required();
  convert->add_option("--settings", command->config,
                      "TOML file: options of all clips, and of one under [clip.NAME]");
  convert->add_option("--model", options.model, "OpenSim model (.osim)");
  convert->add_option("--height", clip.size.height_m, "standing height of the runner, m");
  convert->add_option("--leg", clip.size.leg_m, "the runner's hip to ankle, m");
  convert->add_option("--scale", clip.size.metres_per_pixel, "metres per pixel");
  convert->add_option("--slow-motion", clip.slow_motion, "seconds of video a second of the runner")
      ->check(in_range(0.05, 100));
  convert
      ->add_option("--loop", options.loop,
                   "each video is a loop, as a GIF of one stride or step: as if it played so many "
                   "times; click NAME.loop.mp4 in the folder of results")
      ->check(in_range(2, 100));
  add_direction_option(*convert, clip.direction);
  convert->add_option(
      "--movement", clip.movement,
      "run, walk, jump or another of movements.toml (default: as the clicks say, or run)");
  convert->add_option("--keyframes", clip.keyframes.count, "of a stride, even")
      ->check(in_range(2, 200));
  convert->add_option("--foot", clip.keyframes.foot, "ankle or toe: the foot of the potential")
      ->check(CLI::IsMember({"ankle", "toe"}));
  convert->add_option("--function", command->function,
                      "inverse distance: " + kInverseDistances.list());
  convert->add_option("--index", command->index, "keyframe by time, or nearest");
  convert->add_option("--epsilon", clip.keyframes.epsilon_m, "of the inverse distance, m")
      ->check(in_range(1e-6, 10));
  convert->add_option("--weight", clip.keyframes.weight, "of the potential")
      ->check(in_range(1e-9, 1e9));
  convert->add_flag("--keep-asymmetry", command->asymmetric,
                    "do not make the legs mirror images of one another");
  convert
      ->add_option_function<std::string>(
          "--pose",
          [&options](const std::string& landmarks) {
            options.network = true;
            if (!landmarks.empty() && landmarks != "true") options.landmarks = landmarks;
          },
          "the pose network also for videos with clicks, which then correct it; MODEL.tflite: "
          "another one than the installed")
      ->expected(0, 1);
  convert
      ->add_option(
          "--person", options.person,
          "whom the pose network follows: 1 who moves in strides for longest, 2 the next, …")
      ->check(in_range(1, 1000));
  convert->add_option("--threads", options.threads, "clips at a time (default: processors)")
      ->check(in_range(1, 1024));
  convert->add_flag("--overlay", options.overlay,
                    "also write NAME.overlay.mp4, the tracked points on every frame");
  convert->add_flag("--no-pictures", command->no_pictures, "do not draw NAME.report.svg");
  convert->add_flag("--again", options.again, "convert also what has not changed");
  convert->add_flag("--force", clip.force, "convert clips that were refused, where there is a fit");
  convert->callback([command, convert] { run(*convert, *command); });
}

}  // namespace stride
