#include "extract/pose/follow.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <limits>
#include <mutex>
#include <set>

namespace stride::pose {

using Eigen::Vector2d;

namespace {

constexpr double kPresent = 0.5;  // presence of a body that was found
// Of the hips' middle from where it was expected, in crops; the first time before any speed is
// known.
constexpr double kFarthestJump = 0.15, kFirstJump = 0.3;
constexpr double kMostLenience = 2;  // of that, after frames on which nobody was seen
constexpr double kFarthestGrowth = 1.5;
constexpr double kSamePerson = 0.25;             // crops between two detections of one person
constexpr double kApart = 0.5, kTogether = 0.3;  // feet, in leg lengths
constexpr std::size_t kHipL = 23, kHipR = 24, kAnkleL = 27, kAnkleR = 28;

/// Somebody on a sampled frame.
struct Detection {
  int frame = 0;
  PoseLandmarks body;
  double quality = 0;
};

Vector2d hips(const PoseLandmarks& body) {
  return (body.landmarks[kHipL].p_px + body.landmarks[kHipR].p_px) / 2;
}

bool inside(const Vector2d& p, const cv::Mat& image) {
  return p.x() > -0.5 && p.y() > -0.5 && p.x() < image.cols - 0.5 && p.y() < image.rows - 0.5;
}

/// Squares as high as a wide picture, side by side: there small people are larger than in the
/// whole.
std::vector<Crop> tiles(const cv::Mat& image) {
  const int side = std::min(image.cols, image.rows), rest = std::max(image.cols, image.rows) - side;
  const int steps = (2 * rest + side - 1) / side;
  std::vector<Crop> tiles;
  for (int i = 0; i <= steps; ++i) {
    const double along = (side - 1) / 2.0 + static_cast<double>(rest) * i / std::max(steps, 1),
                 across = (side - 1) / 2.0;
    const bool wide = image.cols > image.rows;
    tiles.push_back(
        {wide ? Vector2d(along, across) : Vector2d(across, along), static_cast<double>(side), 0});
  }
  return tiles;
}

/// Whom the detector sees in the regions of a frame, as the landmarks see them.
void add_detections(const cv::Mat& image, int frame, const std::vector<Crop>& regions,
                    Viewer& viewer, std::vector<Detection>& detections) {
  for (const Crop& region : regions)
    for (const Candidate& candidate : viewer.find(image, region)) {
      const PoseLandmarks body = viewer.look(image, candidate.crop);
      if (body.presence >= kPresent)
        detections.push_back({frame, body, candidate.score * body.presence});
    }
}

std::vector<Detection> detections_of(const Frames& frames, Viewer& viewer, int sampled) {
  std::set<int> numbers;
  for (int i = 0; i < sampled; ++i)
    numbers.insert(static_cast<int>((i + 0.5) * frames.count / sampled));
  std::vector<Detection> detections;
  for (const int frame : numbers) {
    const cv::Mat image = frames.image(frame);
    add_detections(image, frame, {crop_of_image(image)}, viewer, detections);
  }
  if (detections.empty())
    for (const int frame : numbers) {
      const cv::Mat image = frames.image(frame);
      add_detections(image, frame, tiles(image), viewer, detections);
    }
  std::ranges::stable_sort(detections, std::ranges::greater(), &Detection::quality);
  return detections;
}

/// Where a person was lately, and is expected next.
struct Path {
  Crop crop;
  Vector2d step_px = Vector2d::Zero();
  int missed = 0;  // frames since
  bool speed_is_known = false;

