#include "extract/io/outputs.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string>
#include <utility>

#include "extract/io/error.h"

namespace stride {
namespace fs = std::filesystem;
using namespace std::string_view_literals;
namespace {

constexpr std::size_t kHead = 8192;

/// Files that begin with the same bytes, whatever follows.
constexpr std::array kSignatures{
    std::pair{"\x89HDF\r\n\x1a\n"sv, FileKind::hdf5},
    std::pair{"PK\x03\x04"sv, FileKind::zip},
    std::pair{"\x93NUMPY"sv, FileKind::numpy},
    std::pair{"MATLAB"sv, FileKind::matlab},
    std::pair{"\x80\x02"sv, FileKind::pickle},
    std::pair{"\x80\x03"sv, FileKind::pickle},
    std::pair{"\x80\x04"sv, FileKind::pickle},
    std::pair{"\x80\x05"sv, FileKind::pickle},
    std::pair{"\x02\x50"sv, FileKind::c3d},
    std::pair{"\xff\xfe"sv, FileKind::utf16},
    std::pair{"\xfe\xff"sv, FileKind::utf16},
    std::pair{"\x89PNG\r\n\x1a\n"sv, FileKind::image},
    std::pair{"\xff\xd8\xff"sv, FileKind::image},
    std::pair{"GIF8"sv, FileKind::video},
    std::pair{"BM"sv, FileKind::image},
    std::pair{"RIFF"sv, FileKind::video},              // AVI
    std::pair{"\x1a\x45\xdf\xa3"sv, FileKind::video},  // Matroska, WebM
    std::pair{"\0\0\1\xba"sv, FileKind::video},        // MPEG program stream
    std::pair{"\0\0\1\xb3"sv, FileKind::video},
    std::pair{"\x30\x26\xb2\x75"sv, FileKind::video},  // ASF, WMV
    std::pair{"FLV\1"sv, FileKind::video},
    std::pair{"OggS"sv, FileKind::video},
    std::pair{"YUV4MPEG2"sv, FileKind::video},
    std::pair{"# stride trajectory"sv, FileKind::trajectory},
    std::pair{"# stride calibrated"sv, FileKind::calibrated},
    std::pair{"# stride "sv, FileKind::table},
    std::pair{"clip      "sv, FileKind::report},
    std::pair{"frame,time_s,"sv, FileKind::points_csv},
    std::pair{"# x, mean, standard error"sv, FileKind::plot_data},
    std::pair{"# Run gnuplot on this file"sv, FileKind::gnuplot_script},
    std::pair{"PathFileType"sv, FileKind::trc}};

/// The boxes that mp4, mov and 3gp files begin with.
bool is_mp4(std::string_view head) {
  if (head.size() < 8) return false;
  constexpr std::array kBoxes{"ftyp"sv, "moov"sv, "mdat"sv, "wide"sv, "free"sv, "skip"sv};
  return std::ranges::find(kBoxes, head.substr(4, 4)) != kBoxes.end();
}

/// Packets of 188 bytes, or of 192 in cameras' .mts.
bool is_transport_stream(std::string_view head) {
  for (const auto& [first, step] : {std::pair{0U, 188U}, std::pair{4U, 192U}})
    if (head.size() > first + 2 * step && head[first] == 'G' && head[first + step] == 'G' &&
        head[first + 2 * step] == 'G')
      return true;
  return false;
}

/// Weights of an agent or a network, which have no signature at their very beginning.
FileKind kind_of_weights(std::string_view head) {
  if (head.size() < 10) return FileKind::binary;
  if (head.substr(4, 4) == "TFL3") return FileKind::tflite;
  if (head.substr(4, 4) == "\0\0\0\0"sv && head.substr(8, 2) == "{\"") return FileKind::safetensors;
  // ir_version, then the producer's name, the graph or the operators' version.
  if (head[0] == '\x08' && head[1] > 0 && head[1] < 0x20 &&
      (head[2] == '\x12' || head[2] == '\x3a' || head[2] == '\x42'))
    return FileKind::onnx;
  return FileKind::binary;
}

/// [section] of a TOML file, which is no array of JSON.
bool is_section(std::string_view text) {
  const std::string_view inside = text.substr(0, text.find(']'));
  const auto letters = inside.find_first_not_of('[');
  return inside.size() < text.size() && letters != inside.npos &&
         std::isalpha(static_cast<unsigned char>(inside[letters])) != 0 &&
         inside.find_first_of("\",{:\r\n") == inside.npos;
}

FileKind kind_of_text(std::string_view head) {
  const auto has = [&](std::string_view text) { return head.find(text) != head.npos; };
  const auto start = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF"sv);
  const char first = start == head.npos ? ' ' : head[start];
  if (first == '<') {
    if (has("content=\"stride\"") && has("<!DOCTYPE html>")) return FileKind::page;
    if (has("<svg")) return FileKind::svg;
    return has("<KinoveaVideoAnalysis") ? FileKind::kinovea_xml : FileKind::xml;
  }
  if (first == '{' || (first == '[' && !is_section(head.substr(start)))) {
    if (has("\"stride keypoints\"")) return FileKind::keypoints;
    if (has("\"stride-potential\"")) return FileKind::potential;
    if (has("\"stride points\"")) return FileKind::points_json;
    if (first == '{' || has("{") || has("\"")) return FileKind::json;
  }
  return has("endheader") ? FileKind::motion : FileKind::text;
}

/// The same place, whether or not there is a file yet.
bool is_same(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;
  const auto place = [&](const fs::path& file) {
    const fs::path found = fs::weakly_canonical(fs::absolute(file), error);
    return error ? fs::absolute(file).lexically_normal() : found;  // as a name that is too long
  };
  return place(a) == place(b);
}

/// The folder that exists, in which those that are missing would be made.
fs::path nearest_folder(const fs::path& file) {
  fs::path folder = fs::absolute(file).lexically_normal().parent_path();
  std::error_code error;
  while (folder.has_relative_path() && !fs::exists(folder, error)) folder = folder.parent_path();
  return folder;
}

/// What can be told of a name before there is anything to write.
void check_name(const Output& output) {
  const std::string name = output.file.filename().string();
  require(!name.empty(), "{} {}: is a folder: name a file in it", output.option,
          output.file.string());
  require(output.file != "-", "{} -: is not the standard output here: name a file (./- is one)",
          output.option);
  constexpr std::size_t kLongest = 240;  // of 255 bytes: unfinished files have longer names
  require(name.size() <= kLongest, "{} {}: the name has {} bytes, at most {} can be written",
          output.option, output.file.string(), name.size(), kLongest);
  std::error_code error;
  const fs::path folder = nearest_folder(output.file);
  require(!fs::is_directory(folder, error) || fs::is_other(output.file, error) ||
              ::access(folder.c_str(), W_OK | X_OK) == 0,
          "{} {}: cannot be written: {} is not yours to write in", output.option,
          output.file.string(), folder.string());
  require(output.kind != FileKind::video || output.file.extension() == ".mp4",
          "{} {}: videos are written as .mp4; change the name", output.option,
          output.file.string());
}

bool is_regular(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error);
}

/// Whether the output would replace the input, or a file in it.
bool replaces(const fs::path& output, const fs::path& input) {
  std::error_code error;
  if (is_same(output, input)) return true;
  return fs::is_directory(input, error) && is_regular(output) &&
         is_same(fs::absolute(output).parent_path(), input);
}

}  // namespace

