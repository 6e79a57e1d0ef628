// Steps an environment under the actions of a file, for comparison with the Python module:
//   episode_bytes RULES DIFFICULTY ENGINE SEED ACTIONS OUT
// ACTIONS holds rows of 18 doubles. OUT gets, of each step, the 41 observations of the competition,
// reward, terminated and truncated as doubles. After the end of an episode the next row starts that
// of SEED + 1, …
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "train/environment/runner_environment.h"
#include "train/simulation/competition/sensors.h"

int main(int argc, char** argv) {
  using namespace stride;
  if (argc != 7) return 2;
  environment::RunnerOptions options;
  options.rules = competition::rules_named(argv[1]);
  options.difficulty = std::stoi(argv[2]);
  options.engine = argv[3];
  std::uint64_t seed = std::stoull(argv[4]);
  std::ifstream actions(argv[5], std::ios::binary);
  std::ofstream out(argv[6], std::ios::binary);
  environment::RunnerEnvironment runner(osim::load_osim(osim::default_model_file()), options);
  const auto put = [&](const double* values, std::size_t count) {
    out.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(8 * count));
  };
  put(runner.reset(seed).data(), competition::Sensors::kCompetition);
  Eigen::VectorXd action(18);
  bool over = false;
  while (actions.read(reinterpret_cast<char*>(action.data()), 18 * 8)) {
    if (over) {
      put(runner.reset(++seed).data(), competition::Sensors::kCompetition);
      over = false;
      continue;
    }
    const environment::Step& step = runner.step(action);
    over = step.terminated || step.truncated;
    put(step.observation.data(), competition::Sensors::kCompetition);
    const double rest[] = {step.reward, double(step.terminated), double(step.truncated)};
    put(rest, 3);
  }
  return out ? 0 : 1;
}
