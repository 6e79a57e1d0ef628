#include "shaping/pipeline/convert.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>

#include "calibrate/calibrate.h"
#include "calibrate/report/report.h"
#include "calibrate/report/report_frames.h"
#include "extract/annotation/journal.h"
#include "extract/annotation/points_of_video.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/json/json.h"
#include "extract/io/outputs.h"
#include "extract/pose/weights.h"
#include "extract/skeleton/movement.h"
#include "extract/tracking/time_check.h"
#include "extract/video/overlay.h"
#include "extract/video/repeated.h"

namespace stride::pipeline {
namespace fs = std::filesystem;
namespace {

constexpr const char* kTrajectory = ".trajectory.csv";
constexpr const char* kCalibrated = ".calibrated.csv";
constexpr const char* kOverlay = ".overlay.mp4";
constexpr const char* kLoop = ".loop.mp4";
constexpr const char* kStamp = ".converted.json";

bool ends_with(const fs::path& file, std::string_view ending) {
  return file.filename().string().ends_with(ending);
}

/// Why a file of a folder is no input; empty if it is one.
std::string left_out(const fs::path& file) {
  const FileKind kind = kind_of(file);
  if (fs::is_directory(file)) return "a folder";
  if (ends_with(file, kOverlay) || ends_with(file, kLoop)) return "made of another video here";
  if (kind != FileKind::video && kind != FileKind::binary) return std::string(name(kind));
  if (!fs::exists(keypoints_file_of(file)) && !pose::installed_weights())
    return fmt::format("no {} beside it", keypoints_file_of(file).filename().string());
  return {};
}

/// source.points of a potential: "clicks", "network" or "mixed".
void say_whose_points(const fs::path& potential, const std::string& points) {
  auto json = parse_json(read_file(potential), potential, "a potential");
  json["source"]["points"] = points;
  write_file_atomically(potential, json_text(json));
}

/// One input and its intermediate results.
class Clip {
 public:
  Clip(fs::path input, const ConvertOptions& options, const SagittalModel& model)
      : input_(std::move(input)), options_(options), model_(model) {
    result_.name = clip_name(input_);
    const auto own = options.by_clip.find(result_.name);
    clip_ = own == options.by_clip.end() ? options.clip : own->second;
  }

  Converted convert() {
    check_files();
    if (is_loop()) {
      video::write_repeated(input_, options_.loop, out(kLoop));
      input_ = out(kLoop);
    }
    // Before the inputs are compared with those of the last time.
    if (is_video(input_)) annotation::fold_left_over_journal(keypoints_file_of(input_));
    const std::string stamp = fingerprint();
    if (!options_.again && is_done(stamp)) return result_;
    const CalibratedTrajectory run = is_calibrated(input_) ? loaded() : calibrated(tracked());
    const Potential potential = make_potential(run, clip_.keyframes, input_.string());
    if (is_calibrated(input_) && !clip_.force)  // of others the verdict tells
      require_human(potential, input_.string());
    save(potential, out(".potential.json"));
    if (!result_.points.empty()) say_whose_points(out(".potential.json"), result_.points);
    write_stamp(stamp);
    return result_;
  }

  /// The same, with a failure as the result.
  Converted convert_or_explain() {
    try {
      return convert();
    } catch (const std::exception& error) {
      result_.failed = true;
      result_.verdict = error.what();
      return result_;
    }
  }

 private:
  bool is_loop() const { return options_.loop > 1 && is_video(input_); }

  fs::path out(const char* ending) const { return options_.out / (result_.name + ending); }

  void check_files() const {
    const auto own = [&](const char* ending, bool is_input) {
      return is_input ? fs::path() : out(ending);
    };
    check_outputs({input_, keypoints_file_of(input_), options_.model},
                  {{"-o", is_loop() ? out(kLoop) : fs::path(), FileKind::video},
                   {"-o", own(kTrajectory, !is_video(input_)), FileKind::trajectory},
                   {"-o", own(kCalibrated, is_calibrated(input_)), FileKind::calibrated},
                   {"-o", out(".report.txt"), FileKind::report},
                   {"-o", out(".report.svg"), FileKind::svg},
                   {"-o", out(".potential.json"), FileKind::potential},
                   {"-o", out(kStamp), FileKind::json},
                   {"--overlay", options_.overlay ? out(kOverlay) : "", FileKind::video}});
  }

  CalibratedTrajectory loaded() {
    CalibratedTrajectory run = load_calibrated(input_);
    result_.frames = static_cast<int>(run.samples.size());
    describe(run, run.samples.back().time_s - run.samples.front().time_s);
    return run;
  }