  Crop expected() const {
    Crop next = crop;
    next.centre_px += (missed + 1) * step_px;
    return next;
  }
  void add(const Crop& seen) {
    step_px = (seen.centre_px - crop.centre_px) / (missed + 1);
    crop = seen;
    missed = 0;
    speed_is_known = true;
  }
};

bool continues(const Path& path, const PoseLandmarks& body) {
  const Crop expected = path.expected();
  const double reach = (path.speed_is_known ? kFarthestJump : kFirstJump) *
                       std::min(1 + 0.2 * path.missed, kMostLenience) * expected.size_px;
  const double growth = body.next.size_px / expected.size_px;
  return body.presence >= kPresent && (hips(body) - expected.centre_px).norm() < reach &&
         growth < kFarthestGrowth && growth > 1 / kFarthestGrowth;
}

/// The person of a path on a frame, by the landmarks or, where they fail, by the detector near by.
std::optional<PoseLandmarks> seen_on(const cv::Mat& image, const Path& path, Viewer& viewer) {
  const Crop expected = path.expected();
  if (path.missed == 0) {
    PoseLandmarks body = viewer.look(image, expected);
    if (continues(path, body)) return body;
  }
  Crop around = expected;
  around.size_px *= 2;
  around.angle_rad = 0;
  for (const Candidate& candidate : viewer.find(image, around)) {
    PoseLandmarks body = viewer.look(image, candidate.crop);
    if (continues(path, body)) return body;
  }
  return std::nullopt;
}

/// Follows from the frame after `from` to the last one (step 1), or back to the first (−1).
void follow(const Frames& frames, const Detection& from, int step, Viewer& viewer,
            std::vector<std::optional<PoseLandmarks>>& bodies,
            const std::function<void()>& looked) {
  Path path{from.body.next};
  for (int frame = from.frame + step; frame >= 0 && frame < frames.count; frame += step) {
    const cv::Mat image = frames.image(frame);
    if (!inside(path.expected().centre_px, image)) return;
    const std::optional<PoseLandmarks> body = seen_on(image, path, viewer);
    if (body) {
      path.add(body->next);
      bodies[static_cast<std::size_t>(frame)] = body;
    } else {
      ++path.missed;
    }
    looked();
  }
}

/// Frames on which the feet went apart along the image's x after they had been together, whichever
/// is called left. Who stands with the feet apart makes no steps.
std::vector<int> steps_of(const FollowedPerson& person) {
  std::vector<int> steps;
  bool apart = false;
  for (std::size_t i = 0; i < person.frames.size(); ++i) {
    const std::optional<PoseLandmarks>& body = person.frames[i];
    if (!body) continue;
    const Vector2d &left = body->landmarks[kAnkleL].p_px, &right = body->landmarks[kAnkleR].p_px;
    const double leg = std::max((left - hips(*body)).norm(), (right - hips(*body)).norm()),
                 distance = std::abs(left.x() - right.x());
    if (!apart && distance > kApart * leg) steps.push_back(static_cast<int>(i));
    apart = apart ? distance > kTogether * leg : distance > kApart * leg;
  }
  return steps;
}

/// Frames of the longest run of steps whose intervals are alike.
int longest_striding(const std::vector<int>& steps) {
  constexpr double kAlike = 1.6;
  constexpr std::size_t kFewest = 3;  // steps
  int longest = 0;
  for (std::size_t first = 0; first < steps.size(); ++first) {
    int shortest = std::numeric_limits<int>::max(), greatest = 0;
    for (std::size_t last = first + 1; last < steps.size(); ++last) {
      shortest = std::min(shortest, steps[last] - steps[last - 1]);
      greatest = std::max(greatest, steps[last] - steps[last - 1]);
      if (greatest > kAlike * shortest) break;
      if (last - first + 1 >= kFewest) longest = std::max(longest, steps[last] - steps[first]);
    }
  }
  return longest;
}

FollowedPerson followed(const Frames& frames, const Detection& from, Viewer& forward,
                        Viewer& backward, const std::function<void()>& looked) {
  FollowedPerson person;
  person.frames.resize(static_cast<std::size_t>(frames.count));
  // Once more, in the crop that the landmarks ask for.
  const PoseLandmarks again = forward.look(frames.image(from.frame), from.body.next);
  person.frames[static_cast<std::size_t>(from.frame)] =
      again.presence >= kPresent ? again : from.body;
  auto back = std::async(std::launch::async,
                         [&] { follow(frames, from, -1, backward, person.frames, looked); });
  follow(frames, from, 1, forward, person.frames, looked);
  back.get();
  person.seen = static_cast<int>(
      std::ranges::count_if(person.frames, [](const auto& body) { return body.has_value(); }));
  person.striding = longest_striding(steps_of(person));
  return person;
}

bool is_of(const Detection& detection, const FollowedPerson& person) {
  const auto& body = person.frames[static_cast<std::size_t>(detection.frame)];
  return body && (hips(*body) - hips(detection.body)).norm() < kSamePerson * body->next.size_px;
}

}  // namespace

std::vector<FollowedPerson> follow_people(const Frames& frames, Viewer& forward, Viewer& backward,
                                          const FollowOptions& options) {
  std::vector<Detection> detections = detections_of(frames, forward, options.sampled_frames);
  std::vector<FollowedPerson> people;
  std::mutex mutex;
  int done = 0;
  while (!detections.empty() && static_cast<int>(people.size()) < options.most_people) {
    const int of = frames.count * (static_cast<int>(people.size()) + 1);
    done = frames.count * static_cast<int>(people.size());
    const auto looked = [&] {
      const std::lock_guard lock(mutex);
      if (++done; options.progress) options.progress(done, of);
    };
    people.push_back(followed(frames, detections.front(), forward, backward, looked));
    std::erase_if(detections, [&](const Detection& s) { return is_of(s, people.back()); });
    // Seen once only: hardly somebody else. The best detection itself always is of this person.
    std::set<int> left;
    for (const Detection& s : detections) left.insert(s.frame);
    if (left.size() < 2) break;
  }
  std::ranges::stable_sort(people, std::ranges::greater(),
                           [](const FollowedPerson& p) { return std::pair(p.striding, p.seen); });
  return people;
}

}  // namespace stride::pose
