// 200 seeded cases of swapped legs over three clips: what share of the frames comes out right.
#include <fmt/format.h>

#include <array>

#include "tests/support/spoiled_legs.h"

namespace {

using namespace stride;

void print_share(const char* what, bool few) {
  constexpr unsigned kCases = 200;
  const std::array clips{"human", "game", "left"};
  int all_right = 0, all_frames = 0;
  for (unsigned seed = 0; seed < kCases; ++seed) {
    Trajectory truth =
        detected(fmt::format(STRIDE_SOURCE_DIR "/videos/{}.truth.csv", clips[seed % clips.size()]));
    if (few) {
      std::erase_if(truth.frames,
                    [](const TrajectoryFrame& frame) { return frame.frame % 2 == 1; });
      for (TrajectoryFrame& frame : truth.frames)
        for (const BodyPart part : kBodyParts)
          if (std::ranges::find(kRequiredParts, part) == kRequiredParts.end())
            frame[part] = Point();
    }
    all_right += repaired(spoiled(truth, seed));
    all_frames += static_cast<int>(truth.frames.size());
  }
  fmt::print("{}: {} cases, {:.2f} % of {} frames right\n", what, kCases,
             100.0 * all_right / all_frames, all_frames);
}

}  // namespace

int main() {
  print_share("hips, knees, ankles, toes at 30 Hz", false);
  print_share("knees and ankles at 15 Hz", true);
}
