#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "extract/io/error.h"
#include "videos/render.h"
#include "videos/sheet.h"
#include "videos/truth.h"
#include "videos/variant.h"

namespace {

using namespace stride::videos;

/// Variations of a clip.
struct Filming {
  std::string name;
  std::uint64_t seed = 0;
  double rate_hz = 0, scale = 1, slow_motion = 1, tilt_px = 0, zoom = 0;
  bool other_side = false, one_place = false;
};

Clip filmed(Clip clip, const Filming& filming) {
  stride::require(filming.rate_hz >= 0 && filming.scale > 0 && filming.slow_motion > 0,
                  "--rate {}, --scale {}, --slow-motion {}: must be positive", filming.rate_hz,
                  filming.scale, filming.slow_motion);
  const bool otherwise = filming.seed > 0 || filming.rate_hz > 0 || filming.scale != 1 ||
                         filming.slow_motion != 1 || filming.other_side || filming.one_place ||
                         filming.tilt_px != 0 || filming.zoom != 0;
  stride::require(!otherwise || !filming.name.empty(),
                  "clip {}: filmed otherwise it is another clip; give it a --name", clip.name);
  if (!filming.name.empty()) clip.name = filming.name;
  if (filming.seed > 0) clip.seed = filming.seed;
  if (filming.rate_hz > 0) clip = at_rate(clip, filming.rate_hz);
  if (filming.scale != 1) clip = resized(clip, filming.scale);
  if (filming.slow_motion != 1) clip = in_slow_motion(clip, filming.slow_motion);
  if (filming.other_side) clip = from_other_side(clip);
  if (filming.one_place) clip = from_one_place(clip);
  if (filming.tilt_px != 0) clip.tilt_px = filming.tilt_px;
  if (filming.zoom != 0) clip.zoom = filming.zoom;
  return clip;
}

}  // namespace

int main(int argc, char** argv) try {
  CLI::App app("Renders the clips of videos/ with their truth and their clicks");
  std::vector<std::string> names;
  std::filesystem::path folder = "videos";
  std::filesystem::path sheet;
  bool list = false, truth_only = false;
  app.add_option("clip", names, "clips to render; all if none is named");
  app.add_option("-o,--out", folder, "folder to write to")->capture_default_str();
  app.add_flag("--list", list, "list the clips and end");
  app.add_flag("--truth-only", truth_only, "keep the video, write its truth and clicks anew");
  app.add_option("--sheet", sheet, "only write a contact sheet (JPEG) of the clips in the folder");
  Filming filming;
  app.add_option("--name", filming.name, "name of the files, where a clip is filmed otherwise");
  app.add_option("--seed", filming.seed, "another seed: other noise, camera and deviations");
  app.add_option("--rate", filming.rate_hz, "frames a second");
  app.add_option("--scale", filming.scale, "size of the frames, in times the clip's own");
  app.add_option("--slow-motion", filming.slow_motion, "seconds of video a second of the runner");
  app.add_flag("--other-side", filming.other_side, "from the runner's other side");
  app.add_flag("--one-place", filming.one_place, "by a camera that stands");
  app.add_option("--tilt", filming.tilt_px, "by how many pixels a tilting camera's picture sinks");
  app.add_option("--zoom", filming.zoom,
                 "growth of the focal length over the clip, 0.2: by a fifth");
  CLI11_PARSE(app, argc, argv);

  std::vector<Clip> all = clips();
  for (const Clip& jump : jumps()) all.push_back(jump);

  if (list) {
    for (const Clip& clip : all)
      std::cout << fmt::format("{:<12} {}×{} {:>4} Hz {:>4} frames  {}\n", clip.name, clip.width_px,
                               clip.height_px, clip.rate_hz, clip.frames, clip.description);
    return 0;
  }
  if (!sheet.empty()) {
    if (!names.empty()) {
      all.clear();
      for (const std::string& name : names) all.push_back(stride::videos::clip(name));
    }
    write_sheet(all, folder, sheet);
    std::cout << sheet.string() << '\n';
    return 0;
  }
  std::filesystem::create_directories(folder);
  if (names.empty())
    for (const Clip& clip : all) names.push_back(clip.name);
  stride::require(filming.name.empty() || names.size() == 1,
                  "--name {}: names one clip, and {} are to be rendered; name one", filming.name,
                  names.size());
  for (const std::string& name : names) {
    const Clip clip = filmed(stride::videos::clip(name), filming);
    const auto video = folder / (clip.name + ".mp4");
    if (!truth_only)
      write_video(clip, video, [&](int frame) {
        std::cerr << fmt::format("\r{}: frame {} of {}", clip.name, frame + 1, clip.frames);
      });
    std::cerr << '\n';
    write_truth(clip, video);
    std::cout << video.string() << '\n';
  }
} catch (const stride::Error& error) {
  std::cerr << "render_videos: " << error.what() << '\n';
  return 1;
}