  CalibratedTrajectory calibrated(Trajectory trajectory) {
    if (clip_.direction) trajectory.direction = clip_.direction;
    if (!clip_.movement.empty()) trajectory.movement = clip_.movement;
    result_.frames = static_cast<int>(trajectory.frames.size());
    const Calibration calibration = calibrate(trajectory, model_, fit::fit_options(clip_.size));
    std::string report = report::report_text(trajectory, model_, calibration);
    if (!result_.points.empty()) report += fmt::format("points    {}\n", result_.points);
    write_file_atomically(out(".report.txt"), report);
    if (calibration.fit.ok && options_.pictures)
      report::draw_report(
          trajectory, model_, calibration,
          is_video(input_) ? input_ : report::video_in(input_.parent_path(), trajectory),
          out(".report.svg"));
    const bool accepted = !calibration.verdict.refused || (clip_.force && calibration.ok());
    require(accepted, "{}", calibration.verdict.text());
    describe(calibration.run, calibration.observations.duration_s);
    save(calibration.run, out(kCalibrated));
    return calibration.run;
  }

  Trajectory tracked() {
    if (ends_with(input_, kTrajectory)) return load_trajectory(input_);
    tracking::PointsOptions points;
    points.slow_motion = clip_.slow_motion;
    points.network = options_.network;
    points.landmarks = options_.landmarks;
    points.person = options_.person;
    points.repair_legs = clip_.movement.empty() || movement(clip_.movement).repeats;
    tracking::LabelledClip labelled = tracking::points_of_video(input_, points);
    if (!clip_.movement.empty()) labelled.marks.movement = clip_.movement;
    result_.points = labelled.points;
    tracking::warn_of_header(input_, labelled.slow_motion);
    Trajectory trajectory = tracking::track(input_, labelled).trajectory;
    save(trajectory, out(kTrajectory));
    if (options_.overlay) video::write_overlay(input_, trajectory, out(kOverlay));
    return trajectory;
  }

  void describe(const CalibratedTrajectory& run, double duration_s) {
    result_.strides = duration_s / run.period_s;
    result_.period_s = run.period_s;
    result_.speed_m_s = run.speed_m_s;
    result_.mm_per_px = 1000 * run.metres_per_pixel;
    result_.rms_px = run.rms_px;
    result_.rms_cm = 100 * run.rms_m;
    result_.verdict = run.verdict;
  }

  /// A hash of everything that the result depends on.
  std::string fingerprint() const {
    const KeyframeOptions& k = clip_.keyframes;
    std::string all = fmt::format(
        "2 {} {} {} {} {} {} {} {} {} {} {} {} {} {}", sha256_of_file(input_),
        sha256_of_file(options_.model), clip_.size.height_m.value_or(0),
        clip_.size.leg_m.value_or(0), clip_.size.metres_per_pixel.value_or(0),
        name_or_empty(kFacings, clip_.direction), clip_.slow_motion, clip_.force, k.count, k.foot,
        k.symmetric, kInverseDistances[k.function], kPotentialIndices[k.index], k.epsilon_m);
    all += fmt::format(" {} {} {}", k.weight, options_.network, options_.person);
    if (!clip_.movement.empty()) all += " " + clip_.movement;
    if (!options_.landmarks.empty()) all += " " + sha256_of_file(options_.landmarks);
    if (is_video(input_) && fs::exists(keypoints_file_of(input_)))
      all += " " + sha256_of_file(keypoints_file_of(input_));
    return all;
  }

  bool is_done(const std::string& stamp) {
    if (!fs::exists(out(kStamp)) || !fs::exists(out(".potential.json"))) return false;
    if (!is_calibrated(input_) && !fs::exists(out(kCalibrated))) return false;
    const bool drawn = is_calibrated(input_) || fs::exists(out(".report.svg")) ||
                       !load_potential(out(".potential.json")).repeats;
    if (options_.pictures && !drawn) return false;
    if (options_.overlay && is_video(input_) && !fs::exists(out(kOverlay))) return false;
    const auto json = json_or_null(read_file(out(kStamp)));
    const auto text = [&](const char* key) {
      const auto found = json.is_object() ? json.find(key) : json.end();
      return found != json.end() && found->is_string() ? found->get<std::string>() : "";
    };
    if (text("inputs") != stamp) return false;
    const auto number = [&](const char* key) {
      return json.contains(key) && json[key].is_number() ? json[key].get<double>() : std::nan("");
    };
    result_.unchanged = true;
    result_.frames = static_cast<int>(number("frames"));
    result_.strides = number("strides");
    result_.period_s = number("period_s");
    result_.speed_m_s = number("speed_m_s");
    result_.mm_per_px = number("mm_per_px");
    result_.rms_px = number("rms_px");
    result_.rms_cm = number("rms_cm");
    result_.points = text("points");
    result_.verdict = text("verdict");
    return true;
  }

