// One run filmed in different ways gives the same potential within its stated uncertainty.
#include <gtest/gtest.h>

#include "shaping/keyframes.h"
#include "tests/calibrate/rendered.h"
#include "videos/variant.h"

namespace stride {
namespace {

using videos::Clip;

Potential potential_of(const Clip& clip, unsigned seed) {
  const SagittalModel model = sagittal_model(osim::load_osim(osim::default_model_file()));
  const Calibration found = calibrate(
      observed(clip, {.every_frame = true, .noise_px = clip.click_sd_px, .seed = seed}), model);
  EXPECT_EQ(found.verdict.text(), "ok") << clip.name;
  return make_potential(found.run, {}, clip.name);
}

struct Difference {
  int inside = 0, all = 0;  // numbers of the keyframes, by the 95 % band of their difference
  double greatest = 0;      // standard deviations
};

Difference compare(const Potential& a, const Potential& b) {
  Difference d;
  const auto add = [&](double x, double y, double sd_x, double sd_y) {
    const double z = std::abs(x - y) / std::hypot(sd_x, sd_y);
    d.inside += z < 1.96 ? 1 : 0;
    d.greatest = std::max(d.greatest, z);
    ++d.all;
  };
  for (std::size_t k = 0; k < a.keyframes.size(); ++k) {
    const Keyframe &p = a.keyframes[k], &q = b.keyframes[k];
    for (std::size_t i = 0; i < kPoseNumbers; ++i)
      add(p.pose.m[i], q.pose.m[i], p.sd.m[i], q.sd.m[i]);
  }
  return d;
}

struct Filmed {
  const char* how;
  Clip clip;
};

class SameRun : public testing::TestWithParam<Filmed> {};

TEST_P(SameRun, MakesTheSamePotential) {
  static const Potential reference = potential_of(videos::clip("human"), 1);
  const Potential other = potential_of(GetParam().clip, 2);
  EXPECT_NEAR(other.period_s, reference.period_s,
              3 * std::hypot(other.period_sd_s, reference.period_sd_s));
  const Difference d = compare(reference, other);
  EXPECT_GE(d.inside, d.all * 90 / 100) << d.greatest << " standard deviations at most";
  EXPECT_LT(d.greatest, 4);
}

std::vector<Filmed> displacements() {
  const Clip clip = videos::clip("human");
  return {{"Again", clip},
          {"RightToLeft", videos::from_other_side(clip)},
          {"Static", videos::from_one_place(clip)},
          {"HalfTheResolution", videos::resized(clip, 0.5)},
          {"At24Frames", videos::at_rate(clip, 24)},
          {"At60Frames", videos::at_rate(clip, 60)},
          {"InSlowMotion", videos::in_slow_motion(clip, 4)}};
}

INSTANTIATE_TEST_SUITE_P(Filmed, SameRun, testing::ValuesIn(displacements()),
                         [](const auto& filmed) { return std::string(filmed.param.how); });

}  // namespace
}  // namespace stride
