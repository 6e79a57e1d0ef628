#include "extract/pose/weights.h"

#include <array>
#include <cstdlib>
#include <sstream>

#include "extract/io/error.h"
#include "extract/io/outputs.h"

namespace stride::pose {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLandmarks = "pose_landmark_heavy.tflite";
// As setup.sh names it, and as the package does.
constexpr std::array kDetectors{"pose_detection.tflite", "pose_solution_packed_assets.data"};

std::string variable(const char* name, const std::string& otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : otherwise;
}

std::optional<fs::path> detector_in(const fs::path& folder) {
  for (const char* name : kDetectors)
    if (fs::exists(folder / name)) return folder / name;
  return std::nullopt;
}

}  // namespace

std::vector<fs::path> weight_folders() {
  const std::string home = variable("HOME", "");
  std::stringstream places(variable("XDG_DATA_HOME", home.empty() ? "" : home + "/.local/share") +
                           ":" + variable("XDG_DATA_DIRS", "/usr/local/share:/usr/share"));
  std::vector<fs::path> folders;
  for (std::string place; std::getline(places, place, ':');)
    if (!place.empty()) folders.push_back(fs::path(place) / "stride" / "pose");
  return folders;
}

std::optional<Weights> installed_weights() {
  for (const fs::path& folder : weight_folders())
    if (const auto detector = detector_in(folder); detector && fs::exists(folder / kLandmarks))
      return Weights{folder / kLandmarks, *detector};
  return std::nullopt;
}

Weights weights_at(const fs::path& landmarks) {
  require(fs::exists(landmarks), "{}: no such file; {}", landmarks.string(),
          how_to_install_weights());
  const FileKind kind = kind_of(landmarks);
  require(kind == FileKind::tflite, "{}: is {}, a pose network (.tflite, or .onnx) is needed; {}",
          landmarks.string(), name(kind), how_to_install_weights());
  const auto detector = detector_in(landmarks.parent_path());
  require(detector.has_value(), "{}: the detector, {}, must lie beside it; {}", landmarks.string(),
          kDetectors[0], how_to_install_weights());
  return {landmarks, *detector};
}

std::string how_to_install_weights() {
  return "./setup.sh --pose fetches the pose network that finds the joints without clicks";
}

}  // namespace stride::pose
