#include <gtest/gtest.h>

#include <fmt/format.h>

#include "tests/train/engines.h"
#include "tests/train/rollout.h"

namespace stride {
namespace {

const char* const kScenarios[] = {"zero",
                                  "all005",
                                  "all1",
                                  "random_seed1",
                                  "onehot_vasti_r",
                                  "onehot_soleus_r",
                                  "onehot_glut_max_r",
                                  "onehot_hamstrings_r"};

class Rollout : public testing::TestWithParam<std::tuple<const char*, const char*>> {
 protected:
  /// Follows a recorded rollout until its runner has fallen; angles and positions.
  void follow(const std::string& file, bool equilibrate) {
    const auto [name, scenario] = GetParam();
    const Reference recorded(file + scenario + ".csv");
    const Model model = load_osim(default_model_file());
    EngineOptions options;
    options.accuracy = 1e-7;
    const auto engine = make_engine(name, model, options);
    engine->set_state(default_state(model));
    if (equilibrate) engine->equilibrate_fibers();
    const auto excitations = recorded_excitations(scenario);
    int evaluations = 0;
    double worst = 0, worst_early = 0;
    std::size_t row = 0;
    for (int step = 0;; ++step) {
      const double time = 0.01 * step;
      if (std::abs(recorded.number(row, "t_s") - time) < 1e-9) {
        if (recorded.number(row, "done") != 0) break;
        const double tolerance = time < 0.2001 ? 1e-5 : 1e-4;
        const auto expected = recorded_coordinates(recorded, row);
        for (int i = 0; i < kCoordinates; ++i) {
          const double error = std::abs(engine->state().q[i] - expected[i]);
          EXPECT_LE(error, tolerance) << "coordinate " << i << " at " << time << " s";
          (time < 0.2001 ? worst_early : worst) =
              std::max(error, time < 0.2001 ? worst_early : worst);
        }
        if (++row == recorded.rows.size()) break;
      }
      const AdvanceReport report = engine->advance(excitations[step], 0.01);
      ASSERT_TRUE(report.ok) << report.failure;
      evaluations += report.evaluations;
    }
    EXPECT_GT(row, 20u);
    fmt::print("{} {}{}: {:.1e} to 0.2 s, {:.1e} after; {} evaluations\n", name, file, scenario,
               worst_early, worst, evaluations);
  }
};

TEST_P(Rollout, FromEquilibriumIsOpenSims) { follow("rollout_noblocks_eqstart_", true); }

TEST_P(Rollout, FromTheCompetitionsStartIsOpenSims) { follow("rollout_noblocks_", false); }

INSTANTIATE_TEST_SUITE_P(Engines, Rollout,
                         testing::Combine(testing::ValuesIn(kEngineNames),
                                          testing::ValuesIn(kScenarios)),
                         [](const auto& each) {
                           return std::string(std::get<0>(each.param)) + "_" +
                                  std::get<1>(each.param);
                         });

}  // namespace
}  // namespace stride
