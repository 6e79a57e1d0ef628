#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "extract/tracking/track.h"

namespace stride::tracking {

/// How far points of one confidence are from the truth.
struct Reliability {
  int points = 0;
  int near = 0;  // within 3 % of a leg's length
};

/// Accuracy of tracking a clip from simulated clicks on its truth: knees and ankles, every frame
/// from the first click to the last.
struct TrackScore {
  int spacing_frames = 0;  // frames between clicks
  double noise_px = 0;     // standard deviation of a click, each coordinate
  double spline_px = 0;    // rms distance of the cubic spline through the same clicks
  double prior_px = 0;     // of the prior alone, without optical flow
  double tracked_px = 0;   // of track()
  double tracked_p95_px = 0;
  double again_px = 0;  // of track() with the second pass's prediction; 0 without one
  double period_s = 0;  // of the stride that was found
  std::array<Reliability, 10> by_confidence{};  // of track(), unclicked points; a tenth each
  double gain() const { return spline_px / tracked_px; }
};

struct ScoreOptions {
  std::vector<int> spacings{3, 4, 5, 6, 7, 8};
  std::vector<double> noises_px{0, 1.5};
  int first_frame = 0;  // the first click
  unsigned seed = 1;
  int seeds = 1;  // number of noise samples or, without noise, of offsets of the clicked frames
  /// Makes a prediction from the tracked trajectory, as by a fit, for a second pass.
  std::function<std::optional<Trajectory>(const Trajectory&)> predict = nullptr;
};

/// `truth`: a CSV with frame and <part>_x, <part>_y of every frame, in pixels.
std::vector<TrackScore> score_tracking(const std::filesystem::path& video,
                                       const std::filesystem::path& truth,
                                       const ScoreOptions& options = {});

/// As tables in Markdown: the scores, and of points of each confidence the share that is within 3 %
/// of a leg from the truth.
std::string table_of(const std::vector<TrackScore>& scores);

/// The second of these tables alone.
std::string confidence_table(const std::vector<TrackScore>& scores);

}  // namespace stride::tracking
