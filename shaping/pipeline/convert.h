#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "calibrate/fit/fit_options.h"
#include "shaping/keyframes.h"

namespace stride::pipeline {

/// Options of a clip.
struct ClipOptions {
  fit::RunnerSize size;
  std::optional<Facing> direction;  // none: as the keypoints say
  std::string movement;             // a name of movements.toml; empty: as the keypoints say
  double slow_motion = 0;  // seconds of video a second of the runner; 0: as the keypoints say
  bool force = false;      // convert a refused clip if there is a fit
  KeyframeOptions keyframes;
};

struct ConvertOptions {
  std::filesystem::path out;
  std::filesystem::path model = osim::default_model_file();
  ClipOptions clip;                            // of every clip
  std::map<std::string, ClipOptions> by_clip;  // instead, for the clip of that NAME
  int threads = 0;                             // 0: one for each processor
  bool network = false;  // the pose network also where there are clicks, as PointsOptions
  std::filesystem::path landmarks;  // its .tflite; empty: the installed one
  int person = 0;  // whom it follows: 0 and 1 who moves in strides for longest, 2 the next, …
  int loop = 0;    // above 1: each video is a loop, converted as if it played so many times
  bool pictures = true;
  bool overlay = false;  // also NAME.overlay.mp4 of a video: the tracked points on its frames
  bool again = false;    // also what has not changed
  std::function<void(const std::string& line)> progress;  // one call at a time
};

/// A row of the table of results.
struct Converted {
  std::string name;
  bool failed = false, unchanged = false;
  std::string verdict;  // or the error
  std::string points;   // "clicks", "network" or "mixed"; empty: not known
  int frames = 0;
  double strides = 0, period_s = 0, speed_m_s = 0, mm_per_px = 0, rms_px = 0, rms_cm = 0;
};

/// The left half of the pipeline for each input: a video with NAME.keypoints.json beside it or
/// followed by the pose network, a NAME.trajectory.csv, or a NAME.calibrated.csv (as an agent's own
/// run). Writes, into `out`, NAME.trajectory.csv, NAME.calibrated.csv, NAME.report.txt,
/// NAME.report.svg and NAME.potential.json; skips unchanged inputs. A failure of one input is a row
/// of the table and does not stop the others. Results are in the order of the inputs.
std::vector<Converted> convert(const std::vector<std::filesystem::path>& inputs,
                               const ConvertOptions& options);

/// Folders become the videos in them that were clicked; `tell` is told of each other file why it is
/// left out. Throws Error for what does not exist or is no input, or for two inputs of one name.
std::vector<std::filesystem::path> expand_inputs(
    const std::vector<std::filesystem::path>& given,
    const std::function<void(const std::string&)>& tell = {});

/// Whether an input is for the decoder to try: neither a trajectory nor a calibrated run.
bool is_video(const std::filesystem::path& input);

/// Whether an input is a NAME.calibrated.csv.
bool is_calibrated(const std::filesystem::path& input);

/// NAME of an input.
std::string clip_name(const std::filesystem::path& input);

/// Reads a TOML file: keys of every clip at the top, and of one under [clip.NAME]. Keys: height,
/// leg, scale, direction, movement, slow-motion, force, keyframes, foot, symmetric, function,
/// index, epsilon, weight. Errors name file, key and value.
void load_convert_config(const std::filesystem::path& file, ConvertOptions& options);

/// The results as a table.
std::string table_of(const std::vector<Converted>& results);

}  // namespace stride::pipeline
