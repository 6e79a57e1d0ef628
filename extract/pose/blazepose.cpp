#include "extract/pose/blazepose.h"

#include <algorithm>
#include <cmath>

#include "extract/pose/load_network.h"

namespace stride::pose {

using Eigen::Vector2d;

namespace {

constexpr int kDetectorSide = 224, kLandmarkSide = 256;
constexpr int kAnchors = 2254, kBoxNumbers = 12;
constexpr int kMaps = 39, kMapSide = 64, kMapReach = 3;  // cells around the regressed place
constexpr int kCentre = 33, kAbove = 34;                 // after the 33 of the body
constexpr double kLeastPeak = 0.5;                       // of the heat map of a point
constexpr double kLeastScore = 0.4;                      // of somebody; empty pictures reach 0.26

double sigmoid(double x) { return 1 / (1 + std::exp(-x)); }

const std::vector<SelfCheck>& detector_checks() {
  static const std::vector<SelfCheck> checks{
      {{"Identity", {1, kAnchors, kBoxNumbers}, {-0.5059204, -6.244782, 2.1181562, -4.1782207}},
       {"Identity_1", {1, kAnchors, 1}, {-76.66633, -6.2204776, -101.36422}}}};
  return checks;
}

SelfCheck landmark_check(std::vector<double> first, double flag) {
  return {{"Identity", {1, 3 * 65}, std::move(first)},
          {"Identity_1", {1, 1}, {flag}},
          {"Identity_3", {1, kMapSide, kMapSide, kMaps}, {}}};
}

const std::vector<SelfCheck>& landmark_checks() {
  static const std::vector<SelfCheck> checks{
      landmark_check({130.77206, 67.012314, -38.667, -11.325663, -10.702575, 132.43755},
                     0.00072658),
      landmark_check({138.46022, 37.401897, -18.2258, -2.2298098, -5.467709, 136.76913},
                     0.00728686),
      landmark_check({116.75624, 31.841599, -36.77231, 2.7895386, 0.9500404, 119.70329}, 0)};
  return checks;
}

/// Middles of the cells of three grids over the input, each cell as often as it has boxes.
std::vector<Vector2d> anchors() {
  std::vector<Vector2d> anchors;
  for (const auto& [cells, boxes] : {std::pair(28, 2), std::pair(14, 2), std::pair(7, 6)})
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x)
        for (int box = 0; box < boxes; ++box)
          anchors.emplace_back((x + 0.5) / cells, (y + 0.5) / cells);
  return anchors;
}

/// Place and spread of a heat map of logits around a place, in cells.
struct Heat {
  Vector2d centre;
  double peak = 0, width = 0;
};
Heat heat_around(const float* logits, const Vector2d& at) {
  const int x0 = static_cast<int>(std::floor(at.x())), y0 = static_cast<int>(std::floor(at.y()));
  Heat heat{at};
  double sum = 0, squared = 0;
  Vector2d moment = Vector2d::Zero();
  for (int y = std::max(y0 - kMapReach, 0); y <= std::min(y0 + kMapReach, kMapSide - 1); ++y)
    for (int x = std::max(x0 - kMapReach, 0); x <= std::min(x0 + kMapReach, kMapSide - 1); ++x) {
      const double p = sigmoid(logits[y * kMapSide + x]);
      const Vector2d cell(x, y);
      heat.peak = std::max(heat.peak, p);
      sum += p;
      moment += p * cell;
      squared += p * cell.squaredNorm();
    }
  if (sum <= 0) return heat;
  heat.centre = moment / sum;
  heat.width = std::sqrt(std::max(0.0, squared / sum - heat.centre.squaredNorm()) / 2);
  return heat;
}

Vector2d place(const float* row) { return {row[0], row[1]}; }

}  // namespace

PersonDetector::PersonDetector(const std::filesystem::path& file)
    : net_(load_network(file, kDetectorSide, detector_checks())), anchors_(anchors()) {}

std::vector<Candidate> PersonDetector::find(const cv::Mat& bgr, const Crop& region) {
  net_.setInput(shown(bgr, region, kDetectorSide, -1, 1));
  std::vector<cv::Mat> outputs;
  net_.forward(outputs, std::vector<std::string>{"Identity", "Identity_1"});
  std::vector<Candidate> found;
  for (std::size_t i = 0; i < anchors_.size(); ++i) {
    const double score = sigmoid(outputs[1].ptr<float>()[i]);
    if (score < kLeastScore) continue;
    const float* box = outputs[0].ptr<float>() + kBoxNumbers * i;
    const auto keypoint = [&](int k) {
      return region.in_image(place(box + 4 + 2 * k) / kDetectorSide + anchors_[i]);
    };
    found.push_back({crop_of_person(keypoint(0), keypoint(1)), score});
  }
  std::ranges::sort(found, std::ranges::greater(), &Candidate::score);
  std::vector<Candidate> people;
  for (const Candidate& candidate : found)
    if (std::ranges::none_of(people, [&](const Candidate& p) {
          return (p.crop.centre_px - candidate.crop.centre_px).norm() < 0.25 * p.crop.size_px;
        }))
      people.push_back(candidate);
  return people;
}

LandmarkNetwork::LandmarkNetwork(const std::filesystem::path& file)
    : net_(load_network(file, kLandmarkSide, landmark_checks())) {}

PoseLandmarks LandmarkNetwork::look(const cv::Mat& bgr, const Crop& crop) {
  net_.setInput(shown(bgr, crop, kLandmarkSide, 0, 1));
  std::vector<cv::Mat> outputs;
  net_.forward(outputs, std::vector<std::string>{"Identity", "Identity_1", "Identity_3"});
  const auto in_image = [&](const Vector2d& p) -> Vector2d {
    return crop.in_image(p / kLandmarkSide);
  };
  constexpr double kCell_px = static_cast<double>(kLandmarkSide) / kMapSide;
  PoseLandmarks body;
  body.presence = outputs[1].ptr<float>()[0];
  for (int k = 0; k < kLandmarks; ++k) {
    const float* row = outputs[0].ptr<float>() + 5 * k;
    Landmark& landmark = body.landmarks[static_cast<std::size_t>(k)];
    landmark.visibility = std::min(sigmoid(row[3]), sigmoid(row[4]));
    landmark.regressed_px = landmark.p_px = in_image(place(row));
    const Heat heat = heat_around(outputs[2].ptr<float>(0, k), place(row) / kCell_px);
    landmark.peak = heat.peak;
    landmark.width_px = heat.width * kCell_px * crop.size_px / kLandmarkSide;
    if (heat.peak >= kLeastPeak) landmark.p_px = in_image(heat.centre * kCell_px);
  }
  const auto regressed = [&](int k) { return in_image(place(outputs[0].ptr<float>() + 5 * k)); };
  body.next = crop_of_person(regressed(kCentre), regressed(kAbove));
  return body;
}

}  // namespace stride::pose
