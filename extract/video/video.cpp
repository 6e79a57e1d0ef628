#include "extract/video/video.h"

#include <stdlib.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "extract/io/error.h"
#include "extract/io/outputs.h"
#include "extract/video/container.h"
#include "extract/video/packet_times.h"

namespace stride::video {
namespace fs = std::filesystem;
namespace {

/// Whether a file has the boxes of an mp4 or mov but no `moov`, the index that is written last: an
/// unfinished recording or a truncated copy.
bool is_mp4_without_index(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::uintmax_t size = fs::file_size(file);
  std::uintmax_t offset = 0;
  bool first = true;
  while (offset + 8 <= size) {
    unsigned char header[16] = {};
    in.seekg(static_cast<std::streamoff>(offset));
    in.read(reinterpret_cast<char*>(header), sizeof header);
    in.clear();
    const std::string type(reinterpret_cast<char*>(header) + 4, 4);
    if (first && type != "ftyp") return false;
    first = false;
    if (type == "moov") return false;
    std::uintmax_t length = 0;
    for (int i = 0; i < 4; ++i) length = length << 8 | header[i];
    if (length == 1) {
      length = 0;
      for (int i = 8; i < 16; ++i) length = length << 8 | header[i];
    }
    if (length < 8) break;
    offset += length;
  }
  return !first;
}

/// Not the unit of the times, which streams without a container announce.
bool is_rate(double rate_hz) { return rate_hz > 0 && rate_hz < 1e5; }

/// By the first two frames; 30 where they do not tell.
double first_rate_hz(const fs::path& file) {
  cv::VideoCapture capture(ffmpeg_name(file), cv::CAP_FFMPEG);
  double times_ms[2] = {};
  for (double& time_ms : times_ms)
    if (capture.grab()) time_ms = capture.get(cv::CAP_PROP_POS_MSEC);
  const double rate_hz = 1000 / (times_ms[1] - times_ms[0]);
  return is_rate(rate_hz) ? rate_hz : 30;
}

/// Upright, in memory of its own.
cv::Mat turned(const cv::Mat& stored, const Turn& turn) {
  cv::Mat image;
  if (turn.transpose)
    cv::transpose(stored, image);
  else
    image = stored;
  if (turn.mirror_x || turn.mirror_y) {
    cv::Mat flipped;
    cv::flip(image, flipped, turn.mirror_x && turn.mirror_y ? -1 : turn.mirror_x ? 1 : 0);
    return flipped;
  }
  return image;
}

bool is_folder_of_images(const fs::path& folder) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (kind_of(entry.path()) == FileKind::image) return true;
  return false;
}

/// Throws Error, with the cure, for what is not a file: what people give to other programs.
void require_file(const fs::path& file) {
  constexpr const char* kSequence =
      "a sequence of images: make a video of it, ffmpeg -framerate 30 -i frame_%04d.png run.mp4 "
      "(at the rate of the camera)";
  const std::string name = file.string();
  std::error_code error;
  if (fs::is_directory(file, error)) {
    require(!is_folder_of_images(file), "{}: is {}", name, kSequence);
    throw Error(
        fmt::format("{}: is a folder, one video is needed (stride convert takes folders)", name));
  }
  if (fs::exists(file, error)) {
    require(fs::is_regular_file(file), "{}: is not a file, a video is needed", name);
    require(kind_of(file) != FileKind::unreadable, "{}: is a file that you may not read", name);
    return;
  }
  require(name.find("://") == name.npos,
          "{}: is an address (URL), a file is needed: download the video first", name);
  require(name.find('%') == name.npos && name.find('*') == name.npos,
          "{}: no such video; if it is {}", name, kSequence);
  require(name.empty() || name.find_first_not_of("0123456789") != name.npos,
          "{}: no such video; a camera cannot be read, record a video first", name);
  throw Error(fmt::format("{}: no such video", name));
}

/// Silences FFmpeg's messages; our errors say more.
void silence_ffmpeg() { ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", /*overwrite=*/0); }

}  // namespace

struct Video::Decoder {
  cv::VideoCapture capture;
  VideoInfo info;
  Turn turn;
  std::vector<double> stamps_s;  // where OpenCV's are not the file's
  double slow_motion = 1;
  cv::Mat stored;  // lies, or has pixels that are not square
  cv::Mat first;   // decoded on opening: only a decoded frame proves that this is a video
  int frames_read = 0;
  bool counts_frames = true;  // the file; else their number is guessed from how long it lasts
  double start_s = 0, previous_s = 0, step_s = 0;  // in presentation time

  /// Into the memory of `image` where nobody else keeps it.
  bool decode(cv::Mat& image) {
    if (image.u != nullptr && image.u->refcount > 1) image.release();
    const bool is_square = info.width_px == 0 || info.width_px == info.stored_width_px;
    if (turn.is_none() && is_square) return capture.read(image) && !image.empty();
    if (!capture.read(stored) || stored.empty()) return false;
    image = turned(stored, turn);
    if (is_square) return true;
    const cv::Mat upright = image;
    image.release();
    cv::resize(upright, image, {info.width_px, info.height_px}, 0, 0, cv::INTER_LINEAR);
    return true;
  }

