#include "tests/calibrate/zero_clicks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "extract/annotation/asking.h"
#include "extract/annotation/checks.h"
#include "extract/annotation/points_of_video.h"
#include "extract/annotation/points_on_video.h"
#include "extract/io/random.h"
#include "extract/io/statistics.h"
#include "extract/skeleton/units.h"
#include "videos/truth.h"

namespace stride {
namespace {

constexpr std::array kKnees{BodyPart::knee_r, BodyPart::knee_l};
constexpr std::array kAnkles{BodyPart::ankle_r, BodyPart::ankle_l};
constexpr std::array kToes{BodyPart::toe_r, BodyPart::toe_l};
constexpr std::array kHeels{BodyPart::heel_r, BodyPart::heel_l};

/// The truth with the backs of the shoes as heels.
Trajectory with_heels(Trajectory truth, const videos::Clip& clip) {
  const videos::Motion motion(clip);
  for (TrajectoryFrame& frame : truth.frames)
    for (const BodyPart part : kHeels)
      frame[part] = {motion.camera(frame.time_s).project(motion.skeleton(frame.time_s)[part]),
                     Source::clicked, 1};
  return truth;
}

template <typename Frames>
void drop_heels(Frames& frames) {
  for (auto& frame : frames)
    for (const BodyPart part : kHeels) frame[part] = {};
}

template <typename Frames>
double rms_px(const Frames& frames, const Trajectory& truth, const std::array<BodyPart, 2>& parts) {
  double sum = 0;
  int n = 0;
  for (const auto& frame : frames)
    for (const BodyPart part : parts) {
      if (!frame[part].present()) continue;
      const TrajectoryFrame& right = truth.frames[static_cast<std::size_t>(frame.frame)];
      sum += (frame[part].p_px - right[part].p_px).squaredNorm();
      ++n;
    }
  return n > 0 ? std::sqrt(sum / n) : NAN;
}

int exchanged(const Trajectory& tracked, const Trajectory& truth) {
  int count = 0;
  for (const TrajectoryFrame& frame : tracked.frames) {
    const TrajectoryFrame& right = truth.frames[static_cast<std::size_t>(frame.frame)];
    double as_is = 0, other = 0;
    for (const BodyPart part : {kKnees[0], kKnees[1], kAnkles[0], kAnkles[1]}) {
      as_is += (frame[part].p_px - right[part].p_px).norm();
      other += (frame[part].p_px - right[mirrored(part)].p_px).norm();
    }
    count += other < as_is;
  }
  return count;
}

double leg_px(const Trajectory& truth) {
  std::vector<double> legs;
  for (const TrajectoryFrame& frame : truth.frames)
    legs.push_back((frame[BodyPart::hip_r].p_px - frame[BodyPart::knee_r].p_px).norm() +
                   (frame[BodyPart::knee_r].p_px - frame[BodyPart::ankle_r].p_px).norm());
  return median(std::move(legs));
}

constexpr std::array kCorrections{0, 5, 10};
constexpr int kStrideFrames = 9;  // that are clicked for one stride
constexpr double kHand_px = 1.5;

std::filesystem::path video_of(const videos::Clip& clip) {
  return std::filesystem::path(STRIDE_SOURCE_DIR) / "videos" / (clip.name + ".mp4");
}

/// A person's click on a part, as a change of the keypoints.
void click(const Trajectory& truth, const annotation::WorstPoint& point, Random& random,
           Keypoints& keypoints) {
  const TrajectoryFrame& frame = truth.frames[static_cast<std::size_t>(point.frame)];
  const double x = kHand_px * normal(random), y = kHand_px * normal(random);
  ClickedFrame& clicked = keypoints.frames[point.frame];
  clicked.time_s = frame.time_s;
  clicked[point.part] = Click{frame[point.part].p_px + Eigen::Vector2d(x, y), ClickState::seen, ""};
}

std::string worst_joint(const Trajectory& tracked, const videos::Clip& clip,
                        const SagittalModel& model) {
  const Calibration found = calibrate(tracked, model, {});
  return found.verdict.refused
             ? found.verdict.text()
             : fmt::format("{:.2f}", 100 * accuracy(found, clip, model).worst_rms_m());
}

}  // namespace

std::string correction_head() {
  std::string head = "| clip |", line = "|---|";
  for (const int n : kCorrections) head += fmt::format(" {} corrections |", n), line += "---|";
  return head + " 63 clicks |\n" + line + "---|\n";
}

std::string correction_row(const videos::Clip& clip, const SagittalModel& model) {
  const std::filesystem::path video = video_of(clip);
  const Trajectory truth = videos::truth_px(clip);
  const std::vector<BodyPart> parts = annotation::asking_order(Side::right, false, false);
  const tracking::LabelledClip seen = tracking::points_of_network(video, {});
  Keypoints keypoints = videos::clicks(clip);
  Keypoints stride = keypoints;
  stride.frames.erase(std::next(stride.frames.begin(), kStrideFrames), stride.frames.end());
  keypoints.frames.clear();
  Random random(11);
  std::string row = fmt::format("| `{}` |", clip.name);
  Trajectory tracked;
  for (int n = 0; n <= kCorrections.back(); ++n) {
    tracked =
        tracking::track(video, tracking::mixed(seen, {tracking::marks_of(keypoints)})).trajectory;
    if (std::ranges::find(kCorrections, n) != kCorrections.end())
      row += fmt::format(" {} |", worst_joint(tracked, clip, model));
    if (const auto worst = annotation::worst_point(tracked, keypoints, parts, {}))
      click(truth, *worst, random, keypoints);
  }
  tracked = tracking::track(video, {tracking::marks_of(stride)}).trajectory;
  return row + fmt::format(" {} |\n", worst_joint(tracked, clip, model));
}

pose::NetworkPoints seen_by_network(const videos::Clip& clip) {
  return pose::network_points(video_of(clip));
}

ZeroClicks without_clicks(const videos::Clip& clip, const SagittalModel& model,
                          const pose::NetworkPoints& seen_with_heels, SeenHeels heels) {
  const std::filesystem::path video = video_of(clip);
  const Trajectory truth = with_heels(videos::truth_px(clip), clip);
  pose::NetworkPoints seen = seen_with_heels;
  if (heels == SeenHeels::dropped) drop_heels(seen.detections.frames);
  Trajectory tracked =
      tracking::track(video, tracking::points_on(video, seen.detections, {})).trajectory;
  ZeroClicks result;
  result.heels_px[0] = rms_px(seen.detections.frames, truth, kHeels);
  result.heels_px[1] = rms_px(tracked.frames, truth, kHeels);
  if (heels == SeenHeels::tracked) drop_heels(tracked.frames);
  result.found = calibrate(tracked, model, {});
  result.frames = clip.frames;
  result.lost = clip.frames - static_cast<int>(seen.detections.frames.size());
  result.exchanged = exchanged(tracked, truth);
  result.leg_px = leg_px(truth);
  result.knees_px[0] = rms_px(seen.detections.frames, truth, kKnees);
  result.knees_px[1] = rms_px(tracked.frames, truth, kKnees);
  result.ankles_px[0] = rms_px(seen.detections.frames, truth, kAnkles);
  result.ankles_px[1] = rms_px(tracked.frames, truth, kAnkles);
  result.toes_px[0] = rms_px(seen.detections.frames, truth, kToes);
  result.toes_px[1] = rms_px(tracked.frames, truth, kToes);
  return result;
}

std::string ZeroClicks::table_head() {
  return "| clip | leg, px | knees, px | ankles, px | toes, px | heels, px | lost | exchanged | "
         "period, % | speed, % | worst joint, cm | worst toe, cm | worst foot, deg |\n"
         "|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

std::string ZeroClicks::row(const videos::Clip& clip, const SagittalModel& model) const {
  const std::string seen = fmt::format(
      "| `{}` | {:.0f} | {:.1f} → {:.2f} | {:.1f} → {:.2f} | {:.1f} → {:.2f} | {:.1f} → {:.2f} | "
      "{} "
      "of {} | {} |",
      clip.name, leg_px, knees_px[0], knees_px[1], ankles_px[0], ankles_px[1], toes_px[0],
      toes_px[1], heels_px[0], heels_px[1], lost, frames, exchanged);
  if (found.verdict.refused) return seen + fmt::format(" {} | | | | |\n", found.verdict.text());
  const Accuracy a = accuracy(found, clip, model);
  return seen + fmt::format(" {:+.2f} | {:+.1f} | {:.2f} | {:.2f} | {:.1f} |\n", 100 * a.period,
                            100 * a.speed, 100 * a.worst_rms_m(),
                            100 * std::ranges::max(a.toes_rms_m),
                            std::ranges::max(a.feet_rms_rad) / kDegree);
}

}  // namespace stride
