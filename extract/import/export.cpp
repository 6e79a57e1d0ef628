#include "extract/import/export.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/json/json.h"
#include "extract/io/table.h"

namespace stride::imports {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

void write_csv(const Trajectory& trajectory, const fs::path& file) {
  Table table = table_of(trajectory);
  table.format.clear();
  table.metadata.clear();
  save(table, file);
}

void write_json(const Trajectory& trajectory, const fs::path& file) {
  Json frames = Json::array();
  for (const TrajectoryFrame& frame : trajectory.frames) {
    Json points = Json::object();
    for (const BodyPart part : kBodyParts)
      if (frame[part].present())
        points[std::string(name(part))] = {frame[part].p_px.x(), frame[part].p_px.y(),
                                           frame[part].confidence};
    frames.push_back({{"frame", frame.frame}, {"time_s", frame.time_s}, {"points", points}});
  }
  const Json json{{"format", "stride points"},
                  {"version", 1},
                  {"unit", "px"},
                  {"video", trajectory.video},
                  {"video_sha256", trajectory.video_sha256},
                  {"width_px", trajectory.width_px},
                  {"height_px", trajectory.height_px},
                  {"rate_hz", trajectory.rate_hz},
                  {"direction", name_or_empty(kFacings, trajectory.direction)},
                  {"frames", frames}};
  write_file_atomically(file, json_text(json));
}

void write_trc(const Trajectory& trajectory, const fs::path& file) {
  std::string out;
  const auto frames = trajectory.frames.size();
  const std::vector<BodyPart> all = seen_parts(trajectory);
  out += fmt::format("PathFileType\t4\t(X/Y/Z)\t{}\n", file.filename().string());
  out +=
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\t"
      "OrigDataStartFrame\tOrigNumFrames\n";
  out += fmt::format("{0}\t{0}\t{1}\t{2}\tpx\t{0}\t{3}\t{1}\n", trajectory.rate_hz, frames,
                     all.size(), frames > 0 ? trajectory.frames[0].frame : 0);
  out += "Frame#\tTime";
  for (const BodyPart part : all) out += fmt::format("\t{}\t\t", name(part));
  out += "\n\t";
  for (std::size_t i = 1; i <= all.size(); ++i) out += fmt::format("\tX{0}\tY{0}\tZ{0}", i);
  out += "\n";
  for (const TrajectoryFrame& frame : trajectory.frames) {
    out += fmt::format("{}\t{}", frame.frame, frame.time_s);
    for (const BodyPart part : all) {
      const Point& point = frame[part];
      out +=
          point.present() ? fmt::format("\t{}\t{}\t0", point.p_px.x(), point.p_px.y()) : "\t\t\t";
    }
    out += "\n";
  }
  write_file_atomically(file, out);
}

void write_deeplabcut(const Trajectory& trajectory, const fs::path& file) {
  std::vector<std::string> scorer{"scorer"}, parts{"bodyparts"}, coords{"coords"};
  const std::vector<BodyPart> all = seen_parts(trajectory);
  for (const BodyPart part : all)
    for (const char* coordinate : {"x", "y", "likelihood"}) {
      scorer.emplace_back("stride");
      parts.emplace_back(name(part));
      coords.emplace_back(coordinate);
    }
  std::string out;
  for (const auto* row : {&scorer, &parts, &coords})
    out += fmt::format("{}\n", fmt::join(*row, ","));
  for (const TrajectoryFrame& frame : trajectory.frames) {
    out += fmt::format("{}", frame.frame);
    for (const BodyPart part : all) {
      const Point& point = frame[part];
      out += point.present()
                 ? fmt::format(",{},{},{}", point.p_px.x(), point.p_px.y(), point.confidence)
                 : ",,,";
    }
    out += "\n";
  }
  write_file_atomically(file, out);
}

void write_openpose(const Trajectory& trajectory, const fs::path& folder) {
  const std::string stem =
      trajectory.video.empty() ? "stride" : fs::path(trajectory.video).stem().string();
  for (const TrajectoryFrame& frame : trajectory.frames) {
    std::vector<double> keypoints(3 * 25, 0.0);
    for (const BodyPart part : kBodyParts) {
      if (!frame[part].present() || frame[part].confidence <= 0) continue;
      double* xyc = &keypoints[3 * static_cast<std::size_t>(row(part).body_25)];
      xyc[0] = frame[part].p_px.x();
      xyc[1] = frame[part].p_px.y();
      xyc[2] = frame[part].confidence;
    }
    const Json empty = Json::array();
    const Json person{{"person_id", {-1}},
                      {"pose_keypoints_2d", keypoints},
                      {"face_keypoints_2d", empty},
                      {"hand_left_keypoints_2d", empty},
                      {"hand_right_keypoints_2d", empty}};
    const Json json{{"version", 1.3}, {"people", Json::array({person})}};
    write_file_atomically(folder / fmt::format("{}_{:012}_keypoints.json", stem, frame.frame),
                          json.dump() + "\n");
  }
}

using Writer = void (*)(const Trajectory&, const fs::path&);

const std::vector<std::pair<std::string, Writer>>& writers() {
  static const std::vector<std::pair<std::string, Writer>> writers{{"csv", write_csv},
                                                                   {"json", write_json},
                                                                   {"trc", write_trc},
                                                                   {"deeplabcut", write_deeplabcut},
                                                                   {"openpose", write_openpose}};
  return writers;
}

}  // namespace

const std::vector<std::string>& export_formats() {
  static const std::vector<std::string> formats = [] {
    std::vector<std::string> names;
    for (const auto& [name, writer] : writers()) names.push_back(name);
    return names;
  }();
  return formats;
}

namespace {

Writer writer_of(const fs::path& to, const std::string& format) {
  std::string wanted = format;
  if (wanted.empty()) {
    const std::string extension = to.extension().string();
    wanted = extension.empty() ? "openpose" : extension.substr(1);
  }
  const auto writer =
      std::ranges::find(writers(), wanted, [](const auto& entry) { return entry.first; });
  require(writer != writers().end(), "{}: format '{}' cannot be written; use one of {}",
          to.string(), wanted, fmt::join(export_formats(), ", "));
  return writer->second;
}

}  // namespace

void check_export(const fs::path& to, const std::string& format) { writer_of(to, format); }

void export_points(const Trajectory& trajectory, const fs::path& to, const std::string& format) {
  writer_of(to, format)(trajectory, to);
}

}  // namespace stride::imports
