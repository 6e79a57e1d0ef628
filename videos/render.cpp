#include "videos/render.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "extract/io/error.h"
#include "extract/io/random.h"
#include "videos/costume.h"
#include "videos/scenery.h"

namespace stride::videos {
namespace {

HumanLook woman() {
  HumanLook look;
  look.skin = rgb(150, 100, 72);
  look.hair = rgb(30, 24, 24);
  look.shirt = rgb(116, 60, 150);
  look.shirt_band = rgb(250, 214, 90);
  look.shorts = rgb(30, 32, 38);
  look.stripe = rgb(250, 214, 90);
  look.shoe = rgb(236, 84, 110);
  look.ponytail = true;
  return look;
}

HumanLook veteran() {
  HumanLook look;
  look.skin = rgb(226, 180, 152);
  look.hair = rgb(176, 172, 166);
  look.shirt = rgb(50, 130, 110);
  look.shirt_band = rgb(226, 236, 230);
  look.shorts = rgb(120, 104, 82);
  look.stripe = rgb(90, 78, 62);
  look.sock = rgb(60, 62, 70);
  look.shoe = rgb(60, 84, 170);
  return look;
}

std::unique_ptr<Costume> make_costume(const Clip& clip) {
  const std::uint64_t seed = clip.seed + 1;
  if (clip.character == "man") return human_costume(seed);
  if (clip.character == "woman") return human_costume(seed, woman());
  if (clip.character == "veteran") return human_costume(seed, veteran());
  if (clip.character == "game") return game_costume(seed);
  if (clip.character == "cartoon") return cartoon_costume();
  if (clip.character == "markers") return marker_costume();
  throw Error(fmt::format("clip {}: character '{}': is none", clip.name, clip.character));
}

std::unique_ptr<Scenery> make_scene(const Clip& clip) {
  const std::uint64_t seed = clip.seed + 2;
  if (clip.scene == "track") return track_scene(seed);
  if (clip.scene == "street") return street_scene(seed);
  if (clip.scene == "gym") return gym_scene(seed);
  if (clip.scene == "arena") return arena_scene(seed);
  if (clip.scene == "meadow") return meadow_scene();
  if (clip.scene == "dark") return dark_scene();
  throw Error(fmt::format("clip {}: scene '{}': is none", clip.name, clip.scene));
}

/// Applies lens and sensor to the light of a frame.
cv::Mat developed(const cv::Mat& light, const Clip& clip, int index) {
  Random random(clip.seed * 104729 + static_cast<std::uint64_t>(index));
  cv::Mat picture(light.size(), CV_8UC3);
  for (int v = 0; v < light.rows; ++v)
    for (int u = 0; u < light.cols; ++u) {
      const double x = 2.0 * u / light.cols - 1, y = 2.0 * v / light.rows - 1;
      const double vignette = 1 - clip.vignette * (x * x + y * y);
      for (int c = 0; c < 3; ++c) {
        const double value = 255 * vignette * light.at<Colour>(v, u)[c];
        const double noise = clip.noise_grey > 0 ? clip.noise_grey * normal(random) : 0;
        picture.at<cv::Vec3b>(v, u)[c] = cv::saturate_cast<uchar>(value + noise);
      }
    }
  return picture;
}

}  // namespace

struct Renderer::Parts {
  Motion motion;
  std::unique_ptr<Costume> costume;
  std::unique_ptr<Scenery> scene;
};

Renderer::Renderer(const Clip& clip)
    : parts_(new Parts{Motion(clip), make_costume(clip), make_scene(clip)}) {}
Renderer::~Renderer() = default;

cv::Mat Renderer::frame(int index) const {
  const Motion& motion = parts_->motion;
  const Clip& clip = motion.clip();
  cv::Mat sample(clip.height_px, clip.width_px, CV_32FC3), sum(sample.size(), CV_32FC3);
  sum.setTo(cv::Scalar::all(0));
  std::mt19937_64 jitter(clip.seed * 7919 + static_cast<std::uint64_t>(index));
  for (int i = 0; i < clip.samples; ++i) {
    // The samples of a pixel lie on a rotated lattice over its area and equally spaced in time.
    const double du = (i + uniform(jitter)) / clip.samples - 0.5;
    const double dv = ((i * 5 + 2) % clip.samples + uniform(jitter)) / clip.samples - 0.5;
    const double open = clip.shutter * (((i * 3 + 1) % clip.samples + 0.5) / clip.samples - 0.5);
    const double time_s = clip.time_s(index + open);
    const Skeleton skeleton = motion.skeleton(time_s);
    const PinholeCamera camera = motion.camera(time_s);
    parts_->scene->paint(camera, du, dv, cast_shadow(skeleton), motion.belt_m(time_s), sample);
    paint(parts_->scene->behind(clip.to_left), camera, du, dv, sample);
    paint(parts_->costume->dress(skeleton, clip.proportions, clip.to_left), camera, du, dv, sample);
    paint(parts_->scene->before(clip.to_left), camera, du, dv, sample);
    sum += sample;
  }
  sum /= clip.samples;
  return developed(sum, clip, index);
}

void write_video(const Clip& clip, const std::filesystem::path& file,
                 const std::function<void(int)>& progress) {
  require(clip.width_px % 2 == 0 && clip.height_px % 2 == 0,
          "clip {}: {}×{} px: H.264 wants even sizes; choose another scale", clip.name,
          clip.width_px, clip.height_px);
  cv::VideoWriter writer(file.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('a', 'v', 'c', '1'),
                         clip.rate_hz, {clip.width_px, clip.height_px});
  require(writer.isOpened(), "{}: cannot be written as H.264 by this OpenCV", file.string());
  const Renderer renderer(clip);
  for (int i = 0; i < clip.frames; ++i) {
    writer.write(renderer.frame(i));
    if (progress) progress(i);
  }
}

}  // namespace stride::videos