FileKind kind_of_content(std::string_view head) {
  if (head.empty()) return FileKind::empty;
  if (head.starts_with("\x89PNG"sv) && head.find("acTL"sv) != head.npos) return FileKind::video;
  for (const auto& [bytes, kind] : kSignatures)
    if (head.starts_with(bytes)) return kind;
  if (is_mp4(head) || is_transport_stream(head)) return FileKind::video;
  const auto is_binary = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 && c != '\t' && c != '\n' && c != '\r' && c != '\f' && c != '\v';
  };
  if (std::ranges::any_of(head, is_binary)) return kind_of_weights(head);
  return kind_of_text(head);
}

FileKind kind_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return FileKind::missing;
  std::ifstream in(file, std::ios::binary);
  if (!in.good()) return FileKind::unreadable;
  std::string head(kHead, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return kind_of_content(head);
}

bool is_binary(FileKind kind) {
  switch (kind) {
    case FileKind::image:
    case FileKind::video:
    case FileKind::zip:
    case FileKind::hdf5:
    case FileKind::pickle:
    case FileKind::matlab:
    case FileKind::numpy:
    case FileKind::c3d:
    case FileKind::safetensors:
    case FileKind::tflite:
    case FileKind::onnx:
    case FileKind::binary:
      return true;
    default:
      return false;
  }
}

