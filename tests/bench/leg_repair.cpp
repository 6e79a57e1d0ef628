// 200 seeded cases of swapped legs over three clips: what share of the frames comes out right.
#include <fmt/format.h>

#include "tests/support/spoiled_legs.h"

int main() {
  using namespace stride;
  constexpr unsigned kCases = 200;
  const std::array clips{"human", "game", "left"};
  int all_right = 0, all_frames = 0;
  for (std::size_t k = 0; k < clips.size(); ++k) {
    const Trajectory truth =
        detected(fmt::format(STRIDE_SOURCE_DIR "/videos/{}.truth.csv", clips[k]));
    int right = 0, frames = 0;
    for (unsigned seed = static_cast<unsigned>(k); seed < kCases; seed += clips.size()) {
      right += repaired(spoiled(truth, seed));
      frames += static_cast<int>(truth.frames.size());
    }
    fmt::print("{}: {} of {} frames right, {:.2f} %\n", clips[k], right, frames,
               100.0 * right / frames);
    all_right += right;
    all_frames += frames;
  }
  fmt::print("{} cases: {:.2f} % of the frames right\n", kCases, 100.0 * all_right / all_frames);
}
