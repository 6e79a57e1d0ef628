#include "extract/import/import.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "extract/import/formats/formats.h"
#include "extract/import/networks/networks.h"
#include "extract/import/parsing/people.h"
#include "extract/import/parsing/text.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/option_range.h"
#include "extract/io/outputs.h"

namespace stride::imports {
namespace fs = std::filesystem;
namespace {

/// Which format a text is. Empty: none that we know.
std::string sniff(std::string_view content, const std::string& file) {
  const auto start = content.find_first_not_of(" \t\n");
  if (start == std::string_view::npos) return "";
  const auto has = [&](std::string_view text) { return content.find(text) != content.npos; };
  if ((content[start] == '[' || content[start] == '{') && !has("\"pose_keypoints_2d\"")) {
    if (has("\"visible\"")) return "ultralytics";
    if (has("\"visibility\"") || has("andmarks\"")) return "mediapipe";
    if (has("\"instances\"") && !has("\"instance_info\"")) return "rtmpose";
    if (has("\"keypoints\"") && (has("\"scores\"") || has("\"keypoint_scores\"")) &&
        !has("\"instance_info\""))
      return "rtmpose";
  }
  if (content[start] == '[') return has("\"idx\"") || has("\"box\"") ? "alphapose" : "coco";
  if (content[start] == '{') {
    if (has("\"people\"")) return "openpose";
    if (has("\"instance_info\"")) return "mmpose";
    if (has("\"annotations\"")) return "coco";
    return has("\"stride points\"") ? "json" : "";
  }
  if (content[start] == '<') return has("<annotations") ? "cvat" : "";
  const TextTable table = read_text_table(content.substr(0, content.find('\n', 16384)), file);
  if (table.lines.empty()) return "";
  const std::vector<std::string>& cells = table.lines.front().cells;
  const std::string& first = cells.front();
  const auto names = [&](std::string_view name) {
    return std::ranges::any_of(cells, [&](const auto& c) { return c.find(name) != c.npos; });
  };
  if (first == "scorer" || first == "bodyparts") return "deeplabcut";
  if (first == "track" && names("frame_idx")) return "sleap";
  if (first.starts_with("PathFileType")) return "trc";
  if (first == "Time") return "kinovea";
  if (names("_cam1_X")) return "dltdv";
  if (is_mediapipe(table.lines.front())) return "mediapipe";
  return first == "frame" ? "csv" : "";
}

/// What to do with a file of another kind. Throws Error if it holds no text at all.
void require_text(FileKind kind, const std::string& file) {
  require(kind != FileKind::empty, "{}: is empty", file);
  const auto cure = [&]() -> std::string_view {
    switch (kind) {
      case FileKind::hdf5:
        return "DeepLabCut: analyze_videos(…, save_as_csv=True); SLEAP: export the analysis CSV";
      case FileKind::kinovea_xml:
        return "Kinovea: export the trajectories as CSV";
      case FileKind::zip:
        return "save the sheet as CSV";
      case FileKind::c3d:
        return "export TRC in pixels";
      case FileKind::video:
        return "give it as VIDEO";
      default:
        return "export the points as CSV or JSON";
    }
  };
  require(!is_binary(kind) && kind != FileKind::kinovea_xml && kind != FileKind::svg,
          "{}: is {}; expected points as text: {}", file, name(kind), cure());
}

/// The number of a file's frame. Ultralytics counts the frames of a video from 1 and writes the
/// numbers without zeros in front; a series of pictures keeps its own numbers.
int frame_of(const fs::path& file, std::string_view format) {
  const std::string name = file.stem().string();
  const auto frame = last_number(name);
  require(
      frame.has_value(),
      "{}: expected the number of the frame in the name, as in NAME_000000000012_keypoints.json",
      file.string());
  const bool from_1 = format == "ultralytics" && file.extension() == ".txt" && *frame > 0 &&
                      name.ends_with(fmt::format("_{}", *frame));
  return from_1 ? *frame - 1 : *frame;
}

using Reader = ImportedFile (*)(std::string_view, const std::string&, const ImportOptions&);
const std::vector<std::pair<std::string, Reader>>& readers();

ImportedFile read_as(const std::string& format, std::string_view text, const std::string& file,
                     const ImportOptions& options) {
  return std::ranges::find(readers(), format, [](const auto& r) { return r.first; })
      ->second(text, file, options);
}

/// A file a frame: OpenPose's, Ultralytics' .txt, or any format that has one. Sets `format`.
ImportedFile read_folder(const fs::path& folder, std::string& format,
                         const ImportOptions& options) {
  std::vector<fs::path> files, labels;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
    if (entry.path().extension() == ".txt") labels.push_back(entry.path());
  }
  const bool are_labels = files.empty() && !labels.empty();
  if (are_labels) files = labels;
  require(!files.empty(),
          "{}: a folder without files of a frame each: expected OpenPose's "
          "NAME_000000000012_keypoints.json, or Ultralytics' NAME_12.txt",
          folder.string());
  std::ranges::sort(files);
  if (format.empty()) {
    const std::string found =
        are_labels ? "ultralytics"
                   : sniff(decoded_text(read_file(files.front()), files.front().string()),
                           files.front().string());
    format =
        found == "mediapipe" || found == "ultralytics" || found == "rtmpose" ? found : "openpose";
  }
  ImportedFile content;
  for (const fs::path& file : files) {
    const int frame = frame_of(file, format);
    const std::string text = decoded_text(read_file(file), file.string());
    DetectedPeople more = are_labels ? read_ultralytics_labels(text, file.string(), frame).people
                                     : read_as(format, text, file.string(), options).people;
    for (DetectedPerson& person : more) person.frame = frame;
    content.people.insert(content.people.end(), more.begin(), more.end());
  }
  return content;
}

/// Every format by its name.
const std::vector<std::pair<std::string, Reader>>& readers() {
  static const std::vector<std::pair<std::string, Reader>> readers{
      {"openpose",
       [](std::string_view content, const std::string& file, const ImportOptions&) {
         const auto frame = last_number(fs::path(file).stem().string());
         return read_openpose(content, file, frame.value_or(0));
       }},
      {"deeplabcut", read_deeplabcut},
      {"coco", read_coco},
      {"alphapose", read_coco},
      {"mmpose", read_mmpose},
      {"sleap", read_sleap},
      {"trc", read_trc},
      {"cvat", read_cvat},
      {"kinovea", read_kinovea},
      {"dltdv", read_dltdv},
      {"mediapipe", read_mediapipe},
      {"ultralytics", read_ultralytics},
      {"rtmpose", read_rtmpose},
      {"csv", read_own_csv},
      {"json", [](std::string_view content, const std::string& file, const ImportOptions&) {
         return read_own_json(content, file);
       }}};
  return readers;
}

}  // namespace

