#include "extract/video/packet_times.h"

extern "C" {
#include <libavformat/avformat.h>
}

#include <algorithm>
#include <memory>

#include "extract/video/container.h"

namespace stride::video {
namespace {

struct FreePacket {
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};

}  // namespace

std::vector<double> packet_times_s(const std::filesystem::path& file) {
  AVFormatContext* opened = nullptr;
  if (avformat_open_input(&opened, ffmpeg_name(file).c_str(), nullptr, nullptr) < 0) return {};
  const std::unique_ptr<AVFormatContext, CloseInput> context(opened);
  const std::unique_ptr<AVPacket, FreePacket> packet(av_packet_alloc());
  const int stream = av_find_best_stream(opened, AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
  if (stream < 0 || packet == nullptr) return {};
  const double unit_s = av_q2d(context->streams[stream]->time_base);
  std::vector<double> times_s;
  while (av_read_frame(opened, packet.get()) == 0) {
    if (packet->stream_index == stream && packet->pts != AV_NOPTS_VALUE)
      times_s.push_back(static_cast<double>(packet->pts) * unit_s);
    av_packet_unref(packet.get());
  }
  std::ranges::sort(times_s);
  return times_s;
}

}  // namespace stride::video
