#include "extract/tracking/time_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "extract/video/video.h"

namespace stride::tracking {

std::optional<double> likely_slow_motion(double period_s, double shortest_s, double longest_s) {
  constexpr double kUsual_s = 0.71;  // of runners
  if (!(period_s > 0) || (period_s >= shortest_s && period_s <= longest_s)) return std::nullopt;
  const double factor = period_s / kUsual_s;
  return factor > 1 ? std::max(1.5, std::round(2 * factor) / 2) : std::round(100 * factor) / 100;
}

std::string doubt_of_period(double period_s, double shortest_s, double longest_s) {
  const auto factor = likely_slow_motion(period_s, shortest_s, longest_s);
  if (!factor) return {};
  return fmt::format(
      "a stride takes {:.2f} s of video, people's {} to {} s: is the frame rate right, or {} by "
      "about {}? say --slow-motion {} (y in the window)",
      period_s, shortest_s, longest_s, *factor > 1 ? "is it slow motion" : "does it play too fast,",
      *factor, *factor);
}

std::string doubt_of_rates(double capture_rate_hz, double rate_hz) {
  constexpr double kHighSpeed_hz = 100;
  if (capture_rate_hz > 1.2 * rate_hz)
    return fmt::format(
        "the file says that the camera recorded {:.4g} frames a second, and plays {:.4g}: slow "
        "motion by {:.3g}? say --slow-motion {:.3g}",
        capture_rate_hz, rate_hz, capture_rate_hz / rate_hz, capture_rate_hz / rate_hz);
  if (rate_hz >= kHighSpeed_hz)
    return fmt::format(
        "the video has {:.4g} frames a second and is taken for real time; if it plays in slow "
        "motion, say --slow-motion",
        rate_hz);
  return {};
}

std::string doubt_of_edits(const std::vector<video::Edit>& edits) {
  const std::string text = video::text_of(edits);
  if (text.empty()) return {};
  // FFmpeg takes the pieces, and repeats frames where they last longer than they were recorded.
  const bool retimed = std::ranges::any_of(edits, [](const video::Edit& e) { return e.rate != 1; });
  const auto shown = std::ranges::count_if(
      edits, [](const video::Edit& edit) { return std::isfinite(edit.from_s); });
  return fmt::format(
      "the file's edit list says: {}; {}", text,
      retimed
          ? "frames have their recorded times here, not those of players; if the clip is not as "
            "recorded, ffmpeg -ignore_editlist 1 -i IN -c copy OUT gives the whole recording"
      : shown > 1 ? "trim the clip to one piece (b, t in stride annotate)"
                  : "times of other programs may begin later");
}

std::string doubt_of_header(const video::VideoInfo& info) {
  const std::string rates = doubt_of_rates(info.capture_rate_hz, info.rate_hz),
                    edits = doubt_of_edits(info.edits);
  return rates + (rates.empty() || edits.empty() ? "" : "; ") + edits;
}

void warn_of_header(const std::filesystem::path& video, double slow_motion) {
  if (slow_motion != 1) return;
  if (const std::string doubt = doubt_of_header(video::Video(video).info()); !doubt.empty())
    fmt::print(stderr, "{}: warning: {}\n", video.string(), doubt);
}

}  // namespace stride::tracking
