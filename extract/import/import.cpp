#include "extract/import/import.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "extract/import/formats/formats.h"
#include "extract/import/networks/ultralytics.h"
#include "extract/import/parsing/people.h"
#include "extract/import/parsing/text.h"
#include "extract/io/error.h"
#include "extract/io/file.h"
#include "extract/io/option_range.h"
#include "extract/io/outputs.h"

namespace stride::imports {
namespace fs = std::filesystem;
namespace {

struct NamedFormat {
  std::string_view name;
  const Format* format;
};

#define STRIDE_NAMED_FORMAT(name) NamedFormat{#name, &formats::name},
constexpr std::array kFormats{STRIDE_IMPORT_FORMATS(STRIDE_NAMED_FORMAT)};
#undef STRIDE_NAMED_FORMAT

const Format& format_of(std::string_view name) {
  return *std::ranges::find(kFormats, name, &NamedFormat::name)->format;
}

/// Which format a text is. Empty: none that we know.
std::string recognised(std::string_view text, const std::string& file) {
  const FileText asked(text, file);
  std::string_view best;
  Certainty most = Certainty::no;
  for (const auto& [name, format] : kFormats)
    if (const Certainty certainty = format->is_it(asked); certainty > most) {
      most = certainty;
      best = name;
    }
  return std::string(best);
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
                   : recognised(decoded_text(read_file(files.front()), files.front().string()),
                                files.front().string());
    format = !found.empty() && format_of(found).in_folders ? found : "openpose";
  }
  ImportedFile content;
  for (const fs::path& file : files) {
    const int frame = frame_of(file, format);
    const std::string text = decoded_text(read_file(file), file.string());
    DetectedPeople more = are_labels ? read_ultralytics_labels(text, file.string(), frame).people
                                     : format_of(format).read(text, file.string(), options).people;
    for (DetectedPerson& person : more) person.frame = frame;
    content.people.insert(content.people.end(), more.begin(), more.end());
  }
  return content;
}

}  // namespace

const std::vector<std::string>& import_formats() {
  static const std::vector<std::string> formats = [] {
    std::vector<std::string> names;
    for (const auto& [name, format] : kFormats) names.emplace_back(name);
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
    require(format.empty() || format_of(format).in_folders,
            "{}: is a folder; a folder is read as OpenPose's, MediaPipe's, Ultralytics' or "
            "RTMPose's, a file a frame, not as {}",
            path.string(), format);
    content = read_folder(path, format, options);
  } else {
    require(fs::is_regular_file(path), "{}: is not a file", path.string());
    require_text(kind_of(path), path.string());
    const std::string text = decoded_text(read_file(path), path.string());
    if (format.empty()) format = recognised(text, path.string());
    require(!format.empty(),
            "{}:1: not a format of points that is known; expected one of {} (see --format)",
            path.string(), fmt::join(import_formats(), ", "));
    content = format_of(format).read(text, path.string(), options);
  }
  require(!options.rate_was_given || format == "kinovea",
          "--import-rate {}: files of {} say frames, not times: it has no effect, leave it out",
          options.rate_hz, format);
  Detections detections = take_person(std::move(content), options, path.string());
  detections.format = format;
  return detections;
}

}  // namespace stride::imports
