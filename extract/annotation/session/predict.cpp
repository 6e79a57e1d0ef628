#include "extract/annotation/session/predict.h"

#include <chrono>
#include <cmath>
#include <thread>

#include "extract/annotation/asking.h"
#include "extract/annotation/points_of_video.h"
#include "extract/skeleton/movement.h"
#include "extract/tracking/leg_identity.h"
#include "extract/tracking/time_check.h"
#include "extract/tracking/track.h"

namespace stride::annotation {
namespace {

struct GivenUp {};

bool can_be_tracked(const Keypoints& keypoints) {
  int frames = 0;
  for (const auto& [number, frame] : keypoints.frames) frames += frame.placed(BodyPart::pelvis);
  return frames >= 2;
}

/// Clicked frames whose legs move as if they were swapped.
std::vector<int> suspected_swaps(const Trajectory& marks) {
  std::vector<int> suspects;
  for (const tracking::LegSwap& swap : tracking::repair_legs(marks).swaps)
    for (const TrajectoryFrame& frame : marks.frames)
      if (frame.frame >= swap.first_frame && frame.frame <= swap.last_frame)
        suspects.push_back(frame.frame);
  return suspects;
}

/// From the period of the tracker's prior, if the ankles cross at all.
double stride_frames(const tracking::Tracked& tracked, double rate_hz) {
  const double crossing = stride_from_crossings(tracked.trajectory);
  const double periodic = tracked.summary.prior.legs.period_s * rate_hz;
  return std::abs(periodic - crossing) < 0.25 * crossing ? periodic : crossing;
}

}  // namespace

std::optional<Prediction> predict(const Keypoints& keypoints, video::FrameStore& frames,
                                  const std::atomic<bool>& given_up,
                                  const tracking::LabelledClip* network) {
  Prediction prediction;
  if (!network && !can_be_tracked(keypoints)) return prediction;
  while (!frames.complete()) {
    if (given_up) return std::nullopt;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  std::vector<double> times_s;
  for (int i = 0; i < frames.count(); ++i)
    times_s.push_back(frames.video_time_s(i) / keypoints.slow_motion);
  int next = 0;
  const video::FrameSource source = [&](video::VideoFrame& frame) {
    if (given_up) throw GivenUp();
    if (next >= frames.count()) return false;
    frame.index = next;
    frame.time_s = times_s[static_cast<std::size_t>(next)];
    frame.image = frames.image(next);
    ++next;
    return true;
  };
  video::DecodeOptions options;
  options.progress = [&](int, int) {
    if (given_up) throw GivenUp();
  };
  try {
    const Trajectory clicks = tracking::marks_of(keypoints);
    Trajectory marks = clicks;
    const bool repeats = movement(keypoints.movement).repeats;
    if (network) {
      marks = tracking::mixed(*network, {clicks, keypoints.slow_motion}).marks;
      for (TrajectoryFrame& frame : marks.frames)
        frame.time_s = times_s[static_cast<std::size_t>(frame.frame)];
    } else if (repeats) {
      prediction.suspects = suspected_swaps(marks);
    }
    const tracking::Tracked tracked =
        tracking::track(marks, video::decode_clip(marks, source, options));
    prediction.trajectory = tracked.trajectory;
    if (!repeats) return prediction;
    prediction.stride_frames =
        stride_frames(tracked, frames.info().rate_hz * keypoints.slow_motion);
    if (prediction.stride_frames > 0)
      prediction.doubt = tracking::doubt_of_period(prediction.stride_frames /
                                                   (frames.info().rate_hz * keypoints.slow_motion));
  } catch (const GivenUp&) {
    return std::nullopt;
  }
  return prediction;
}

}  // namespace stride::annotation
