#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace stride::pose {

/// How the numbers that come out of a network are read (decode.h).
enum class PoseDecoder { heatmap, simcc, yolo_pose };

/// What a pose model's file does not say: the TOML beside it (extract/pose/README.md).
struct PoseSidecar {
  std::string file;  // for error messages
  PoseDecoder decoder = PoseDecoder::heatmap;
  std::vector<std::string> outputs;          // by name; empty: the only one
  std::vector<std::string> keypoints;        // in the network's order
  std::map<std::string, std::string> parts;  // our part → keypoint, where the name does not tell
  double min_confidence = 0.3;               // below it a point, or a person, is absent
  double offset_px = 0;                      // input px of the place that the network calls 0

  int width_px = 0, height_px = 0;  // of the input
  bool rgb = true;
  std::array<double, 3> mean{0, 0, 0}, std{255, 255, 255};  // of levels 0 to 255, in that order
  double border = 0;                                        // level around the picture
  double padding = 1.25;                                    // size of the crop over that of the box

  std::vector<double> check_values;  // see self_check_input()
  double check_tolerance = 1e-3;
};

/// Throws Error naming the file, the key, the value and what was expected.
PoseSidecar load_pose_sidecar(const std::filesystem::path& file);

}  // namespace stride::pose
