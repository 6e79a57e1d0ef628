#include "extract/pose/network_points.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <optional>

#include "extract/io/error.h"
#include "extract/io/statistics.h"
#include "extract/pose/weights.h"
#include "extract/video/frame_store.h"

namespace stride::pose {

using Eigen::Vector2d;

namespace {

constexpr double kMostBytes = 400e6;  // of frames held as they are
constexpr double kSeenWell = 0.5;     // height of a heat map
constexpr double kMostUnseen = 0.25;  // of the frames between the first and the last
constexpr int kFewestFrames = 10;
// Of the crop's side, from the hips to the picture's left or right edge. Nearer to it a leg may be
// outside, which the network then draws inside, on the other leg. Half a leg, about.
constexpr double kLegsCut = 0.2;

/// Which landmarks a part is the mean of, and the standard deviation of its error, of each
/// coordinate in leg lengths, where its heat map reaches 0.9: measured on our clips, the difference
/// between the network's idea of a joint and ours included.
struct Landmarks {
  std::array<std::size_t, 2> of;
  double sd_legs;
};
constexpr double kKnee = 0.016;
std::optional<Landmarks> landmarks_of(BodyPart part) {
  constexpr double kAnkle = 0.025, kToe = 0.034, kHead = 0.03, kHeel = 0.03;
  switch (part) {
    case BodyPart::pelvis:
      return Landmarks{{23, 24}, kKnee};
    case BodyPart::knee_r:
      return Landmarks{{26, 26}, kKnee};
    case BodyPart::knee_l:
      return Landmarks{{25, 25}, kKnee};
    case BodyPart::ankle_r:
      return Landmarks{{28, 28}, kAnkle};
    case BodyPart::ankle_l:
      return Landmarks{{27, 27}, kAnkle};
    case BodyPart::toe_r:
      return Landmarks{{32, 32}, kToe};
    case BodyPart::toe_l:
      return Landmarks{{31, 31}, kToe};
    case BodyPart::heel_r:
      return Landmarks{{30, 30}, kHeel};
    case BodyPart::heel_l:
      return Landmarks{{29, 29}, kHeel};
    case BodyPart::head:
      return Landmarks{{7, 8}, kHead};
    // The pelvis' own landmarks: as points beside it they would count twice, and the network's two
    // hips are no hip joints.
    case BodyPart::hip_r:
    case BodyPart::hip_l:
      return std::nullopt;
  }
  return std::nullopt;
}

/// The tracker takes the noise of a point as inverse to its confidence: that of a knee seen well
/// over this one's. The logarithm of the noise grows as the heat map sinks, likewise measured.
double confidence_of(double sd_legs, double peak) {
  constexpr double kMost = 0.95, kLeast = 0.05, kWell = 0.9, kGrowth = 2.7;
  const double growth = std::exp(kGrowth * std::max(0.0, kWell - peak));
  return std::max(kLeast, kMost * kKnee / (sd_legs * growth));
}

/// One thread of OpenCV's own while there are two of ours.
class OneThread {
 public:
  OneThread() : before_(cv::getNumThreads()) { cv::setNumThreads(1); }
  ~OneThread() { cv::setNumThreads(before_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int before_;
};

/// Both networks, once for each thread.
struct Networks {
  PersonDetector detector;
  LandmarkNetwork landmarks;

  explicit Networks(const Weights& weights)
      : detector(weights.detector), landmarks(weights.landmarks) {}

  Viewer viewer() {
    return {[this](const cv::Mat& bgr, const Crop& region) { return detector.find(bgr, region); },
            [this](const cv::Mat& bgr, const Crop& crop) { return landmarks.look(bgr, crop); }};
  }
};

bool is_doubtful(const PoseLandmarks& body) {
  double sum = 0;
  for (const std::size_t k : {25, 26, 27, 28}) sum += body.landmarks[k].peak;
  return sum < 4 * kSeenWell;
}

Followed summary(const FollowedPerson& person) {
  Followed followed;
  int unseen = 0;  // since the last frame on which he was seen
  for (const std::optional<PoseLandmarks>& body : person.frames) {
    if (!body) {
      if (followed.frames > 0) ++unseen;
      continue;
    }
    followed.lost += unseen;
    followed.frames += unseen + 1;
    unseen = 0;
    followed.doubtful += is_doubtful(*body);
  }
  return followed;
}

void check(const Followed& followed, const std::string& video) {
  const std::string click = fmt::format("click instead: stride annotate {}", video);
  require(followed.frames >= kFewestFrames,
          "{}: the pose network sees the runner on {} frames only; {}", video, followed.frames,
          click);
  require(followed.lost <= kMostUnseen * followed.frames,
          "{}: the pose network lost the runner on {} of {} frames; {}", video, followed.lost,
          followed.frames, click);
  require(followed.lost + followed.doubtful <= kMostUnseen * followed.frames,
          "{}: the pose network lost the runner on {} of {} frames and is unsure of the legs on {} "
          "more; {}",
          video, followed.lost, followed.frames, followed.doubtful, click);
}

imports::ImportedPerson described(const FollowedPerson& person) {
  imports::ImportedPerson result;
  std::vector<double> heights_px;
  for (std::size_t i = 0; i < person.frames.size(); ++i) {
    if (!person.frames[i]) continue;
    if (heights_px.empty()) result.first_frame = static_cast<int>(i);
    result.last_frame = static_cast<int>(i);
    heights_px.push_back(person.frames[i]->next.size_px / 1.25);
  }
  result.frames = person.seen;
  result.height_px = median(std::move(heights_px));
  return result;
}

std::vector<FollowedPerson> people_in(const std::filesystem::path& video,
                                      const NetworkOptions& options, cv::Size& image) {
  const std::optional<Weights> weights =
      options.landmarks.empty() ? installed_weights() : weights_at(options.landmarks);
  require(weights.has_value(), "{}: no pose network is installed; {}", video.string(),
          how_to_install_weights());
  video::FrameStore store(video, kMostBytes);
  image = {store.info().width_px, store.info().height_px};
  // A clip at a time: the networks and frames of one fill half a gigabyte.
  static std::mutex one_clip;
  const std::lock_guard lock(one_clip);
  Networks first(*weights), second(*weights);
  Viewer forward = first.viewer(), backward = second.viewer();
  store.wait();
  FollowOptions follow;
  follow.progress = options.progress;
  const OneThread one_thread;
  return follow_people({store.count(), [&](int frame) { return store.image(frame); }}, forward,
                       backward, follow);
}

}  // namespace

imports::ImportedFrame points_of(const PoseLandmarks& body, int frame, cv::Size image) {
  imports::ImportedFrame result;
  result.frame = frame;
  const double hips_px = (body.landmarks[23].p_px.x() + body.landmarks[24].p_px.x()) / 2;
  const bool legs_cut = std::min(hips_px, image.width - 1 - hips_px) < kLegsCut * body.next.size_px;
  for (const BodyPart part : kBodyParts) {
    const std::optional<Landmarks> landmarks = landmarks_of(part);
    if (!landmarks || (legs_cut && row(part).side)) continue;
    const Landmark &a = body.landmarks[landmarks->of[0]], &b = body.landmarks[landmarks->of[1]];
    const Vector2d p_px = (a.p_px + b.p_px) / 2;
    const bool inside = p_px.x() >= -0.5 && p_px.y() >= -0.5 && p_px.x() <= image.width - 0.5 &&
                        p_px.y() <= image.height - 0.5;
    if (!inside) continue;
    const double peak = std::min(a.peak, b.peak);
    result[part] = {p_px, Source::detected, confidence_of(landmarks->sd_legs, peak)};
  }
  return result;
}

NetworkPoints network_points(const std::filesystem::path& video, const NetworkOptions& options) {
  cv::Size image;
  const std::vector<FollowedPerson> people = people_in(video, options, image);
  require(!people.empty(), "{}: the pose network sees nobody; click instead: stride annotate {}",
          video.string(), video.string());
  require(options.person >= 0 && options.person <= static_cast<int>(people.size()),
          "person = {}: the pose network followed {} in {} (1 moves in strides for longest)",
          options.person, people.size(), video.string());
  NetworkPoints points;
  points.detections.format = "the pose network";
  points.detections.person = std::max(options.person, 1);
  const FollowedPerson& runner = people[static_cast<std::size_t>(points.detections.person - 1)];
  points.followed = summary(runner);
  check(points.followed, video.string());
  for (std::size_t i = 0; i < people.size(); ++i) {
    points.detections.people.push_back(described(people[i]));
    if (&people[i] != &runner && people[i].striding > 0 &&
        2 * people[i].striding >= runner.striding)
      points.also_running.push_back(static_cast<int>(i) + 1);
  }
  for (std::size_t i = 0; i < runner.frames.size(); ++i) {
    if (!runner.frames[i]) continue;
    const auto frame = points_of(*runner.frames[i], static_cast<int>(i), image);
    if (std::ranges::any_of(frame.points, &Point::present))
      points.detections.frames.push_back(frame);
  }
  return points;
}

}  // namespace stride::pose
