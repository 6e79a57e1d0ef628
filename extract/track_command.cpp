#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include "extract/annotation/labelled_clip.h"
#include "extract/annotation/points_of_video.h"
#include "extract/annotation/points_on_video.h"
#include "extract/commands.h"
#include "extract/commands/detection_options.h"
#include "extract/import/export.h"
#include "extract/io/error.h"
#include "extract/io/option_range.h"
#include "extract/io/outputs.h"
#include "extract/pose/pose_points.h"
#include "extract/skeleton/movement.h"
#include "extract/tracking/time_check.h"
#include "extract/tracking/track_score.h"
#include "extract/video/overlay.h"
#include "extract/video/video.h"

namespace stride {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kFewestFrames = 8;

struct TrackRequest {
  fs::path video, keypoints, import_from, export_to, out, overlay, prior, score;
  std::string movement;               // empty: as the keypoints say
  std::optional<double> slow_motion;  // else as the keypoints say
  bool repair_legs = true;
  tracking::TrackOptions track;
  imports::ImportOptions import;
  pose::PoseOptions pose;
};

/// A line on stderr that is rewritten where somebody watches.
void show_progress(int frame, int last) {
  constexpr int kSeldom = 1000;  // where nobody watches
  if (::isatty(STDERR_FILENO))
    fmt::print(stderr, "\rframe {} of {}{}", frame, last, frame == last ? "\n" : "");
  else if (frame > 0 && frame % kSeldom == 0)
    fmt::print(stderr, "frame {} of {}\n", frame, last);
}

/// The same for the network, with the time that it still needs.
struct NetworkProgress {
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();

  void operator()(int done, int of) const {
    if (!::isatty(STDERR_FILENO)) return;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    fmt::print(stderr, "\rthe pose network: frame {} of {}, about {:.0f} s left {}", done, of,
               spent.count() * (of - done) / done, done == of ? "\n" : "");
  }
};

bool is_detected(const TrackRequest& request) {
  return !request.import_from.empty() || request.pose.is_users();
}

/// Who else is in the file.
std::string others(const imports::Detections& detections) {
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(detections.people.size(), 4); ++i) {
    if (static_cast<int>(i) + 1 == detections.person) continue;
    const imports::ImportedPerson& person = detections.people[i];
    text +=
        fmt::format("{} --person {} ({} frames from {} to {})", text.empty() ? "; others:" : ",",
                    i + 1, person.frames, person.first_frame, person.last_frame);
  }
  return text;
}

/// The points of another program or a pose network on the frames of the video.
tracking::LabelledClip detected(const TrackRequest& request) {
  require(request.import_from.empty() || !request.pose.wanted,
          "--import {} and --pose {}: give one of them", request.import_from.string(),
          request.pose.model.string());
  imports::ImportOptions options = request.import;
  if (options.rate_hz == 0) options.rate_hz = video::Video(request.video).info().rate_hz;
  const imports::Detections detections =
      request.pose.model.empty() ? imports::import_points(request.import_from, options)
                                 : pose::pose_points(request.video, request.pose, options);
  fmt::print(stderr, "{}: {} frames of {}, person {} of {}{}\n",
             (request.pose.model.empty() ? request.import_from : request.pose.model).string(),
             detections.frames.size(), detections.format, detections.person,
             detections.people.size(), others(detections));
  tracking::LabelledClip labelled = tracking::points_on(
      request.video, detections, {request.slow_motion.value_or(1), request.repair_legs, options});
  labelled.points = "import";
  return labelled;
}

/// Clicks or, where there are none, the points of the pose network.
tracking::LabelledClip clicked_or_seen(const TrackRequest& request) {
  tracking::PointsOptions options;
  options.keypoints = request.keypoints;
  options.slow_motion = request.slow_motion.value_or(0);
  options.network = request.pose.wanted;
  options.landmarks = request.pose.model;
  options.person = request.import.person;
  options.repair_legs = request.repair_legs;
  options.progress = NetworkProgress();
  const bool clicked = !tracking::is_seen_by_network(request.video, options);
  require(!clicked || options.person == 0,
          "--person {}: has no effect on clicks, which say who runs; with --pose they correct what "
          "the network sees of that person",
          options.person);
  require(!clicked || options.repair_legs || !request.movement.empty(),
          "--no-leg-repair: has no effect on clicks, whose legs are as they were clicked");
  return tracking::points_of_video(request.video, options);
}

void report(const tracking::Tracked& tracked) {
  const gaussian_process::GaitKernel& legs = tracked.summary.prior.legs;
  const Trajectory& t = tracked.trajectory;
  fmt::print(stderr,
             "{} marked frames, frames {}–{} tracked\n"
             "stride {}, noise of the marks {:.1f} px, flow inliers on {:.0f} % of the unmarked "
             "points\n",
             tracked.summary.labelled_frames, t.frames.front().frame, t.frames.back().frame,
             tracked.summary.labelled_frames < static_cast<int>(kFewestFrames) ? "period not known"
             : !legs.periodic ? "none, as a movement that does not repeat has"
                              : fmt::format("period {:.3f} s", legs.period_s),
             legs.noise_px, 100 * tracked.summary.inlier);
  if (const std::string doubt = tracking::doubt_of_period(legs.period_s);
      legs.periodic && !doubt.empty())
    fmt::print(stderr, "warning: {}\n", doubt);
  std::vector<double> residuals;
  for (const TrajectoryFrame& frame : t.frames)
    if (frame.camera_px.allFinite()) residuals.push_back(frame.camera_residual_px);
  std::ranges::sort(residuals);
  if (residuals.empty())
    fmt::print(stderr, "the background could not be followed\n");
  else
    fmt::print(stderr, "background followed on {} of {} frames, corners agree within {:.2f} px{}\n",
               residuals.size(), t.frames.size(), residuals[residuals.size() / 2],
               t.treadmill.value_or(false) ? "; the runner stays in place: a treadmill" : "");
  if (const std::string& shortfall = tracked.summary.shortfall; !shortfall.empty())
    fmt::print(stderr, "warning: {}\n", shortfall);
}

