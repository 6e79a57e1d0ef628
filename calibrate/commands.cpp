#include "calibrate/commands.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "calibrate/calibrate.h"
#include "calibrate/fit/fit_options.h"
#include "calibrate/fitted.h"
#include "calibrate/report/report.h"
#include "calibrate/report/report_frames.h"
#include "extract/commands/direction_option.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/outputs.h"
#include "extract/skeleton/movement.h"
#include "extract/video/overlay.h"

namespace stride {
namespace {

namespace fs = std::filesystem;

struct CalibrateCommand {
  fs::path trajectory, out, fitted, video, overlay, model = osim::default_model_file();
  fit::RunnerSize size;
  std::optional<Facing> direction;
  std::string movement;
  bool force = false, no_picture = false, mot = false;
};

/// NAME of NAME.trajectory.csv or NAME.calibrated.csv, with its folder.
fs::path stem(const fs::path& table) {
  std::string name = table.filename().string();
  for (const char* ending : {".csv", ".trajectory", ".calibrated"})
    if (name.ends_with(ending)) name.resize(name.size() - std::string(ending).size());
  return table.parent_path() / name;
}

/// What is written: reports lie beside the run and have its name.
struct Files {
  fs::path run, text, picture, motion;
};
Files files_of(const CalibrateCommand& command) {
  const fs::path run = command.out.empty()
                           ? fs::path(stem(command.trajectory).string() + ".calibrated.csv")
                           : command.out;
  const std::string base = stem(run).string();
  return {run, base + ".report.txt", command.no_picture ? "" : base + ".report.svg",
          command.mot ? base + ".mot" : ""};
}

void check_files(const CalibrateCommand& command, const Trajectory& trajectory,
                 const Files& files) {
  const fs::path beside = command.trajectory.parent_path() / fs::path(trajectory.video).filename();
  check_outputs({command.trajectory, command.video, beside, command.model},
                {{"-o", files.run, FileKind::calibrated},
                 {"--fitted", command.fitted, FileKind::trajectory},
                 {"--overlay", command.overlay, FileKind::video},
                 {"-o", files.text, FileKind::report},
                 {"-o", files.picture, FileKind::svg},
                 {"--mot", files.motion, FileKind::motion}});
}

/// The video to draw on; empty if none is given and none is beside the trajectory.
fs::path video_of(const CalibrateCommand& command, const Trajectory& trajectory) {
  if (command.video.empty()) return report::video_in(command.trajectory.parent_path(), trajectory);
  require(fs::exists(command.video), "--video {}: no such file", command.video.string());
  require(sha256_of_file(command.video) == trajectory.video_sha256,
          "--video {}: is not the video that was tracked ({}); give that one, or none",
          command.video.string(), trajectory.video);
  return command.video;
}

void run(const CalibrateCommand& command) {
  const Files files = files_of(command);
  Trajectory trajectory = load_trajectory(command.trajectory);
  check_files(command, trajectory, files);
  if (command.direction) trajectory.direction = command.direction;
  if (!command.movement.empty())
    trajectory.movement = movement(command.movement, "--movement").name;
  const SagittalModel model = sagittal_model(osim::load_osim(command.model));
  const Calibration result = calibrate(trajectory, model, fit::fit_options(command.size));

  const std::string report = report::report_text(trajectory, model, result);
  write_file_atomically(files.text, report);
  fmt::print(stderr, "{}", report);
  if (result.ok() && !command.no_picture)
    report::draw_report(trajectory, model, result, video_of(command, trajectory), files.picture);
  if (result.ok() && !command.overlay.empty()) {
    const fs::path video = video_of(command, trajectory);
    require(!video.empty(),
            "--overlay {}: the video {} does not lie beside the trajectory; give it by --video",
            command.overlay.string(), trajectory.video);
    video::write_overlay(video, fitted_points(trajectory, model, result), command.overlay);
  }
  require(!result.verdict.refused || (command.force && result.ok()),
          "{}: {}\n(--force writes the fit nevertheless, where there is one)",
          command.trajectory.string(), result.verdict.text());
  save(result.run, files.run);
  if (!command.fitted.empty()) {
    save(fitted_px(trajectory, model, result), command.fitted);
    fmt::print("{}\n", command.fitted.string());
  }
  if (command.mot) report::save_mot(result.run, files.motion);
  fmt::print("{}\n", files.run.string());
}

}  // namespace

void add_calibrate_commands(CLI::App& app) {
  const auto command = std::make_shared<CalibrateCommand>();
  CLI::App* calibrate = app.add_subcommand(
      "calibrate", "fit a trajectory in pixels to the model's proportions: metres and angles");
  calibrate->add_option("trajectory", command->trajectory, "NAME.trajectory.csv")->required();
  calibrate->add_option("-o,--out", command->out, "default: NAME.calibrated.csv beside it");
  calibrate->add_option(
      "--video", command->video,
      "draw the keyframes on its frames (default: the one beside the trajectory)");
  calibrate->add_option("--overlay", command->overlay,
                        "the video with the fitted runner on every frame, .mp4");
  calibrate->add_option("--model", command->model, "OpenSim model (.osim)");
  calibrate->add_option("--height", command->size.height_m, "standing height of the runner, m");
  calibrate->add_option("--leg", command->size.leg_m, "the runner's hip to ankle, m");
  calibrate->add_option("--scale", command->size.metres_per_pixel,
                        "metres per pixel in the middle of the clip");
  add_direction_option(*calibrate, command->direction);
  calibrate->add_option(
      "--movement", command->movement,
      "run, walk, jump or another of movements.toml (default: as the trajectory says)");
  calibrate->add_option("--fitted", command->fitted,
                        "also write the fitted runner in the image, px: a trajectory for stride "
                        "track --prior");
  calibrate->add_flag("--mot", command->mot, "also write NAME.mot, the coordinates for OpenSim");
  calibrate->add_flag("--no-picture", command->no_picture, "do not draw NAME.report.svg");
  calibrate->add_flag("--force", command->force, "write the fit of a clip that was refused");
  calibrate->callback([command] { run(*command); });
}

}  // namespace stride
