#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>

#include "extract/error.h"
#include "videos/render.h"
#include "videos/sheet.h"
#include "videos/truth.h"

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
  CLI11_PARSE(app, argc, argv);

  using namespace stride::videos;
  if (list) {
    for (const Clip& clip : clips())
      std::cout << fmt::format("{:<12} {}×{} {:>4} Hz {:>4} frames  {}\n", clip.name, clip.width_px,
                               clip.height_px, clip.rate_hz, clip.frames, clip.description);
    return 0;
  }
  if (!sheet.empty()) {
    write_sheet(clips(), folder, sheet);
    std::cout << sheet.string() << '\n';
    return 0;
  }
  std::filesystem::create_directories(folder);
  if (names.empty())
    for (const Clip& clip : clips()) names.push_back(clip.name);
  for (const std::string& name : names) {
    const Clip clip = stride::videos::clip(name);
    const auto video = folder / (name + ".mp4");
    if (!truth_only)
      write_video(clip, video, [&](int frame) {
        std::cerr << fmt::format("\r{}: frame {} of {}", name, frame + 1, clip.frames);
      });
    std::cerr << '\n';
    write_truth(clip, video);
    std::cout << video.string() << '\n';
  }
} catch (const stride::Error& error) {
  std::cerr << "render_videos: " << error.what() << '\n';
  return 1;
}