  void write_stamp(const std::string& stamp) const {
    const nlohmann::ordered_json json{{"inputs", stamp},
                                      {"frames", result_.frames},
                                      {"strides", result_.strides},
                                      {"period_s", result_.period_s},
                                      {"speed_m_s", result_.speed_m_s},
                                      {"mm_per_px", result_.mm_per_px},
                                      {"rms_px", result_.rms_px},
                                      {"rms_cm", result_.rms_cm},
                                      {"points", result_.points},
                                      {"verdict", result_.verdict}};
    write_file_atomically(out(kStamp), json_text(json));
  }

  fs::path input_;
  const ConvertOptions& options_;
  const SagittalModel& model_;
  ClipOptions clip_;
  Converted result_;
};

}  // namespace

bool is_calibrated(const fs::path& input) { return ends_with(input, kCalibrated); }

bool is_video(const fs::path& input) {
  return !ends_with(input, kTrajectory) && !is_calibrated(input);
}

std::string clip_name(const fs::path& input) {
  for (const char* ending : {kTrajectory, kCalibrated}) {
    const std::string file = input.filename().string();
    if (file.ends_with(ending)) return file.substr(0, file.size() - std::string(ending).size());
  }
  return input.stem().string();
}

std::vector<fs::path> expand_inputs(const std::vector<fs::path>& given,
                                    const std::function<void(const std::string&)>& tell) {
  std::vector<fs::path> inputs;
  for (const fs::path& each : given) {
    require(fs::exists(each), "{}: no such file or folder", each.string());
    if (!fs::is_directory(each)) {
      const FileKind kind = kind_of(each);
      require(!is_video(each) || kind == FileKind::video || kind == FileKind::binary,
              "{}: is {}; must be a video, NAME.trajectory.csv or NAME.calibrated.csv",
              each.string(), name(kind));
      inputs.push_back(each);
      continue;
    }
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(each)) {
      const std::string why = left_out(entry.path());
      if (why.empty())
        found.push_back(entry.path());
      else if (tell)
        tell(fmt::format("left out: {}: {}", entry.path().string(), why));
    }
    require(!found.empty(), "{}: no video with NAME.keypoints.json beside it", each.string());
    std::ranges::sort(found);
    inputs.insert(inputs.end(), found.begin(), found.end());
  }
  std::set<std::string> names;
  for (const fs::path& each : inputs)
    require(names.insert(clip_name(each)).second,
            "{}: another input is named {} too: they would overwrite one another", each.string(),
            clip_name(each));
  return inputs;
}

std::vector<Converted> convert(const std::vector<fs::path>& inputs, const ConvertOptions& options) {
  const SagittalModel model = sagittal_model(osim::load_osim(options.model));
  std::vector<Converted> results(inputs.size());
  std::atomic<std::size_t> next{0};
  std::mutex reporting;
  std::size_t done = 0, converted = 0;
  const auto start = std::chrono::steady_clock::now();
  const auto left = [&]() -> std::string {
    if (converted == 0 || done == inputs.size()) return "";
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
    return fmt::format(" (about {:.0f} s left)", spent.count() / static_cast<double>(converted) *
                                                     static_cast<double>(inputs.size() - done));
  };
  const auto work = [&] {
    for (std::size_t i = next++; i < inputs.size(); i = next++) {
      results[i] = Clip(inputs[i], options, model).convert_or_explain();
      const std::lock_guard lock(reporting);
      ++done;
      converted += results[i].unchanged || results[i].failed ? 0 : 1;
      if (options.progress)
        options.progress(fmt::format("{} of {}: {}: {}{}", done, inputs.size(), results[i].name,
                                     results[i].unchanged ? "unchanged" : results[i].verdict,
                                     left()));
    }
  };
  const int wanted =
      options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency());
  std::vector<std::jthread> workers;
  for (int i = 1; i < std::min<int>(wanted, static_cast<int>(inputs.size())); ++i)
    workers.emplace_back(work);
  work();
  workers.clear();
  return results;
}

std::string table_of(const std::vector<Converted>& results) {
  std::size_t width = 4;
  for (const Converted& row : results) width = std::max(width, row.name.size());
  std::string text = fmt::format(
      "{:<{}}  frames  strides  period s  speed m/s  mm/px  rms px  rms cm  points   verdict\n",
      "clip", width);
  for (const Converted& row : results)
    text +=
        row.failed
            ? fmt::format("{:<{}}  {:6}  failed: {}\n", row.name, width, row.frames, row.verdict)
            : fmt::format(
                  "{:<{}}  {:6}  {:7.2f}  {:8.4f}  {:9.2f}  {:5.2f}  {:6.2f}  {:6.2f}  "
                  "{:<7}  {}{}\n",
                  row.name, width, row.frames, row.strides, row.period_s, row.speed_m_s,
                  row.mm_per_px, row.rms_px, row.rms_cm, row.points.empty() ? "-" : row.points,
                  row.verdict, row.unchanged ? " (unchanged)" : "");
  return text;
}

}  // namespace stride::pipeline