bool is_json(FileKind kind) {
  return kind == FileKind::json || kind == FileKind::keypoints || kind == FileKind::potential ||
         kind == FileKind::points_json;
}

void require_plain_text(const fs::path& file, std::string_view what) {
  const FileKind kind = kind_of(file);
  require(!is_binary(kind) && !is_json(kind) && kind != FileKind::kinovea_xml &&
              kind != FileKind::xml && kind != FileKind::svg && kind != FileKind::page,
          "{}: is {}, {} is needed", file.string(), name(kind), what);
}

std::string_view name(FileKind kind) {
  switch (kind) {
    case FileKind::unreadable:
      return "a file that you may not read";
    case FileKind::missing:
      return "no file";
    case FileKind::empty:
      return "an empty file";
    case FileKind::keypoints:
      return "a file of clicks";
    case FileKind::trajectory:
      return "a trajectory in pixels";
    case FileKind::calibrated:
      return "a calibrated run";
    case FileKind::table:
      return "a table of stride's";
    case FileKind::potential:
      return "a potential";
    case FileKind::report:
      return "a report";
    case FileKind::points_json:
      return "exported points (JSON)";
    case FileKind::points_csv:
      return "exported points (CSV)";
    case FileKind::plot_data:
      return "the figures of a plot";
    case FileKind::gnuplot_script:
      return "a script of a plot";
    case FileKind::motion:
      return "a motion of OpenSim's (.mot, .sto)";
    case FileKind::trc:
      return "a TRC file of markers";
    case FileKind::svg:
      return "an SVG picture";
    case FileKind::page:
      return "a page of stride report";
    case FileKind::image:
      return "a picture";
    case FileKind::video:
      return "a video";
    case FileKind::zip:
      return "a zip archive, as Excel's .xlsx is";
    case FileKind::hdf5:
      return "an HDF5 file (.h5, SLEAP's .slp)";
    case FileKind::pickle:
      return "a Python pickle";
    case FileKind::matlab:
      return "a MATLAB file (.mat)";
    case FileKind::numpy:
      return "a NumPy file (.npy)";
    case FileKind::c3d:
      return "a C3D file";
    case FileKind::safetensors:
      return "an agent or a checkpoint (safetensors)";
    case FileKind::tflite:
      return "a network (TensorFlow Lite)";
    case FileKind::onnx:
      return "a network (ONNX)";
    case FileKind::kinovea_xml:
      return "Kinovea's own file (.kva)";
    case FileKind::xml:
      return "an XML file";
    case FileKind::json:
      return "a JSON file";
    case FileKind::utf16:
      return "a text in UTF-16";
    case FileKind::text:
      return "a text";
    case FileKind::binary:
      return "a binary file, not text";
  }
  return "a file";
}

void check_outputs(const std::vector<fs::path>& inputs, const std::vector<Output>& outputs) {
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    if (output->file.empty()) continue;
    for (const fs::path& input : inputs)
      require(input.empty() || !replaces(output->file, input),
              "{} {}: is an input too and would be overwritten; choose another name",
              output->option, output->file.string());
    for (auto other = outputs.begin(); other != output; ++other)
      require(other->file.empty() || !is_same(output->file, other->file),
              "{} {} and {}: are one file: choose another name", output->option,
              output->file.string(), other->option);
    if (output->kind != FileKind::missing) check_name(*output);
    require(output->kind == FileKind::missing || !fs::is_directory(output->file),
            "{} {}: is a folder: name a file in it", output->option, output->file.string());
    const FileKind there = kind_of(output->file);
    require(output->kind == FileKind::missing || there == FileKind::missing ||
                there == FileKind::empty || there == output->kind,
            "{} {}: there is {} of that name, and {} would replace it; choose another name, or "
            "remove it first",
            output->option, output->file.string(), name(there), name(output->kind));
  }
}

}  // namespace stride
