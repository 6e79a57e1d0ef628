#include "extract/commands/detection_options.h"

#include <CLI/CLI.hpp>
#include <cmath>

#include "extract/io/error.h"
#include "extract/io/option_range.h"
#include "extract/skeleton/body_part.h"

namespace stride {
namespace {

void add_import_options(CLI::App& command, imports::ImportOptions& options) {
  command
      .add_option("--format", options.format, "Format of the imported file, if not told from it")
      ->check(CLI::IsMember(imports::import_formats()));
  command
      .add_option("--person", options.person,
                  "Which person of the imported file: 1 the largest sustained, 2 the next, …")
      ->check(in_range(1, 1000));
  command
      .add_option("--min-confidence", options.min_confidence,
                  "Imported points below this count as absent")
      ->check(in_range(0, 1))
      ->capture_default_str();
  command
      .add_option_function<std::vector<std::string>>(
          "--labels",
          [&options](const std::vector<std::string>& pairs) {
            for (const std::string& pair : pairs) {
              const auto equals = pair.find('=');
              require(equals != std::string::npos, "--labels {}: expected PART=LABEL", pair);
              body_part(pair.substr(0, equals));
              options.labels[pair.substr(0, equals)] = pair.substr(equals + 1);
            }
          },
          "Names in the imported file, PART=LABEL,…")
      ->delimiter(',');
  command
      .add_option("--y-up", options.y_up_height_px,
                  "The imported file's y grows upwards; height of the video in px")
      ->check(in_range(1, 100000));
  command
      .add_option_function<double>(
          "--import-rate",
          [&options](double rate_hz) {
            options.rate_hz = rate_hz;
            options.rate_was_given = true;
          },
          "Frame rate of the video in Hz, for files that say times and no frames")
      ->check(in_range(0.1, 100000));
  command
      .add_option("--points-size", options.size_px,
                  "Size of the picture that the points were made on, if not the video's: WIDTH "
                  "HEIGHT")
      ->expected(2)
      ->check(in_range(1, 100000));
  command
      .add_option("--first-frame", options.first_frame,
                  "Number that the imported file gives the video's first frame (default: told from "
                  "the file: 0 or 1)")
      ->check(in_range(-1e6, 1e9));
}

void add_pose_options(CLI::App& command, pose::PoseOptions& options) {
  command
      .add_option_function<std::string>(
          "--pose",
          [&options](const std::string& model) {
            options.wanted = true;
            if (!model.empty() && model != "true") options.model = model;
          },
          "the points of a pose network: of the installed one, corrected by clicks if there are "
          "any, or of MODEL.tflite, or of an .onnx of yours with a .toml beside it")
      ->expected(0, 1);
  command.add_option("--pose-config", options.sidecar,
                     "the model's .toml, if it has another name or place");
  command
      .add_option_function<std::vector<double>>(
          "--pose-box",
          [&options](const std::vector<double>& box) {
            for (const double each : box)
              require(std::abs(each) <= 1e5, "--pose-box: {}: must be a number of px", each);
            require(box[2] > 0 && box[3] > 0, "--pose-box {} {} {} {}: must have a size", box[0],
                    box[1], box[2], box[3]);
            options.box_px = cv::Rect2d(box[0], box[1], box[2], box[3]);
          },
          "where the person is on the first frame, px: X Y WIDTH HEIGHT (default: whole frames)")
      ->expected(4);
}

}  // namespace

void add_detection_options(CLI::App& command, imports::ImportOptions& import,
                           pose::PoseOptions& pose, bool& repair_legs) {
  add_import_options(command, import);
  add_pose_options(command, pose);
  command.add_flag("!--no-leg-repair", repair_legs,
                   "leave right and left of imported points as they are");
}

void require_effect(const CLI::App& command, const std::filesystem::path& import_from,
                    const pose::PoseOptions& pose) {
  const auto require_all = [&](std::initializer_list<const char*> options, bool effect,
                               const char* with) {
    for (const char* option : options)
      require(effect || command.count(option) == 0, "{}: has no effect without {}", option, with);
  };
  require_all({"--format", "--y-up", "--import-rate", "--points-size", "--first-frame"},
              !import_from.empty(), "--import");
  require_all({"--labels", "--min-confidence"}, !import_from.empty() || pose.is_users(),
              "--import, or --pose MODEL.onnx");
  require_all({"--pose-config", "--pose-box"}, pose.is_users(), "--pose MODEL.onnx");
}

}  // namespace stride
