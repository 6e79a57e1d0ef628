#include "extract/pose/sidecar.h"

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "extract/io/error.h"
#include "extract/io/toml.h"
#include "extract/skeleton/body_part.h"

namespace stride::pose {
namespace {

constexpr std::size_t kFewestCheckValues = 16;

struct Setting {
  const std::string& file;
  std::string key;
  std::vector<std::string> values;

  [[noreturn]] void fail(std::string_view expected) const {
    throw Error(fmt::format("{}: {} = {}: must be {}", file, key,
                            values.size() == 1 ? values[0] : fmt::format("{}", values), expected));
  }
  const std::string& text(std::string_view expected) const {
    if (values.size() != 1 || values[0].empty()) fail(expected);
    return values[0];
  }
  std::vector<double> numbers(std::string_view expected) const {
    std::vector<double> numbers;
    for (const std::string& value : values) {
      double number = 0;
      if (!CLI::detail::lexical_cast(value, number) || !std::isfinite(number)) fail(expected);
      numbers.push_back(number);
    }
    return numbers;
  }
  double number(double least, double most, std::string_view expected) const {
    const std::vector<double> given = numbers(expected);
    if (given.size() != 1 || !(given[0] >= least && given[0] <= most)) fail(expected);
    return given[0];
  }
  std::array<double, 3> three(double least, std::string_view expected) const {
    const std::vector<double> given = numbers(expected);
    if (given.size() != 3) fail(expected);
    for (const double number : given)
      if (!(number >= least)) fail(expected);
    return {given[0], given[1], given[2]};
  }
};

PoseDecoder decoder_of(const Setting& setting) {
  constexpr const char* kExpected = "heatmap, simcc or yolo-pose";
  const std::string& name = setting.text(kExpected);
  if (name == "heatmap") return PoseDecoder::heatmap;
  if (name == "simcc") return PoseDecoder::simcc;
  if (name == "yolo-pose") return PoseDecoder::yolo_pose;
  setting.fail(kExpected);
}

void apply(const Setting& setting, PoseSidecar& s) {
  const std::string& key = setting.key;
  if (key == "decoder") {
    s.decoder = decoder_of(setting);
  } else if (key == "outputs") {
    s.outputs = setting.values;
  } else if (key == "keypoints") {
    s.keypoints = setting.values;
  } else if (key == "min-confidence") {
    s.min_confidence = setting.number(0, 1, "from 0 to 1");
  } else if (key == "offset") {
    s.offset_px = setting.number(-1e3, 1e3, "a number of pixels of the input");
  } else if (key == "input.width" || key == "input.height") {
    (key == "input.width" ? s.width_px : s.height_px) =
        static_cast<int>(setting.number(1, 4096, "a number of pixels, 1 to 4096"));
  } else if (key == "input.colour") {
    const std::string& order = setting.text("rgb or bgr");
    if (order != "rgb" && order != "bgr") setting.fail("rgb or bgr");
    s.rgb = order == "rgb";
  } else if (key == "input.mean") {
    s.mean = setting.three(-1e6, "three levels of 0 to 255, in the order of input.colour");
  } else if (key == "input.std") {
    s.std = setting.three(1e-6, "three levels above 0, in the order of input.colour");
  } else if (key == "input.border") {
    s.border = setting.number(0, 255, "a level from 0 to 255");
  } else if (key == "input.padding") {
    s.padding = setting.number(0.1, 10, "a factor from 0.1 to 10");
  } else if (key == "self-check.values") {
    s.check_values = setting.numbers("numbers");
  } else if (key == "self-check.tolerance") {
    s.check_tolerance = setting.number(0, 1e3, "the largest difference, 0 or more");
  } else if (key.starts_with("parts.")) {
    const std::string part = key.substr(6);
    body_part(part);
    s.parts[part] = setting.text("the name of a keypoint");
  } else {
    throw Error(fmt::format(
        "{}: key '{}' is not known; use decoder, outputs, keypoints, min-confidence, offset, "
        "[input] width, height, colour, mean, std, border, padding, [self-check] values, "
        "tolerance, [parts]",
        s.file, key));
  }
}

void check(const PoseSidecar& s) {
  require(!s.keypoints.empty(),
          "{}: keypoints is missing: name the network's points in its order, as in keypoints = "
          "[\"nose\", \"knee_r\"]",
          s.file);
  require(s.width_px > 0 && s.height_px > 0,
          "{}: [input] width and height are missing: the size in pixels that the network takes",
          s.file);
  require(s.outputs.size() <= 2 && (s.decoder != PoseDecoder::simcc || s.outputs.size() == 2),
          "{}: outputs = {}: simcc needs the names of two outputs, x first; the other decoders one",
          s.file, s.outputs);
  require(s.check_values.size() >= kFewestCheckValues,
          "{}: [self-check] values has {} numbers: give at least {}, made by another program than "
          "OpenCV (extract/pose/README.md); OpenCV reads some networks wrongly without saying so",
          s.file, s.check_values.size(), kFewestCheckValues);
  const auto [least, most] = std::ranges::minmax(s.check_values);
  require(most - least > 10 * s.check_tolerance,
          "{}: [self-check] values lie between {} and {}: with a tolerance of {} they would prove "
          "nothing; give more of them, or a smaller tolerance",
          s.file, least, most, s.check_tolerance);
}

}  // namespace

PoseSidecar load_pose_sidecar(const std::filesystem::path& file) {
  PoseSidecar sidecar;
  sidecar.file = file.string();
  for (const TomlSetting& setting : load_toml(file))
    apply({sidecar.file, setting.key(), setting.words}, sidecar);
  check(sidecar);
  return sidecar;
}

}  // namespace stride::pose
