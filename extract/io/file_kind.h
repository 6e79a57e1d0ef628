#pragma once

#include <filesystem>
#include <string_view>

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
  image,
  video,
  zip,
  hdf5,
  pickle,
  matlab,
  numpy,
  c3d,
  kinovea_xml,
  xml,
  json,
  utf16,
  text,
  binary
};

FileKind kind_of(const std::filesystem::path& file);
/// The same from the first bytes, some thousand of them if there are so many.
FileKind kind_of_content(std::string_view head);

/// Whether it holds no text.
bool is_binary(FileKind kind);

/// For a person: "a video", "a zip archive or an Excel workbook", …
std::string_view name(FileKind kind);

}  // namespace stride
