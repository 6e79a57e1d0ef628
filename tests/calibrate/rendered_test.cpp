// The fit against the truth of the three kinds of rendered runners, from noisy clicks at the
// paper's rate; `fit_accuracy` measures the same over many seeds.
#include "tests/calibrate/rendered.h"

#include <gtest/gtest.h>

namespace stride {
namespace {

struct Kind {
  const char* clip;
  double most_rms_m;  // of any knee or ankle
};

class Rendered : public testing::TestWithParam<Kind> {};

TEST_P(Rendered, RunnersOfOtherProportionsAndCamerasAreFitted) {
  constexpr unsigned kSeeds = 4;
  const SagittalModel model = sagittal_model(osim::load_osim(osim::default_model_file()));
  int inside = 0, coordinates = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const videos::Clip clip = varied(videos::clip(GetParam().clip), seed);
    fit::FitOptions options;
    options.leg_m = known_leg(clip, seed);
    const Calibration found = calibrate(
        observed(clip, {.every_frame = false, .noise_px = clip.click_sd_px, .seed = seed}), model,
        options);
    ASSERT_FALSE(found.verdict.refused) << "seed " << seed << ": " << found.verdict.text();
    const Accuracy a = accuracy(found, clip, model);
    EXPECT_LT(std::abs(a.period), 0.005) << "seed " << seed;
    EXPECT_LT(std::abs(a.scale_z), 3) << "seed " << seed;
    EXPECT_LT(a.worst_rms_m(), GetParam().most_rms_m) << "seed " << seed;
    inside += a.inside;
    coordinates += a.coordinates;
  }
  EXPECT_GT(inside, 0.85 * coordinates);  // of few clips, whose coordinates are much alike
}

INSTANTIATE_TEST_SUITE_P(Runners, Rendered,
                         testing::Values(Kind{"human", 0.02}, Kind{"game", 0.025},
                                         Kind{"cartoon", 0.025}),
                         [](const auto& kind) { return std::string(kind.param.clip); });

}  // namespace
}  // namespace stride
