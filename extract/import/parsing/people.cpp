#include "extract/import/parsing/people.h"

#include <fmt/ranges.h>

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

/// Whether anybody else is seen between two frames, both included.
bool is_alone(const std::vector<Track>& tracks, const Track& a, const Track& b) {
  const int from = a.seen.back()->frame, to = b.seen.front()->frame;
  return std::ranges::none_of(tracks, [&](const Track& other) {
    return &other != &a && &other != &b && std::ranges::any_of(other.seen, [&](const auto* person) {
      return person->frame >= from && person->frame <= to;
    });
  });
}

/// Somebody who is lost while nobody else is there, and is about as large, is the same afterwards.
void join_the_lost(std::vector<Track>& tracks) {
  constexpr double kAlike = 1.6;  // ratio of heights
  std::ranges::sort(tracks, {}, [](const Track& track) { return track.seen.front()->frame; });
  for (std::size_t i = 0; i < tracks.size(); ++i)
    for (std::size_t j = i + 1; j < tracks.size(); ++j) {
      Track &a = tracks[i], &b = tracks[j];
      const double ratio = median(a.heights_px) / median(b.heights_px);
      if (b.seen.front()->frame <= a.seen.back()->frame || ratio > kAlike || ratio < 1 / kAlike ||
          !is_alone(tracks, a, b))
        continue;
      a.seen.insert(a.seen.end(), b.seen.begin(), b.seen.end());
      a.heights_px.insert(a.heights_px.end(), b.heights_px.begin(), b.heights_px.end());
      tracks.erase(tracks.begin() + static_cast<std::ptrdiff_t>(j));
      j = i;
    }
}

struct Joined {
  std::vector<Track> tracks;  // largest sustained first
  int twice = 0;              // how often somebody was there twice on a frame
};
Joined join(const DetectedPeople& people) {
  Joined joined;
  std::vector<Track>& tracks = joined.tracks;
  for (const DetectedPerson& person : people) {
    if (!has_points(person)) continue;
    const double least = person.width_px == 1 ? 1e-3 : 1;  // a share of the picture, or px
    const double height_px = std::max(box(person.points).sizes().y(), least);
    Track* track = continued(tracks, person, height_px);
    if (!track && std::ranges::any_of(tracks, [&](const Track& t) {
          return !person.id.empty() && t.id == person.id;
        })) {
      ++joined.twice;  // the first counts
      continue;
    }
    if (!track) track = &tracks.emplace_back(Track{person.id, {}, {}});
    track->seen.push_back(&person);
    track->heights_px.push_back(height_px);
  }
  join_the_lost(tracks);
  std::ranges::stable_sort(tracks, std::ranges::greater(), &Track::weight);
  return joined;
}

ImportedPerson summary(const Track& track) {
  return {track.seen.front()->frame, track.seen.back()->frame,
          static_cast<int>(track.heights_px.size()), median(track.heights_px)};
}

/// Takes away what is no point: missing ones as files spell them, and those that are not sure.
void clean(DetectedPeople& people, const ImportOptions& options) {
  double most = 0;
  for (const DetectedPerson& person : people)
    for (const Point& point : person.points)
      if (point.present()) most = std::max(most, point.confidence);
  const double percent = most > 1.5 && most <= 100 ? 0.01 : 1;
  for (DetectedPerson& person : people)
    for (Point& point : person.points) {
      const bool is_missing = point.p_px.isZero(0) || point.p_px == Eigen::Vector2d(-1, -1);
      point.confidence *= percent;
      if (!point.present() || is_missing || !(point.confidence > 0) ||
          point.confidence < options.min_confidence)
        point = {};
      point.confidence = std::clamp(point.confidence, 0.0, 1.0);
      // Files of hand-made points have no confidence or 1.
      if (point.present())
        point.source = point.confidence == 1 ? Source::clicked : Source::detected;
      if (options.y_up_height_px > 0) point.p_px.y() = options.y_up_height_px - 1 - point.p_px.y();
    }
}

/// Which labels were not understood, where that leaves a part without points.
std::string about_labels(const ImportedFile& content, const Detections& detections) {
  std::vector<std::string_view> missing;
  for (const BodyPart part : kRequiredParts)
    if (std::ranges::none_of(detections.frames,
                             [&](const ImportedFrame& frame) { return frame[part].present(); }))
      missing.push_back(name(part));
  if (missing.empty()) return {};
  const std::string unused = content.unused_labels.empty()
                                 ? std::string()
                                 : fmt::format(
                                       "; labels not used: {} (say which is which with "
                                       "--labels {}={})",
                                       fmt::join(content.unused_labels, ", "), missing.front(),
                                       content.unused_labels.front());
  return fmt::format("not found: {} (needed){}", fmt::join(missing, ", "), unused);
}

}  // namespace

Detections take_person(ImportedFile content, const ImportOptions& options,
                       const std::string& file) {
  DetectedPeople& people = content.people;
  clean(people, options);
  std::ranges::stable_sort(people, {}, &DetectedPerson::frame);
  const Joined joined = join(people);
  const std::vector<Track>& tracks = joined.tracks;
  require(!tracks.empty(), "{}: holds nobody: expected at least one frame with a body part", file);
  require(options.person >= 0 && options.person <= static_cast<int>(tracks.size()),
          "person = {}: {} holds {} (1 is the largest sustained)", options.person, file,
          tracks.size());

  Detections detections;
  detections.file = file;
  detections.video = content.video;
  detections.video_sha256 = content.video_sha256;
  detections.warnings = content.warnings;
  for (const Track& track : tracks) detections.people.push_back(summary(track));
  detections.person = std::max(options.person, 1);
  for (const DetectedPerson* person : tracks[static_cast<std::size_t>(detections.person - 1)].seen)
    detections.frames.push_back(
        {person->frame, person->points, person->width_px, person->height_px});
  if (joined.twice > 0)
    detections.warnings.push_back(
        fmt::format("somebody is on a frame twice, {} times: the first counts", joined.twice));
  if (const std::string labels = about_labels(content, detections); !labels.empty())
    detections.warnings.push_back(labels);
  return detections;
}

}  // namespace stride::imports
