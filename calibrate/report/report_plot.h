#pragma once

// What the pictures of both reports share: data blocks, style and the strip of frames. gnuplot
// draws them from data in the script.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/calibrate.h"

namespace stride::report {

inline constexpr int kWidth_px = 1100, kHeight_px = 1180;
// The strip of frames in the picture.
inline constexpr int kStripLeft_px = 20, kStripTop_px = 42, kStrip_px = 1060, kStripHeight_px = 196;

/// The parts whose paths are drawn: knees, ankles and toes.
inline constexpr auto kTraced = parts_where<[](const BodyPartRow& each) {
  return each.side && each.prompt == Prompt::always;
}>();

/// A block of data of a gnuplot script.
class DataBlock {
 public:
  explicit DataBlock(const std::string& name) : text_(fmt::format("${} << EOD\n", name)) {}
  template <typename... Numbers>
  void row(Numbers... numbers) {
    ((text_ += std::isnan(static_cast<double>(numbers))
                   ? "? "
                   : fmt::format("{:.6g} ", static_cast<double>(numbers))),
     ...);
    text_ += "\n";
  }
  void gap() { text_ += "\n"; }
  std::string end() { return text_ + "EOD\n"; }

 private:
  std::string text_;
};

/// Labels on the page, as commands of gnuplot.
class Labels {
 public:
  void title(const std::string& text, const std::string& aside);
  /// Below a frame of the strip on a picture of that height.
  void below_frame(int k, const std::string& text, int height_px);
  const std::string& text() const { return script_; }

 private:
  void write(const std::string& text, double x, double y, const char* how);
  std::string script_;
  int count_ = 0;
};

/// Terminal, lines, borders; begins a multiplot.
std::string page_style(int height_px);

/// The picture with the strip of those frames of the trajectory; as it is where `video` is empty.
std::string with_strip(std::string svg, const std::filesystem::path& video,
                       const Trajectory& trajectory, const SagittalModel& model,
                       const Calibration& calibration, const std::vector<int>& frames);

/// The picture of a movement that does not repeat; see draw_report.
void draw_passage(const Trajectory& trajectory, const SagittalModel& model,
                  const Calibration& calibration, const std::filesystem::path& video,
                  const std::filesystem::path& file);

}  // namespace stride::report
