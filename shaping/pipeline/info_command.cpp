#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "calibrate/osim/model.h"
#include "calibrate/runner/calibrated.h"
#include "extract/io/csv.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/outputs.h"
#include "extract/io/table.h"
#include "extract/io/toml.h"
#include "extract/skeleton/keypoints.h"
#include "extract/skeleton/trajectory.h"
#include "extract/skeleton/units.h"
#include "extract/tracking/time_check.h"
#include "extract/video/video.h"
#include "shaping/commands.h"
#include "shaping/potential.h"

namespace stride {
namespace fs = std::filesystem;
namespace {

std::string counts(const std::array<int, kBodyPartCount>& seen) {
  std::string text;
  for (const BodyPart part : kBodyParts)
    if (seen[index(part)] > 0) text += fmt::format("  {:<8} {}\n", name(part), seen[index(part)]);
  return text;
}

std::string calibration_line(const std::optional<CalibrationLine>& line) {
  return line ? fmt::format("calibration line: {}\n", text_of(*line)) : "";
}

std::string about_potential(const Potential& p) {
  std::string text = fmt::format(
      "potential of {} on {}\nmovement  {}\nverdict   {}\n{}    {:.4f} s +- {:.4f}, {:.2f} m/s\n"
      "function  {}, epsilon {} m, weight {}, keyframe by {}, foot = {}\n"
      "fit       {:.2f} px rms, {:.1f} cm\n"
      "phase   pelvis    knee_r          foot_r          knee_l          foot_l (m; +- 1 sd)\n",
      one_line(p.source), p.model, p.movement, p.verdict, p.repeats ? "stride" : "lasts ",
      p.period_s, p.period_sd_s, p.speed_m_s, kInverseDistances[p.function], p.epsilon_m, p.weight,
      kPotentialIndices[p.index], p.foot, p.rms_px, 100 * p.rms_m);
  for (const Keyframe& k : p.keyframes) {
    const auto row = [](const Pose& pose) {
      std::string numbers = fmt::format("{:7.3f}", pose.pelvis_height_m());
      for (const ComparedPart& each : kPoseParts)
        if (each.numbers == 2)
          numbers += fmt::format("  {:6.3f} {:6.3f} ", pose[each.part].x(), pose[each.part].y());
      return numbers;
    };
    text += fmt::format("{:.3f}  {}\n     +- {}\n", k.phase, row(k.pose), row(k.sd));
  }
  return text;
}

std::string about_keypoints(const Keypoints& k) {
  std::array<int, kBodyPartCount> seen{};
  for (const auto& [number, frame] : k.frames)
    for (const BodyPart part : kBodyParts) seen[index(part)] += frame[part].has_value() ? 1 : 0;
  return fmt::format(
             "clicks on {}, {} x {}, movement {}, the runner faces {}\n{} frames, {} to {}\n{}",
             one_line(k.video), k.width_px, k.height_px, k.movement,
             k.direction ? kFacings[*k.direction] : "(not said)", k.frames.size(),
             k.frames.empty() ? 0 : k.frames.begin()->first,
             k.frames.empty() ? 0 : k.frames.rbegin()->first, counts(seen)) +
         calibration_line(k.calibration_line);
}

std::string about_trajectory(const Trajectory& t) {
  std::array<int, kBodyPartCount> seen{};
  for (const TrajectoryFrame& frame : t.frames)
    for (const BodyPart part : kBodyParts) seen[index(part)] += frame[part].present() ? 1 : 0;
  return fmt::format(
             "trajectory of {} in pixels, {} x {} at {:.2f} Hz, movement {}, the runner faces "
             "{}\n{} "
             "frames; marks:\n{}",
             one_line(t.video), t.width_px, t.height_px, t.rate_hz, t.movement,
             t.direction ? kFacings[*t.direction] : "(not said)", t.frames.size(), counts(seen)) +
         calibration_line(t.calibration_line);
}

std::string about_calibrated(const CalibratedTrajectory& c) {
  const double duration_s = c.samples.back().time_s - c.samples.front().time_s;
  return fmt::format(
      "run of {} on {}\nmovement  {}\nverdict   {}\nstride    {:.4f} s +- {:.4f}, {:.2f} of them, "
      "{:.2f} m/s\nscale     {:.3f} mm per pixel, roll {:.2f} deg\nfit       {:.2f} "
      "px rms, {:.1f} cm\nsamples   {}\n",
      one_line(c.source), c.model, c.movement, c.verdict, c.period_s, c.period_sd_s,
      duration_s / c.period_s, c.speed_m_s, 1000 * c.metres_per_pixel, c.camera_roll_rad / kDegree,
      c.rms_px, 100 * c.rms_m, c.samples.size());
}

std::string about_table(const Table& table) {
  std::string text =
      fmt::format("{} version {}, {} rows\n", table.format.empty() ? "a plain table" : table.format,
                  table.version, table.rows.size());
  for (const auto& [key, value] : table.metadata)
    text += fmt::format("  {}: {}\n", key, one_line(value));
  if (table.rows.empty()) return text;
  text += "last row\n";
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    text += fmt::format("  {:<28} {:.6g}\n", table.columns[i], table.rows.back()[i]);
  return text;
}

std::string about_run(const fs::path& run) {
  std::string text = fmt::format("run {}\n", run.string());
  if (fs::exists(run / "curve.csv")) text += about_table(load_csv(run / "curve.csv"));
  return text + "config.toml\n" + read_file(run / "config.toml");
}

std::string about_json(const fs::path& file) {
  std::string content = read_file(file);
  if (content.find("\"stride-potential\"") != std::string::npos)
    return about_potential(load_potential(file));
  if (content.find("\"stride keypoints\"") != std::string::npos ||
      file.string().ends_with(".keypoints.json"))
    return about_keypoints(load_keypoints(file));
  if (kind_of(file) == FileKind::points_json)
    return fmt::format("exported points: stride track VIDEO --import {}\n", file.string());
  if (file.filename() == "evaluation.json" || file.string().ends_with(".converted.json"))
    return content;
  throw Error(fmt::format("{}: neither a potential nor clicks: the key format says neither",
                          file.string()));
}

std::string about_video(const fs::path& file) {
  const video::Container container = video::read_container(file);
  const video::VideoTimes times = video::video_times(file, 1);
  const std::vector<double>& t = times.times_s;
  double shortest_s = t.size() > 1 ? t[1] - t[0] : 0, longest_s = shortest_s;
  for (std::size_t i = 1; i < t.size(); ++i) {
    shortest_s = std::min(shortest_s, t[i] - t[i - 1]);
    longest_s = std::max(longest_s, t[i] - t[i - 1]);
  }
  const bool varies = longest_s > 1.2 * shortest_s;
  std::string text = fmt::format(
      "video, {} in {}\n{} x {} px{}{}\n{} frames in {:.3f} s, announced {:.4g} a second{}\n",
      container.codec, container.format, times.info.width_px, times.info.height_px,
      times.info.stored_width_px == times.info.width_px
          ? ""
          : fmt::format(", stored {} wide: its pixels are not square", times.info.stored_width_px),
      container.turn.is_none() ? "" : ", " + video::text_of(container.turn), t.size(),
      t.empty() ? 0 : t.back() + (t.size() > 1 ? t.back() - t[t.size() - 2] : 0),
      times.info.rate_hz,
      varies ? fmt::format("; the rate varies: {:.1f} to {:.1f} ms a frame", 1000 * shortest_s,
                           1000 * longest_s)
             : "");
  if (const std::string doubt = tracking::doubt_of_header(times.info); !doubt.empty())
    text += doubt + "\n";
  if (!times.shortfall.empty()) text += times.shortfall + "\n";
  return text;
}

/// The beginning of a text, as of a report.
std::string beginning(const fs::path& file) {
  constexpr std::size_t kMost = 2000;
  const std::string content = read_file(file);
  return content.size() <= kMost ? content : content.substr(0, kMost) + "\n…\n";
}

std::string about(const fs::path& file) {
  require(fs::exists(file), "{}: no such file or folder", file.string());
  if (fs::is_directory(file)) {
    require(fs::exists(file / "config.toml"), "{}: not the folder of a run: it has no config.toml",
            file.string());
    return about_run(file);
  }
  if (file.extension() == ".osim") return osim::describe(osim::load_osim(file));
  if (file.extension() == ".json") return about_json(file);
  const FileKind kind = kind_of(file);
  // A stream without a container has no first bytes to be told by: the decoder is tried.
  if (kind == FileKind::video || (kind == FileKind::binary && file.extension() != ".csv"))
    return about_video(file);
  if (kind == FileKind::image || kind == FileKind::svg) return fmt::format("{}\n", name(kind));
  if (kind == FileKind::report || kind == FileKind::motion || kind == FileKind::trc ||
      kind == FileKind::gnuplot_script || kind == FileKind::plot_data)
    return beginning(file);
  if (file.extension() == ".toml") {
    load_toml(file);
    return beginning(file);
  }
  if (kind == FileKind::safetensors)
    return fmt::format("{}, {} bytes; its run says more: stride info RUN\n", name(kind),
                       fs::file_size(file));
  if (kind == FileKind::onnx || kind == FileKind::tflite)
    return fmt::format("{}, {} bytes\n", name(kind), fs::file_size(file));
  require(file.extension() == ".csv",
          "{}: is {}, not a file of ours: a video, .json, .csv, .osim, .toml, .mot, .sto, .trc, "
          ".report.txt, or the folder of a run",
          file.string(), name(kind));
  const Table table = load_csv(file);
  if (table.format == "trajectory") return about_trajectory(load_trajectory(file));
  if (table.format == "calibrated") return about_calibrated(load_calibrated(file));
  return about_table(table);
}

}  // namespace

void add_info_command(CLI::App& app) {
  const auto file = std::make_shared<fs::path>();
  CLI::App* info = app.add_subcommand("info", "print any of our files, or a video, for a person");
  info->add_option(
          "file", *file,
          "a video, clicks, trajectory, calibrated run, potential, .osim, or the folder of a run")
      ->required();
  info->callback([file] { fmt::print("{}", about(*file)); });
}

}  // namespace stride