/// What `--export` writes.
FileKind exported_kind(const fs::path& file) {
  const std::string extension = file.extension().string();
  if (extension == ".csv") return FileKind::points_csv;
  if (extension == ".json") return FileKind::points_json;
  return extension == ".trc" ? FileKind::trc : FileKind::missing;
}

fs::path trajectory_file(const TrackRequest& request) {
  if (!request.out.empty() || !request.export_to.empty()) return request.out;
  return fs::path(request.video).replace_extension(".trajectory.csv");
}

void check_files(const TrackRequest& request) {
  if (!request.export_to.empty()) imports::check_export(request.export_to);
  check_outputs({request.video, request.keypoints, keypoints_file_of(request.video),
                 request.import_from, request.prior, request.score, request.pose.model},
                {{"-o", trajectory_file(request), FileKind::trajectory},
                 {"--overlay", request.overlay, FileKind::video},
                 {"--export", request.export_to, exported_kind(request.export_to)}});
}

void run(TrackRequest request) {
  if (!request.score.empty()) {
    fmt::print("{}", tracking::table_of(tracking::score_tracking(request.video, request.score)));
    return;
  }
  check_files(request);
  if (!request.movement.empty() && !movement(request.movement, "--movement").repeats)
    request.repair_legs = false;  // which looks for legs in turn
  tracking::LabelledClip labelled =
      is_detected(request) ? detected(request) : clicked_or_seen(request);
  if (!request.movement.empty())
    labelled.marks.movement = movement(request.movement, "--movement").name;
  const std::size_t frames = labelled.marks.frames.size();
  require(frames != 1, "one frame is marked: that tells no motion; mark {} or more", kFewestFrames);
  if (frames < kFewestFrames)
    fmt::print(stderr,
               "warning: {} frames are marked: too short for a stride, {} or more tell one\n",
               frames, kFewestFrames);
  std::optional<Trajectory> prior;
  if (!request.prior.empty()) prior = load_trajectory(request.prior);
  request.track.prior = prior ? &*prior : nullptr;
  video::DecodeOptions watching;
  watching.progress = show_progress;
  watching.crops = request.track.flow;
  tracking::warn_of_header(request.video, labelled.slow_motion);
  const tracking::Tracked tracked =
      tracking::track(request.video, labelled, request.track, watching);
  report(tracked);

  if (!request.overlay.empty()) {
    video::write_overlay(request.video, tracked.trajectory, request.overlay);
    fmt::print("{}\n", request.overlay.string());
  }
  if (!request.export_to.empty()) {
    imports::export_points(tracked.trajectory, request.export_to);
    fmt::print("{}\n", request.export_to.string());
  }
  const fs::path out = trajectory_file(request);
  if (out.empty()) return;
  save(tracked.trajectory, out);
  fmt::print("{}\n", out.string());
}

}  // namespace

void add_track_command(CLI::App& app) {
  const auto request = std::make_shared<TrackRequest>();
  CLI::App& command = *app.add_subcommand(
      "track", "propagate clicks, or a pose network's points, through every frame of a video");
  command.add_option("VIDEO", request->video, "the video")->required();
  command.add_option("--keypoints", request->keypoints,
                     "clicks (default: NAME.keypoints.json beside the video; without it the pose "
                     "network finds the joints)");
  command.add_option("--import", request->import_from,
                     "points of another program instead of clicks: a file or a folder");
  add_detection_options(command, request->import, request->pose, request->repair_legs);
  command.add_option("-o,--out", request->out,
                     "trajectory to write (default: NAME.trajectory.csv beside the video, unless "
                     "--export says otherwise)");
  command.add_option("--export", request->export_to,
                     "write for other programs: .csv, .json, .trc, or a folder of OpenPose's");
  command.add_option("--overlay", request->overlay, "draw the points on the video: an .mp4");
  command.add_option("--prior", request->prior,
                     "a trajectory in pixels that predicts the motion, as of a fitted body model");
  command
      .add_option("--slow-motion", request->slow_motion,
                  "seconds of video a second of the runner (default: as the clicks say)")
      ->check(in_range(0.05, 100));
  command.add_option(
      "--movement", request->movement,
      "run, walk, jump or another of movements.toml (default: as the clicks say, or run)");
  command.add_flag("--keep-marks", request->track.keep_marks,
                   "go exactly through every click instead of averaging their noise out");
  command.add_flag("!--no-flow", request->track.flow, "do not look at the picture between clicks");
  command.add_option("--score", request->score,
                     "a CSV of true points: track from clicks made of it, print the accuracy");
  command.callback([request, &command] {
    require_effect(command, request->import_from, request->pose);
    for (const CLI::Option* option : command.get_options())
      require(request->score.empty() || option->count() == 0 || !option->nonpositional() ||
                  option->check_name("--score"),
              "{}: has no effect with --score, which prints the accuracy of clicks",
              option->get_name());
    require(request->import_from.empty() || request->keypoints.empty(),
            "--import {} and --keypoints {}: give one of them", request->import_from.string(),
            request->keypoints.string());
    run(*request);
  });
}

}  // namespace stride
