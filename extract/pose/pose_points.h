#pragma once

#include <filesystem>
#include <opencv2/core/types.hpp>
#include <optional>

#include "extract/import/import.h"

namespace stride::pose {

/// A pose model instead of clicks.
struct PoseOptions {
  bool wanted = false;
  std::filesystem::path model;  // .onnx of the user's, or BlazePose's .tflite; empty: as installed
  std::filesystem::path sidecar;  // empty: the model's name with .toml
  /// Where the person is on the first frame. The box then follows the points; without one the
  /// network is shown the whole frame.
  std::optional<cv::Rect2d> box_px;

  bool is_users() const { return model.extension() == ".onnx"; }
};

/// The points of one person on every frame of a video, as import_points() gives those of a file;
/// `options` chooses the person. Throws Error as Video does, and as extract/pose/sidecar.h and
/// network.h or network_points.h say.
imports::Detections pose_points(const std::filesystem::path& video, const PoseOptions& pose,
                                const imports::ImportOptions& options = imports::ImportOptions());

/// Adds --pose, --pose-config and --pose-box to a command.
void add_pose_options(CLI::App& command, PoseOptions& options);

}  // namespace stride::pose
