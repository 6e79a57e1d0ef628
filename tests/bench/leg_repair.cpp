// Share of frames with the right legs after repair, over 200 seeded cases of swapped legs in three
// clips.
#include <fmt/format.h>

#include <array>

#include "tests/support/spoiled_legs.h"

namespace {

using namespace stride;

enum class Parts { all, without_hips, knees_and_ankles };

bool is_left_out(BodyPart part, Parts parts) {
  const bool hip = part == BodyPart::hip_r || part == BodyPart::hip_l,
             toe = part == BodyPart::toe_r || part == BodyPart::toe_l;
  return parts == Parts::without_hips ? hip : parts == Parts::knees_and_ankles && (hip || toe);
}

/// `every`: one frame of so many.
void print_share(const char* what, Parts parts, std::array<const char*, 3> clips, int every) {
  constexpr unsigned kCases = 200;
  int all_right = 0, all_frames = 0;
  for (unsigned seed = 0; seed < kCases; ++seed) {
    Trajectory truth =
        detected(fmt::format(STRIDE_SOURCE_DIR "/videos/{}.truth.csv", clips[seed % clips.size()]));
    std::erase_if(truth.frames,
                  [&](const TrajectoryFrame& frame) { return frame.frame % every != 0; });
    for (TrajectoryFrame& frame : truth.frames)
      for (const BodyPart part : kAskedParts)
        if (is_left_out(part, parts)) frame[part] = Point();
    all_right += repaired(spoiled(truth, seed));
    all_frames += static_cast<int>(truth.frames.size());
  }
  fmt::print("| {} | {} | {} | {:.2f} % |\n", what, kCases, all_frames,
             100.0 * all_right / all_frames);
}

}  // namespace

int main() {
  constexpr std::array at_30{"human", "game", "left"}, at_24{"cartoon", "small", "cartoon"};
  fmt::print("| seen beside the pelvis | cases | frames | right |\n|---|---|---|---|\n");
  print_share("hips, knees, ankles, toes at 30 Hz", Parts::all, at_30, 1);
  print_share("knees, ankles, toes at 30 Hz", Parts::without_hips, at_30, 1);
  print_share("knees, ankles at 30 Hz", Parts::knees_and_ankles, at_30, 1);
  print_share("knees, ankles, toes at 24 Hz", Parts::without_hips, at_24, 1);
  print_share("knees, ankles at 24 Hz", Parts::knees_and_ankles, at_24, 1);
  print_share("knees, ankles at 15 Hz", Parts::knees_and_ankles, at_30, 2);
}
