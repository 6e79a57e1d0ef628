#include "extract/import/import.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "extract/import/formats/formats.h"
#include "extract/import/parsing/people.h"
#include "extract/import/parsing/text.h"
#include "extract/io/error.h"
#include "extract/io/file.h"

namespace stride::imports {
namespace fs = std::filesystem;
namespace {

/// The format of a file by its first bytes; empty if unknown.
std::string sniff(std::string_view content) {
  const auto start = content.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (start == std::string_view::npos) return "";
  const std::string_view head = content.substr(start, 4096);
  const std::string_view line = head.substr(0, head.find('\n'));
  const auto has = [&](std::string_view text) { return content.find(text) != content.npos; };
  if (head.front() == '[') return has("\"idx\"") || has("\"box\"") ? "alphapose" : "coco";
  if (head.front() == '{') {
    if (has("\"people\"")) return "openpose";
    if (has("\"instance_info\"")) return "mmpose";
    if (has("\"annotations\"")) return "coco";
    return has("\"stride points\"") ? "json" : "";
  }
  if (head.front() == '<') return has("<annotations") ? "cvat" : "";
  if (line.starts_with("scorer") || line.starts_with("bodyparts")) return "deeplabcut";
  if (line.starts_with("track,frame_idx")) return "sleap";
  if (line.starts_with("PathFileType")) return "trc";
  if (line.starts_with("Time") || line.starts_with("\"Time\"")) return "kinovea";
  if (line.find("_cam1_X") != line.npos) return "dltdv";
  if (line.starts_with("# stride trajectory") || line.starts_with("frame,")) return "csv";
  return "";
}

DetectedPeople read_openpose_folder(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  require(!files.empty(),
          "{}: a folder without .json files: expected OpenPose's NAME_000000000012_keypoints.json",
          folder.string());
  std::ranges::sort(files);
  DetectedPeople people;
  for (const fs::path& file : files) {
    const auto frame = last_number(file.stem().string());
    require(frame.has_value(),
            "{}: expected the number of the frame in the name, as in NAME_000000000012_keypoints"
            ".json",
            file.string());
    const DetectedPeople more = read_openpose(read_file(file), file.string(), *frame);
    people.insert(people.end(), more.begin(), more.end());
  }
  return people;
}

using Reader = DetectedPeople (*)(std::string_view, const std::string&, const ImportOptions&);

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
  DetectedPeople people;
  if (fs::is_directory(path)) {
    require(format.empty() || format == "openpose",
            "{}: is a folder; a folder is read as OpenPose's, not as {}", path.string(), format);
    format = "openpose";
    people = read_openpose_folder(path);
  } else {
    const std::string content = read_file(path);
    if (format.empty()) format = sniff(content);
    require(!format.empty(),
            "{}:1: not a format of points that is known; expected one of {} (see --format)",
            path.string(), fmt::join(import_formats(), ", "));
    const auto reader = std::ranges::find(readers(), format, [](const auto& r) { return r.first; });
    people = reader->second(content, path.string(), options);
  }
  Detections detections = take_person(std::move(people), options, path.string());
  detections.format = format;
  return detections;
}

}  // namespace stride::imports
