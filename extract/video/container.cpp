#include "extract/video/container.h"

extern "C" {
#include <libavformat/avformat.h>
#include <libavutil/display.h>
}

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace stride::video {
namespace {

/// The nearest turn by right angles. The matrix maps (x, y) to (a x + c y, b x + d y).
Turn turn_of(const std::int32_t* matrix) {
  const double a = matrix[0], b = matrix[1], c = matrix[3], d = matrix[4];
  if (std::abs(a) + std::abs(d) >= std::abs(b) + std::abs(c)) return {false, a < 0, d < 0};
  return {true, c < 0, b < 0};
}

Turn turn_of(const AVStream& stream) {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
#if LIBAVFORMAT_VERSION_MAJOR < 60
  data = av_stream_get_side_data(&stream, AV_PKT_DATA_DISPLAYMATRIX, &size);
#else
  const AVCodecParameters& codec = *stream.codecpar;
  if (const AVPacketSideData* found = av_packet_side_data_get(
          codec.coded_side_data, codec.nb_coded_side_data, AV_PKT_DATA_DISPLAYMATRIX)) {
    data = found->data;
    size = found->size;
  }
#endif
  std::int32_t matrix[9];
  if (data == nullptr || size < sizeof matrix) return {};
  std::memcpy(matrix, data, sizeof matrix);
  return turn_of(matrix);
}

/// Android's cameras say at which rate they recorded.
double capture_rate_hz(const AVDictionary* metadata) {
  const AVDictionaryEntry* entry = av_dict_get(metadata, "com.android.capture.fps", nullptr, 0);
  const double rate_hz = entry == nullptr ? 0 : std::strtod(entry->value, nullptr);
  return rate_hz > 0 && rate_hz < 1e5 ? rate_hz : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void CloseInput::operator()(AVFormatContext* context) const { avformat_close_input(&context); }

std::string ffmpeg_name(const std::filesystem::path& file) {
  return "file:" + std::filesystem::absolute(file).string();
}

Container read_container(const std::filesystem::path& file) {
  av_log_set_level(AV_LOG_QUIET);  // our errors say more than its lines on stderr
  AVFormatContext* opened = nullptr;
  if (avformat_open_input(&opened, ffmpeg_name(file).c_str(), nullptr, nullptr) < 0) return {};
  const std::unique_ptr<AVFormatContext, CloseInput> context(opened);
  Container container;
  container.format = context->iformat->name;
  if (container.format.find("mp4") != std::string::npos) container.edits = read_edits(file);
  container.capture_rate_hz = capture_rate_hz(context->metadata);
  for (unsigned i = 0; i < context->nb_streams; ++i) {
    const AVStream& stream = *context->streams[i];
    if (stream.codecpar->codec_type != AVMEDIA_TYPE_VIDEO) continue;
    container.codec = avcodec_get_name(stream.codecpar->codec_id);
    container.turn = turn_of(stream);
    if (std::isnan(container.capture_rate_hz))
      container.capture_rate_hz = capture_rate_hz(stream.metadata);
    break;
  }
  return container;
}

std::string text_of(const Turn& turn) {
  if (turn.is_none()) return {};
  const bool mirrored = turn.transpose != (turn.mirror_x != turn.mirror_y);
  if (mirrored) return turn.transpose ? "turned and mirrored" : "mirrored";
  if (!turn.transpose) return "turned by 180 degrees";
  return turn.mirror_x ? "turned by 90 degrees" : "turned by 270 degrees";
}

}  // namespace stride::video
