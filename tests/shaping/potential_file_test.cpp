#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "extract/io/file.h"
#include "shaping/potential.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/throws.h"

namespace stride {
namespace {

std::string hamner_text() { return read_file(STRIDE_TEST_DATA "/hamner.potential.json"); }

/// The text with the first `from` replaced by `to`.
std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(PotentialFile, ReadsBackEveryDoubleAsItWas) {
  const TemporaryFolder folder;
  Potential potential = load_potential(STRIDE_TEST_DATA "/hamner.potential.json");
  potential.weight = 1.0 / 3;
  potential.epsilon_m = 1e-300;
  potential.keyframes[5].pose[PosePart::foot_l].x() = std::nextafter(0.1, 1);
  potential.keyframes[5].sd[PosePart::foot_l].x() = std::nan("");
  potential.function = InverseDistance::pf2;
  potential.index = PotentialIndex::nearest;
  save(potential, folder / "p.json");
  const Potential loaded = load_potential(folder / "p.json");
  EXPECT_EQ(loaded.weight, 1.0 / 3);
  EXPECT_EQ(loaded.epsilon_m, 1e-300);
  EXPECT_EQ(loaded.keyframes[5].pose[PosePart::foot_l],
            potential.keyframes[5].pose[PosePart::foot_l]);
  EXPECT_TRUE(std::isnan(loaded.keyframes[5].sd[PosePart::foot_l].x()));
  EXPECT_EQ(loaded.keyframes[5].sd[PosePart::foot_l].y(), 0.01);
  EXPECT_TRUE(std::isnan(loaded.rms_px));
  EXPECT_EQ(loaded.function, InverseDistance::pf2);
  EXPECT_EQ(loaded.index, PotentialIndex::nearest);
  EXPECT_EQ(loaded.source, "hamner_subject02_3p96");
}

TEST(PotentialFile, NamesWhatIsWrongInAnotherFile) {
  const TemporaryFolder folder;
  const auto load = [&](const std::string& text) {
    write_file_atomically(folder / "p.json", text);
    return load_potential(folder / "p.json");
  };
  EXPECT_ERROR(load_potential(folder / "none.json"), "none.json: no such file");
  EXPECT_ERROR(load("# stride calibrated 1\n"), "is a table, a potential is needed");
  EXPECT_ERROR(load("no"), "p.json: is a text, a potential is needed");
  EXPECT_ERROR(load("{}"), "p.json: is not a potential: the key format");
  EXPECT_ERROR(load(with(hamner_text(), "\"version\": 1", "\"version\": 2")),
               "version = 2: this program reads version 1; make the file anew");
  EXPECT_ERROR(load(with(hamner_text(), "\"pf3\"", "\"pf9\"")),
               "function = 'pf9': must be one of pf1, pf2, pf3, pf4");
  EXPECT_ERROR(load(with(hamner_text(), "0.6899", "0")), "stride.period_s = 0: must be positive");
  EXPECT_ERROR(load(with(hamner_text(), "0.6899", "NaN")), "p.json: not valid JSON");
  EXPECT_ERROR(load(with(hamner_text(), "0.6899", "1e999")), "p.json: not valid JSON");
  EXPECT_ERROR(load(with(hamner_text(), "\"phase\": 0.125", "\"phase\": 0.2")),
               "keyframes[1].phase = 0.2: must be 0.125");
  EXPECT_ERROR(load(with(hamner_text(), "\"phase\": 0.125", "\"phase\": null")),
               "keyframes[1].phase = null: must be a number");
  EXPECT_ERROR(load(with(hamner_text(), "\"knee_r_m\": [", "\"knee_r_m\": [0,")),
               "keyframes[0].knee_r_m = ");
  EXPECT_ERROR(load(with(hamner_text(), "\"weight\"", "\"wieght\"")), "weight is missing");
}

TEST(PotentialFile, TellsWhatNoPersonDoes) {
  const Potential hamner = load_potential(STRIDE_TEST_DATA "/hamner.potential.json");
  require_human(hamner, "p.json");
  const auto spoilt = [&](const auto& spoil) {
    Potential potential = hamner;
    spoil(potential);
    require_human(potential, "p.json");
  };
  const auto each = [&](const auto& spoil) {
    spoilt([&](Potential& p) {
      for (Keyframe& keyframe : p.keyframes) spoil(keyframe.pose);
    });
  };
  EXPECT_ERROR(each([](Pose& pose) {
                 const Eigen::Vector2d knee = pose[PosePart::knee_r];
                 pose[PosePart::knee_r] = pose[PosePart::foot_r];
                 pose[PosePart::foot_r] = knee;
               }),
               "from pelvis to knee is");
  EXPECT_ERROR(each([](Pose& pose) {
                 for (const PosePart part :
                      {PosePart::knee_r, PosePart::foot_r, PosePart::knee_l, PosePart::foot_l})
                   pose[part].reverseInPlace();
               }),
               "y grows upwards");
  EXPECT_ERROR(each([](Pose& pose) {
                 for (std::size_t i = 1; i < pose.m.size(); ++i) pose.m[i] *= -1;
               }),
               "the feet are at y = 0.70 m from the pelvis");
  EXPECT_ERROR(each([](Pose& pose) {
                 for (double& m : pose.m) m *= 0.5;
               }),
               "is it in m?");
  EXPECT_ERROR(spoilt([](Potential& p) { p.keyframes[2].pose[PosePart::foot_l].x() = 1e100; }),
               "from knee to foot is 1e+100 m");
  EXPECT_ERROR(spoilt([](Potential& p) { p.speed_m_s = -3; }), "goes backward");
}

TEST(PotentialFile, RefusesToWriteWhatItWouldNotRead) {
  const TemporaryFolder folder;
  Potential potential = load_potential(STRIDE_TEST_DATA "/hamner.potential.json");
  potential.keyframes[2].pose[PosePart::knee_l].y() = std::nan("");
  EXPECT_ERROR(save(potential, folder / "p.json"),
               "keyframes[2] has a coordinate that is not finite");
  EXPECT_FALSE(std::filesystem::exists(folder / "p.json"));
}

}  // namespace
}  // namespace stride
