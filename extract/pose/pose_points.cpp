#include "extract/pose/pose_points.h"

#include <fmt/format.h>

#include <algorithm>

#include "extract/import/formats/formats.h"
#include "extract/import/parsing/labels.h"
#include "extract/import/parsing/people.h"
#include "extract/io/error.h"
#include "extract/pose/network.h"
#include "extract/pose/network_points.h"
#include "extract/video/video.h"

namespace stride::pose {
namespace {

/// The points that the network is sure of.
std::vector<Point> points_of(const PosePerson& person, double min_confidence) {
  std::vector<Point> points(person.keypoints.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    if (const Keypoint& keypoint = person.keypoints[k]; keypoint.confidence >= min_confidence)
      points[k] = {keypoint.p_px, Source::detected, keypoint.confidence};
  return points;
}

/// Moves the box onto the middle of the points' extent. Its size stays, since limbs that are bent
/// or not found make nobody smaller.
void move_to(const std::vector<Point>& points, cv::Rect2d& box) {
  constexpr int kFewest = 3;
  int seen = 0;
  Eigen::Array2d low = Eigen::Array2d::Constant(1e9), high = -low;
  for (const Point& point : points) {
    if (!point.present()) continue;
    ++seen;
    low = low.min(point.p_px.array());
    high = high.max(point.p_px.array());
  }
  if (seen < kFewest) return;
  box.x = (low.x() + high.x() - box.width) / 2;
  box.y = (low.y() + high.y() - box.height) / 2;
}

cv::Rect2d grown(const cv::Rect2d& box, double factor) {
  return {box.x - (factor - 1) / 2 * box.width, box.y - (factor - 1) / 2 * box.height,
          factor * box.width, factor * box.height};
}

}  // namespace

imports::Detections pose_points(const std::filesystem::path& video, const PoseOptions& pose,
                                const imports::ImportOptions& options) {
  if (!pose.is_users()) {
    NetworkOptions network;
    network.landmarks = pose.model;
    network.person = options.person;
    return network_points(video, network).detections;
  }
  const std::filesystem::path sidecar_file =
      pose.sidecar.empty() ? std::filesystem::path(pose.model).replace_extension(".toml")
                           : pose.sidecar;
  require(std::filesystem::exists(sidecar_file),
          "{}: no such file; it tells how {} is used (extract/pose/README.md)",
          sidecar_file.string(), pose.model.string());
  const PoseSidecar sidecar = load_pose_sidecar(sidecar_file);
  std::map<std::string, std::string> labels = options.labels;
  labels.insert(sidecar.parts.begin(), sidecar.parts.end());
  const imports::LabelMap map(sidecar.keypoints, labels, sidecar_file.string());
  PoseNetwork network(pose.model, sidecar);

  video::Video frames(video);
  const cv::Rect2d whole(-0.5, -0.5, frames.info().width_px, frames.info().height_px);
  std::optional<cv::Rect2d> box = pose.box_px;
  imports::ImportedFile content;
  for (video::VideoFrame frame; frames.read(frame);) {
    const std::vector<PosePerson> found =
        network.find(frame.image, box ? grown(*box, sidecar.padding) : whole);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const std::vector<Point> points = points_of(found[i], sidecar.min_confidence);
      if (i == 0 && box) move_to(points, *box);
      imports::DetectedPerson person{frame.index, "", map.parts(points)};
      if (std::ranges::any_of(person.points, &Point::present)) content.people.push_back(person);
    }
  }
  require(!content.people.empty(),
          "{}: finds nobody in {}; is it the picture's colour order or scale? {}",
          pose.model.string(), video.string(), sidecar_file.string());
  imports::Detections detections =
      imports::take_person(std::move(content), options, pose.model.string());
  detections.format = "pose";
  return detections;
}

}  // namespace stride::pose
