#include "extract/commands/detection_options.h"

#include <CLI/CLI.hpp>

#include "extract/io/error.h"
#include "extract/skeleton/body_part.h"

namespace stride {

void add_import_options(CLI::App& command, imports::ImportOptions& options) {
  command
      .add_option("--format", options.format, "Format of the imported file, if not told from it")
      ->check(CLI::IsMember(imports::import_formats()));
  command.add_option("--person", options.person,
                     "Which person of the imported file: 1 the largest sustained, 2 the next, …");
  command.add_option("--min-confidence", options.min_confidence,
                     "Imported points below this count as absent");
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
  command.add_option("--y-up", options.y_up_height_px,
                     "The imported file's y grows upwards; height of the video in px");
  command.add_option("--import-rate", options.rate_hz,
                     "Frame rate of the video in Hz, for files that say times and no frames");
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
            require(box[2] > 0 && box[3] > 0, "--pose-box {} {} {} {}: must have a size", box[0],
                    box[1], box[2], box[3]);
            options.box_px = cv::Rect2d(box[0], box[1], box[2], box[3]);
          },
          "where the person is on the first frame, px: X Y WIDTH HEIGHT (default: whole frames)")
      ->expected(4);
}

}  // namespace stride