  /// Presentation time of the frame decoded last, since the first one.
  double stamp() {
    const auto i = static_cast<std::size_t>(frames_read);
    const double stamp_s =
        i < stamps_s.size() ? stamps_s[i] : capture.get(cv::CAP_PROP_POS_MSEC) / 1000;
    if (frames_read == 0) {
      start_s = stamp_s;
      return 0;
    }
    double time_s = stamp_s - start_s;
    if (time_s > previous_s)
      step_s = time_s - previous_s;
    else
      time_s = previous_s + step_s;
    return time_s;
  }
};

Video::~Video() = default;
Video::Video(Video&&) noexcept = default;
Video& Video::operator=(Video&&) noexcept = default;

Video::Video(const fs::path& file, double slow_motion) : decoder_(std::make_unique<Decoder>()) {
  require_file(file);
  require(std::isfinite(slow_motion) && slow_motion > 0,
          "slow-motion factor = {}: must be positive (4: a second of the runner takes four)",
          slow_motion);
  silence_ffmpeg();
  Decoder& d = *decoder_;
  d.slow_motion = slow_motion;
  d.info.file = file;
  const Container container = read_container(file);
  d.turn = container.turn;
  d.info.turn = container.turn;
  d.info.capture_rate_hz = container.capture_rate_hz;
  d.info.edits = container.edits;
  d.counts_frames = container.format.find("mp4") != std::string::npos || container.format == "avi";
  if (container.codec == "apng") d.stamps_s = packet_times_s(file);  // OpenCV rounds to a 60th
  cv::Mat first;
  // OpenCV 4.6 turns by 90 degrees the wrong way: https://github.com/opencv/opencv/issues/22088
  const bool is_open = d.capture.open(ffmpeg_name(file), cv::CAP_FFMPEG);
  d.capture.set(cv::CAP_PROP_ORIENTATION_AUTO, 0);
  if (!is_open || !d.decode(first)) {
    require(!is_mp4_without_index(file),
            "{}: truncated: 0 frames readable, because the index at the end of the file is "
            "missing; copy or record it again",
            file.string());
    throw Error(fmt::format(
        "{}: not a video, or truncated: 0 frames readable; try to play it, and convert it to mp4",
        file.string()));
  }
  const double numerator = d.capture.get(cv::CAP_PROP_SAR_NUM),
               denominator = d.capture.get(cv::CAP_PROP_SAR_DEN);
  double aspect = numerator > 0 && denominator > 0 ? numerator / denominator : 1;
  if (d.turn.transpose) aspect = 1 / aspect;
  d.info.stored_width_px = first.cols;
  d.info.width_px = static_cast<int>(std::lround(first.cols * aspect));
  d.info.height_px = first.rows;
  const double announced_hz = d.capture.get(cv::CAP_PROP_FPS);
  const double rate_hz = is_rate(announced_hz) ? announced_hz : first_rate_hz(file);
  d.info.rate_hz = rate_hz * slow_motion;
  d.step_s = 1 / rate_hz;
  const double count = d.capture.get(cv::CAP_PROP_FRAME_COUNT);
  d.info.announced_frames = count > 0 && count < 1e9 ? static_cast<int>(count) : 0;
  if (first.cols != d.info.width_px)
    cv::resize(first, d.first, {d.info.width_px, d.info.height_px}, 0, 0, cv::INTER_LINEAR);
  else
    d.first = first;
}

const VideoInfo& Video::info() const { return decoder_->info; }

bool Video::read(VideoFrame& frame) {
  Decoder& d = *decoder_;
  if (d.frames_read == 0)
    frame.image = std::move(d.first);
  else if (!d.decode(frame.image))
    return false;
  d.previous_s = d.stamp();
  frame.index = d.frames_read++;
  frame.time_s = d.previous_s / d.slow_motion;
  return true;
}

std::string Video::shortfall() const {
  const Decoder& d = *decoder_;
  if (d.frames_read >= d.info.announced_frames) return {};
  const double announced_s = d.info.announced_frames * d.slow_motion / d.info.rate_hz;
  if (!d.counts_frames && d.start_s + d.previous_s + 1.5 * d.step_s >= announced_s) return {};
  return fmt::format(
      "{}: {} of the {} announced frames were readable: truncated, or cut without re-encoding",
      d.info.file.string(), d.frames_read, d.info.announced_frames);
}

VideoTimes video_times(const std::filesystem::path& file, double slow_motion) {
  Video video(file, slow_motion);
  VideoTimes times{video.info(), {}, {}};
  VideoFrame frame;
  while (video.read(frame)) times.times_s.push_back(frame.time_s);
  times.shortfall = video.shortfall();
  return times;
}

void require_video_file(const fs::path& file) { require_file(file); }

}  // namespace stride::video
