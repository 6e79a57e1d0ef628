#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stride {

/// What a file is, told from its first bytes and never from its name.
enum class FileKind {
  missing,  // or a folder, a device, …
  empty,
  keypoints,
  trajectory,
  calibrated,
  table,  // any other `# stride …` table
  potential,
  report,       // NAME.report.txt
  points_json,  // stride track --export
  points_csv,   // likewise: frame,time_s,…
  plot_data,
  gnuplot_script,
  motion,  // OpenSim's .mot and .sto
  trc,
  svg,
  page,  // stride report
  image,
  video,
  zip,
  hdf5,
  pickle,
  matlab,
  numpy,
  c3d,
  safetensors,
  tflite,
  onnx,
  kinovea_xml,
  xml,
  json,
  utf16,
  text,
  binary,
  unreadable
};

FileKind kind_of(const std::filesystem::path& file);
/// The same from the first bytes, some thousand of them if there are so many.
FileKind kind_of_content(std::string_view head);

/// Whether it holds no text.
bool is_binary(FileKind kind);

bool is_json(FileKind kind);

/// Throws Error, "FILE: is a video, WHAT is needed", if the file is binary, JSON or XML.
void require_plain_text(const std::filesystem::path& file, std::string_view what);

/// For a person: "a video", "a zip archive or an Excel workbook", …
std::string_view name(FileKind kind);

/// A file that a command is about to write.
struct Output {
  std::string option;  // that named it, for the error message: "--overlay", "-o"
  std::filesystem::path file;
  FileKind kind;  // that is written; FileKind::missing: whatever `file` is
};

/// To be called before a command does anything: nothing that a user has may be lost. Throws Error
/// if an output is one of the inputs (by whatever name), lies in the way of another output, or
/// would replace an existing file that is not of its kind, or has a name that cannot be written.
/// Empty paths are left out; an input may be a folder, whose files are then inputs.
void check_outputs(const std::vector<std::filesystem::path>& inputs,
                   const std::vector<Output>& outputs);

}  // namespace stride
