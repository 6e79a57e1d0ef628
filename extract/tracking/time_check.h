#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stride::video {
struct Edit;
struct VideoInfo;
}  // namespace stride::video

namespace stride::tracking {

/// By how much a clip plays too slowly (above 1) or too fast, if its stride takes longer or shorter
/// than people's do: `shortest_s` to `longest_s`. In halves above 1, for a person to recognise the
/// camera's. Nothing where the period is as people's.
std::optional<double> likely_slow_motion(double period_s, double shortest_s = 0.4,
                                         double longest_s = 1.8);

/// The same as a sentence with the cure; empty where there is no doubt.
std::string doubt_of_period(double period_s, double shortest_s = 0.4, double longest_s = 1.8);

/// What a video's own rates say: `capture_rate_hz` of the camera (NaN: not said), `rate_hz` at
/// which it plays. Empty if nothing is odd.
std::string doubt_of_rates(double capture_rate_hz, double rate_hz);

/// What a file's edit list does to the clip's times.
std::string doubt_of_edits(const std::vector<video::Edit>& edits);

/// What a video's header says of its time: its rates and its edit list. Empty if nothing is odd.
std::string doubt_of_header(const video::VideoInfo& info);

/// Says on stderr what doubt_of_header() says of a video whose runner moves in real time
/// (`slow_motion` is 1), as nobody else has.
void warn_of_header(const std::filesystem::path& video, double slow_motion);

}  // namespace stride::tracking
