#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <opencv2/highgui.hpp>
#include <optional>

#include "extract/annotation/labelled_clip.h"
#include "extract/annotation/points_of_video.h"
#include "extract/annotation/points_on_video.h"
#include "extract/annotation/qt_events.h"
#include "extract/annotation/session/background_tracker.h"
#include "extract/annotation/session/predict.h"
#include "extract/annotation/session/script.h"
#include "extract/commands.h"
#include "extract/commands/detection_options.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/pose/pose_points.h"
#include "extract/skeleton/movement.h"

namespace stride {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;

struct AnnotateRequest {
  fs::path video, keypoints, script, import_from;
  std::string movement;  // empty: as the clicks say, or run
  std::vector<int> window{1280, 860};
  annotation::AnnotationOptions session;
  imports::ImportOptions import;
  pose::PoseOptions pose;
  bool repair_legs = true, keys = false;
};

/// Qt aborts the program if it cannot open a display, so a child process tries first.
void require_display() {
  const auto is_set = [](const char* name) { return std::getenv(name) && *std::getenv(name); };
  constexpr const char* kCure =
      "annotate on a desktop, or drive the same session without a window by --script FILE";
  require(is_set("DISPLAY") || is_set("WAYLAND_DISPLAY") || is_set("QT_QPA_PLATFORM"),
          "no display: neither DISPLAY nor WAYLAND_DISPLAY is set; {}", kCure);
  const pid_t child = ::fork();
  if (child == 0) {
    if (!std::freopen("/dev/null", "w", stderr)) ::_exit(1);
    cv::namedWindow("probe", cv::WINDOW_AUTOSIZE | cv::WINDOW_GUI_NORMAL);
    ::_exit(0);
  }
  int status = 1;
  ::waitpid(child, &status, 0);
  require(WIFEXITED(status) && WEXITSTATUS(status) == 0, "no display: '{}' cannot be reached; {}",
          is_set("DISPLAY") ? std::getenv("DISPLAY") : "the Wayland or Qt platform", kCure);
}

Keypoints fresh_keypoints(const fs::path& video, const video::VideoInfo& info) {
  Keypoints keypoints;
  keypoints.video = video.filename().string();
  keypoints.video_sha256 = sha256_of_file(video);
  keypoints.width_px = info.width_px;
  keypoints.height_px = info.height_px;
  return keypoints;
}

/// The network's points, which the clicks will correct. The document says so from now on.
tracking::LabelledClip points_to_correct(const AnnotateRequest& request, video::FrameStore& frames,
                                         annotation::AnnotationJournal& journal) {
  tracking::PointsOptions options;
  options.landmarks = request.pose.model;
  options.person = request.import.person;
  options.repair_legs = request.repair_legs;
  options.slow_motion = journal.document().keypoints().slow_motion;
  frames.wait();
  fmt::print(stderr, "{}: the pose network looks at {} frames; a moment\n", request.video.string(),
             frames.count());
  tracking::LabelledClip network = tracking::points_of_network(request.video, options);
  annotation::ClipSettings settings = annotation::settings_of(journal.document().keypoints());
  if (!settings.direction) settings.direction = network.marks.direction;
  if (!settings.near_leg && settings.direction)
    settings.near_leg = settings.direction == Facing::left ? Side::left : Side::right;
  if (!settings.corrects_network)
    require(
        journal.document().keypoints().frames.empty(),
        "{}: was clicked without the network: 'stride track --pose' corrects it by these clicks; "
        "move the file away to begin from the network's points",
        journal.file().string());
  const bool is_new = !settings.corrects_network;
  settings.corrects_network = true;
  if (is_new) journal.apply({"points of the pose network, to be corrected", {}, settings});
  return network;
}

/// Adds the points of another program or a user's network as clicks where there are none, as one
/// undoable edit.
void import_clicks(const AnnotateRequest& request, video::FrameStore& frames,
                   annotation::AnnotationJournal& journal) {
  const bool by_model = request.pose.wanted;
  const fs::path& from = by_model ? request.pose.model : request.import_from;
  require(!by_model || request.import_from.empty(), "--import {} and --pose {}: give one of them",
          request.import_from.string(), from.string());
  imports::ImportOptions options = request.import;
  if (options.rate_hz == 0) options.rate_hz = frames.info().rate_hz;
  const imports::Detections detections =
      by_model ? pose::pose_points(request.video, request.pose, options)
               : imports::import_points(from, options);
  frames.wait();
  const tracking::LabelledClip labelled =
      tracking::points_on(request.video, detections, {1, request.repair_legs, request.import});
  annotation::Change change{
      fmt::format("points of {}", from.empty() ? "the pose network" : from.filename().string()),
      {},
      {}};
  for (const TrajectoryFrame& imported : labelled.marks.frames) {
    const int number = imported.frame;
    if (number >= frames.count() || journal.document().keypoints().frames.contains(number))
      continue;
    for (const BodyPart part : kBodyParts) {
      const Point& point = imported[part];
      const bool inside = point.present() && point.p_px.x() >= -0.5 && point.p_px.y() >= -0.5 &&
                          point.p_px.x() <= frames.info().width_px - 0.5 &&
                          point.p_px.y() <= frames.info().height_px - 0.5;
      if (inside)
        change.clicks.push_back(
            {number, frames.video_time_s(number), part,
             Click{point.p_px, point.confidence >= 0.5 ? ClickState::seen : ClickState::estimated,
                   ""}});
    }
  }
  fmt::print(stderr, "{}: {} points of {} frames taken as clicks\n", from.string(),
             change.clicks.size(), detections.frames.size());
  if (!change.clicks.empty()) journal.apply(std::move(change));
}

/// Passed from the mouse callback to the loop below.
struct Window {
  annotation::AnnotationSession& session;
  Eigen::Vector2d mouse = {0, 0};  // where it was last, px of the canvas
  bool changed = true;
};

void on_mouse(int type, int x, int y, int /*flags*/, void* data) {
  auto& window = *static_cast<Window*>(data);
  using Kind = annotation::AnnotationEvent::Kind;
  using Button = annotation::AnnotationEvent::Button;
  annotation::AnnotationEvent event;
  event.p_canvas = window.mouse = {static_cast<double>(x), static_cast<double>(y)};
  switch (type) {
    case cv::EVENT_LBUTTONDOWN:
    case cv::EVENT_RBUTTONDOWN:
    case cv::EVENT_MBUTTONDOWN:
    case cv::EVENT_LBUTTONDBLCLK:  // instead of the second press of a fast pair of clicks
    case cv::EVENT_RBUTTONDBLCLK:
      event.kind = Kind::press;
      break;
    case cv::EVENT_LBUTTONUP:
    case cv::EVENT_RBUTTONUP:
    case cv::EVENT_MBUTTONUP:
      event.kind = Kind::release;
      break;
    case cv::EVENT_MOUSEMOVE:
      event.kind = Kind::move;
      break;
    default:
      return;
  }
  if (type == cv::EVENT_RBUTTONDOWN || type == cv::EVENT_RBUTTONUP ||
      type == cv::EVENT_RBUTTONDBLCLK)
    event.button = Button::right;
  if (type == cv::EVENT_MBUTTONDOWN || type == cv::EVENT_MBUTTONUP) event.button = Button::middle;
  window.session.handle(event);
  window.changed = true;
}

void run_window(annotation::AnnotationSession& session, annotation::BackgroundTracker& tracker,
                video::FrameStore& frames, cv::Size size_px) {
  constexpr auto kRest = std::chrono::milliseconds(300);
  const std::string title = "stride annotate: " + session.keypoints().video;
  cv::namedWindow(title, cv::WINDOW_NORMAL | cv::WINDOW_FREERATIO | cv::WINDOW_GUI_NORMAL);
  cv::resizeWindow(title, size_px);
  Window window{session};
  cv::setMouseCallback(title, on_mouse, &window);
  const auto handle = [&](const annotation::AnnotationEvent& event) {
    session.handle(event);
    window.changed = true;
  };
  using Kind = annotation::AnnotationEvent::Kind;
  const annotation::QtEvents events(
      [&](int turn) { handle({.kind = Kind::wheel, .p_canvas = window.mouse, .wheel = turn}); },
      [&] { handle({.kind = Kind::key, .key = annotation::key::kTab}); });
  int decoded = -1;
  auto last_event = Clock::now(), last_frame = last_event;
  const auto frame_time = std::chrono::duration<double>(session.frame_s());
  while (!session.done()) {
    tracker.submit(session.keypoints(), session.revision());
    if (auto prediction = tracker.poll()) {
      session.set_prediction(std::move(*prediction));
      window.changed = true;
    }
    if (!frames.complete() || decoded != frames.count()) window.changed = true;
    decoded = frames.count();
    if (window.changed) {
      cv::imshow(title, session.picture());
      window.changed = false;
      last_event = Clock::now();
    }
    const cv::Rect shown =
        cv::getWindowImageRect(title);  // resized, maximised, or cut to the screen
    if (shown.width > 1 && shown.height > 1 && shown.size() != size_px) {
      size_px = shown.size();
      session.resize(size_px);
      window.changed = true;
    }
    if (session.playing() && Clock::now() - last_frame >= frame_time) {
      last_frame = Clock::now();
      session.show_next();
      window.changed = true;
    }
    const int key = cv::waitKeyEx(session.playing() ? 2 : 15);
    if (key >= 0) {
      handle({.kind = Kind::key, .key = key});
    } else if (Clock::now() - last_event > kRest && session.rest()) {
      window.changed = true;
    }
    if (cv::getWindowProperty(title, cv::WND_PROP_VISIBLE) < 1) break;
  }
  session.rest();
  cv::destroyAllWindows();
}

void run(AnnotateRequest request) {
  if (request.keys) {
    fmt::print("| keys | |\n|---|---|\n");
    for (const annotation::KeyHelp& help : annotation::key_help())
      fmt::print("| {} | {} |\n", help.keys, help.does);
    return;
  }
  require(!request.video.empty(), "VIDEO is missing: give the video to annotate");
  ::setenv("QT_LOGGING_RULES", "default.warning=false", /*overwrite=*/0);  // of XDG_RUNTIME_DIR
  if (request.script.empty()) require_display();
  request.session.canvas_px = {request.window[0], request.window[1]};
  require(request.window[0] >= 800 && request.window[1] >= 500,
          "--window {} {}: must be at least 800 500", request.window[0], request.window[1]);
  video::FrameStore frames(request.video);
  const fs::path file =
      request.keypoints.empty() ? keypoints_file_of(request.video) : request.keypoints;
  const Keypoints fresh = fresh_keypoints(request.video, frames.info());
  if (fs::exists(file))
    if (const Keypoints old = load_keypoints(file); old.video_sha256 == fresh.video_sha256)
      tracking::check_picture(old, fresh.width_px, fresh.height_px, file);
  annotation::AnnotationJournal journal(file, fresh);
  if (journal.recovered() > 0)
    fmt::print(stderr, "{}: recovered {} edits that a killed window had left\n", file.string(),
               journal.recovered());
  if (const std::string& said = request.movement; !said.empty()) {
    annotation::ClipSettings settings = annotation::settings_of(journal.document().keypoints());
    if (settings.movement != said) {
      settings.movement = movement(said, "--movement").name;
      journal.apply({"a " + said, {}, settings});
    }
  }
  const bool corrects = (request.pose.wanted && !request.pose.is_users()) ||
                        journal.document().keypoints().corrects_network;
  require(!corrects || request.import_from.empty(),
          "--import {}: these points are the pose network's to correct; give one of them",
          request.import_from.string());
  std::optional<tracking::LabelledClip> network;
  if (corrects)
    network = points_to_correct(request, frames, journal);
  else if (!request.import_from.empty() || request.pose.wanted)
    import_clicks(request, frames, journal);
  require(
      request.import.person == 0 || corrects || request.pose.wanted || !request.import_from.empty(),
      "--person {}: has no effect without --import or --pose: clicks say who runs",
      request.import.person);
  require(request.repair_legs || corrects || request.pose.wanted || !request.import_from.empty(),
          "--no-leg-repair: has no effect without --import or --pose");
  request.session.corrects = corrects;
  annotation::BackgroundTracker tracker(
      [&](const Keypoints& keypoints, const std::atomic<bool>& given_up) {
        return annotation::predict(keypoints, frames, given_up, network ? &*network : nullptr);
      });
  annotation::AnnotationSession session(journal, frames, request.session);
  if (request.script.empty()) {
    run_window(session, tracker, frames, request.session.canvas_px);
  } else {
    frames.wait();
    annotation::run_script(session, request.script, [&] {
      tracker.submit(session.keypoints(), session.revision());
      session.set_prediction(tracker.wait());
    });
  }
  journal.fold();
  if (!frames.shortfall().empty()) fmt::print(stderr, "warning: {}\n", frames.shortfall());
  fmt::print("{}\n", journal.file().string());
}

}  // namespace

void add_annotate_command(CLI::App& app) {
  const auto request = std::make_shared<AnnotateRequest>();
  CLI::App& command = *app.add_subcommand(
      "annotate",
      "click keypoints on a video and watch them being tracked (? in the window: help)");
  command.add_option("VIDEO", request->video, "the video");
  command.add_option("--keypoints", request->keypoints,
                     "clicks (default: NAME.keypoints.json beside the video)");
  command.add_option("--script", request->script,
                     "without a window: events from a file, one JSON object a line");
  command.add_option("--window", request->window, "its size: WIDTH HEIGHT (default: 1280 860)")
      ->expected(2);
  command.add_option("--movement", request->movement,
                     "run, walk, jump or another of movements.toml (default: as the clicks say)");
  command.add_flag("--hips", request->session.hips, "ask for the hips too");
  command.add_flag("--head", request->session.head, "ask for the head too");
  command.add_option("--import", request->import_from,
                     "points of another program to correct: a file or a folder");
  add_detection_options(command, request->import, request->pose, request->repair_legs);
  command.add_flag("--keys", request->keys, "print the table of keys and leave");
  command.callback([request, &command] {
    require_effect(command, request->import_from, request->pose);
    run(*request);
  });
}

}  // namespace stride
