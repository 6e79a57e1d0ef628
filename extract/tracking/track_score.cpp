#include "extract/tracking/track_score.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "extract/io/error.h"
#include "extract/io/random.h"
#include "extract/io/statistics.h"
#include "extract/io/table.h"
#include "extract/tracking/cubic_spline.h"
#include "extract/tracking/limb_lengths.h"

namespace stride::tracking {
namespace {

using Eigen::Vector2d;

constexpr std::array kScoredParts{BodyPart::knee_r, BodyPart::ankle_r, BodyPart::knee_l,
                                  BodyPart::ankle_l};

Trajectory load_truth(const std::filesystem::path& file, const video::VideoTimes& video) {
  const Table table = load_csv(file);
  Trajectory truth;
  truth.video = video.info.file.filename().string();
  truth.width_px = video.info.width_px;
  truth.height_px = video.info.height_px;
  for (const auto& row : table.rows) {
    TrajectoryFrame& frame = truth.frames.emplace_back();
    frame.frame = static_cast<int>(row[table.column("frame")]);
    require(frame.frame >= 0 && frame.frame < static_cast<int>(video.times_s.size()),
            "{}: frame {}: the video has {} frames", file.string(), frame.frame,
            video.times_s.size());
    frame.time_s = video.times_s[static_cast<std::size_t>(frame.frame)];
  }
  for (const BodyPart part : kRequiredParts) {
    const std::size_t x = table.column(fmt::format("{}_x", name(part))),
                      y = table.column(fmt::format("{}_y", name(part)));
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      truth.frames[i][part] = {{table.rows[i][x], table.rows[i][y]}, Source::clicked, 1};
  }
  return truth;
}

Trajectory clicks_on(const Trajectory& truth, int first, int spacing, double noise_px,
                     unsigned seed) {
  Random random(seed);
  Trajectory clicks = truth;
  clicks.frames.clear();
  for (auto i = static_cast<std::size_t>(first); i < truth.frames.size();
       i += static_cast<std::size_t>(spacing)) {
    TrajectoryFrame& frame = clicks.frames.emplace_back(truth.frames[i]);
    for (const BodyPart part : kRequiredParts) {
      const auto [x, y] = normal_pair(random);
      frame[part].p_px += noise_px * Vector2d(x, y);
    }
  }
  return clicks;
}

/// The cubic spline through the clicks of each part.
Trajectory splined(const Trajectory& clicks, const Trajectory& truth) {
  Trajectory result = truth;
  for (const BodyPart part : kScoredParts) {
    std::vector<double> times_s;
    std::vector<Vector2d> points;
    for (const TrajectoryFrame& frame : clicks.frames) {
      times_s.push_back(frame.time_s);
      points.push_back(frame[part].p_px);
    }
    const CubicSpline spline(times_s, points);
    for (TrajectoryFrame& frame : result.frames) frame[part].p_px = spline(frame.time_s);
  }
  return result;
}

/// Distances from the truth on the frames between the first and the last click.
std::vector<double> errors_px(const Trajectory& result, const Trajectory& truth, int first,
                              int last) {
  std::map<int, const TrajectoryFrame*> true_frames;
  for (const TrajectoryFrame& frame : truth.frames) true_frames[frame.frame] = &frame;
  std::vector<double> errors;
  for (const TrajectoryFrame& frame : result.frames)
    if (frame.frame >= first && frame.frame <= last)
      for (const BodyPart part : kScoredParts)
        errors.push_back((frame[part].p_px - (*true_frames.at(frame.frame))[part].p_px).norm());
  return errors;
}

/// Adds the points that were not clicked to the bins of their confidence.
void count_reliability(const Trajectory& result, const Trajectory& truth, const Trajectory& clicks,
                       std::array<Reliability, 10>& bins) {
  constexpr double kNear = 0.03;
  const double near_px = kNear * leg_px(truth);
  std::map<int, const TrajectoryFrame*> true_frames;
  for (const TrajectoryFrame& frame : truth.frames) true_frames[frame.frame] = &frame;
  std::set<int> clicked;
  for (const TrajectoryFrame& frame : clicks.frames) clicked.insert(frame.frame);
  for (const TrajectoryFrame& frame : result.frames) {
    if (clicked.contains(frame.frame)) continue;
    for (const BodyPart part : kScoredParts) {
      Reliability& bin =
          bins[std::min<std::size_t>(9, static_cast<std::size_t>(10 * frame[part].confidence))];
      ++bin.points;
      bin.near += (frame[part].p_px - (*true_frames.at(frame.frame))[part].p_px).norm() < near_px;
    }
  }
}

double rms(const std::vector<double>& errors) {
  double sum = 0;
  for (const double e : errors) sum += e * e;
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

}  // namespace

std::vector<TrackScore> score_tracking(const std::filesystem::path& video,
                                       const std::filesystem::path& truth_file,
                                       const ScoreOptions& options) {
  video::VideoTimes times{video::Video(video).info(), {}, {}};
  std::vector<video::VideoFrame> frames;
  video::Video decoder(video);
  for (video::VideoFrame frame; decoder.read(frame);) {
    times.times_s.push_back(frame.time_s);
    frames.push_back(frame);
  }
  const Trajectory truth = load_truth(truth_file, times);
  std::vector<TrackScore> scores;
  for (const double noise_px : options.noises_px)
    for (const int spacing : options.spacings) {
      TrackScore& score = scores.emplace_back();
      score.spacing_frames = spacing;
      score.noise_px = noise_px;
      std::vector<double> spline, prior, tracked, again;
      for (int i = 0; i < options.seeds; ++i) {
        const int first = options.first_frame + i % spacing;
        const Trajectory clicks =
            clicks_on(truth, first, spacing, noise_px,
                      options.seed + static_cast<unsigned>(spacing + 1000 * i));
        const int last = clicks.frames.back().frame;
        std::size_t next = 0;
        const video::FrameSource source = [&](video::VideoFrame& frame) {
          if (next == frames.size()) return false;
          frame = frames[next++];
          return true;
        };
        video::DecodeOptions watching;
        watching.camera = false;
        const video::DecodedClip clip = video::decode_clip(clicks, source, watching);
        const auto add = [&](std::vector<double>& errors, const Trajectory& result) {
          const auto more = errors_px(result, truth, first, last);
          errors.insert(errors.end(), more.begin(), more.end());
        };
        TrackOptions track_options;
        const Tracked result = track(clicks, clip, track_options);
        score.period_s = result.summary.prior.legs.period_s;
        add(spline, splined(clicks, truth));
        add(tracked, result.trajectory);
        count_reliability(result.trajectory, truth, clicks, score.by_confidence);
        if (options.predict) {
          const auto prediction = options.predict(result.trajectory);
          track_options.prior = prediction ? &*prediction : nullptr;
          add(again, track(clicks, clip, track_options).trajectory);
        }
        track_options = {};
        track_options.flow = false;
        add(prior, track(clicks, clip, track_options).trajectory);
      }
      std::ranges::sort(tracked);
      score.spline_px = rms(spline);
      score.prior_px = rms(prior);
      score.tracked_px = rms(tracked);
      score.again_px = rms(again);
      score.tracked_p95_px = tracked[tracked.size() * 95 / 100];
    }
  return scores;
}

std::string table_of(const std::vector<TrackScore>& scores) {
  std::string text =
      "| click every | noise px | spline rms px | prior alone | tracked rms px | p95 | gain |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const TrackScore& s : scores)
    text += fmt::format("| {} frames | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.1f}× |\n",
                        s.spacing_frames, s.noise_px, s.spline_px, s.prior_px, s.tracked_px,
                        s.tracked_p95_px, s.gain());
  return text + '\n' + confidence_table(scores);
}

std::string confidence_table(const std::vector<TrackScore>& scores) {
  std::string text = "| confidence | points | within 3 % of a leg |\n|---|---|---|\n";
  for (std::size_t bin = 0; bin < 10; ++bin) {
    Reliability all;
    for (const TrackScore& s : scores) {
      all.points += s.by_confidence[bin].points;
      all.near += s.by_confidence[bin].near;
    }
    if (all.points > 0)
      text += fmt::format("| {:.1f} to {:.1f} | {} | {:.1f} % |\n", 0.1 * static_cast<double>(bin),
                          0.1 * static_cast<double>(bin + 1), all.points,
                          100.0 * all.near / all.points);
  }
  return text;
}

}  // namespace stride::tracking
