#include "extract/import/parsing/people.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

#include "extract/io/error.h"
#include "extract/io/statistics.h"

namespace stride::imports {
namespace {

/// Somebody not seen for so long is somebody else.
constexpr int kLongestGap = 15;  // frames
/// So far, in body heights a frame missed, may a person have moved.
constexpr double kFarthestMove = 0.25;

using Points = std::array<Point, kBodyPartCount>;

bool has_points(const DetectedPerson& person) {
  return std::ranges::any_of(person.points, &Point::present);
}

Eigen::AlignedBox2d box(const Points& points) {
  Eigen::AlignedBox2d box;
  for (const Point& point : points)
    if (point.present()) box.extend(point.p_px);
  return box;
}

/// Mean over the parts that both have, or between the middles where they have none in common.
double distance_px(const Points& a, const Points& b) {
  double sum = 0;
  int common = 0;
  for (int i = 0; i < kBodyPartCount; ++i) {
    if (!a[i].present() || !b[i].present()) continue;
    sum += (a[i].p_px - b[i].p_px).norm();
    ++common;
  }
  return common > 0 ? sum / common : (box(a).center() - box(b).center()).norm();
}

struct Track {
  std::string id;
  std::vector<const DetectedPerson*> seen;  // growing frame
  std::vector<double> heights_px;

  double weight() const { return std::accumulate(heights_px.begin(), heights_px.end(), 0.0); }
};

/// The track that `person` continues best; null if none.
Track* continued(std::vector<Track>& tracks, const DetectedPerson& person, double height_px) {
  Track* best = nullptr;
  double best_distance = 1;
  for (Track& track : tracks) {
    const int gap = person.frame - track.seen.back()->frame;
    if (!person.id.empty()) {
      if (track.id == person.id) return gap > 0 ? &track : nullptr;
      continue;
    }
    if (!track.id.empty() || gap < 1 || gap > kLongestGap) continue;
    const double size_px = std::max(height_px, std::ranges::max(track.heights_px));
    const double distance =
        distance_px(person.points, track.seen.back()->points) / (kFarthestMove * gap * size_px);
    if (distance < best_distance) {
      best_distance = distance;
      best = &track;
    }
  }
  return best;
}

std::vector<Track> join(const DetectedPeople& people) {
  std::vector<Track> tracks;
  for (const DetectedPerson& person : people) {
    if (!has_points(person)) continue;
    const double height_px = std::max(box(person.points).sizes().y(), 1.0);
    Track* track = continued(tracks, person, height_px);
    if (!track && std::ranges::any_of(tracks, [&](const Track& t) {
          return !person.id.empty() && t.id == person.id;
        }))
      continue;  // the same person twice in one frame: the first counts
    if (!track) track = &tracks.emplace_back(Track{person.id, {}, {}});
    track->seen.push_back(&person);
    track->heights_px.push_back(height_px);
  }
  std::ranges::stable_sort(tracks, std::ranges::greater(), &Track::weight);
  return tracks;
}

ImportedPerson summary(const Track& track) {
  return {track.seen.front()->frame, track.seen.back()->frame,
          static_cast<int>(track.heights_px.size()), median(track.heights_px)};
}

}  // namespace

Detections take_person(DetectedPeople people, const ImportOptions& options,
                       const std::string& file) {
  for (DetectedPerson& person : people)
    for (Point& point : person.points) {
      if (!point.present() || !(point.confidence >= options.min_confidence)) point = {};
      point.confidence = std::clamp(point.confidence, 0.0, 1.0);
    }
  std::ranges::stable_sort(people, {}, &DetectedPerson::frame);
  const std::vector<Track> tracks = join(people);
  require(!tracks.empty(), "{}: holds nobody: expected at least one frame with a body part", file);
  require(options.person >= 0 && options.person <= static_cast<int>(tracks.size()),
          "person = {}: {} holds {} (1 is the largest sustained)", options.person, file,
          tracks.size());

  Detections detections;
  for (const Track& track : tracks) detections.people.push_back(summary(track));
  detections.person = std::max(options.person, 1);
  for (const DetectedPerson* person : tracks[static_cast<std::size_t>(detections.person - 1)].seen)
    detections.frames.push_back({person->frame, person->points});
  return detections;
}

}  // namespace stride::imports