const std::vector<std::string>& import_formats() {
  static const std::vector<std::string> formats = [] {
    std::vector<std::string> names;
    for (const auto& [name, reader] : readers()) names.push_back(name);
    return names;
  }();
  return formats;
}

Detections import_points(const fs::path& path, const ImportOptions& options) {
  require(fs::exists(path), "{}: no such file or folder", path.string());
  std::string format = options.format;
  require(format.empty() || std::ranges::find(import_formats(), format) != import_formats().end(),
          "format = '{}': must be one of {}", format, fmt::join(import_formats(), ", "));
  ImportedFile content;
  if (fs::is_directory(path)) {
    const bool has_folders = format.empty() || format == "openpose" || format == "mediapipe" ||
                             format == "ultralytics" || format == "rtmpose";
    require(has_folders,
            "{}: is a folder; a folder is read as OpenPose's, MediaPipe's, Ultralytics' or "
            "RTMPose's, a file a frame, not as {}",
            path.string(), format);
    content = read_folder(path, format, options);
  } else {
    require(fs::is_regular_file(path), "{}: is not a file", path.string());
    require_text(kind_of(path), path.string());
    const std::string text = decoded_text(read_file(path), path.string());
    if (format.empty()) format = sniff(text, path.string());
    require(!format.empty(),
            "{}:1: not a format of points that is known; expected one of {} (see --format)",
            path.string(), fmt::join(import_formats(), ", "));
    content = read_as(format, text, path.string(), options);
  }
  require(!options.rate_was_given || format == "kinovea",
          "--import-rate {}: files of {} say frames, not times: it has no effect, leave it out",
          options.rate_hz, format);
  Detections detections = take_person(std::move(content), options, path.string());
  detections.format = format;
  return detections;
}

}  // namespace stride::imports
