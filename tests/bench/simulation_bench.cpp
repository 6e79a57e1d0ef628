#include <benchmark/benchmark.h>

#include "train/simulation/engine/engine.h"
#include "train/simulation/engine/runner_layout.h"
#include "train/simulation/laws/muscle.h"
#include "train/simulation/make_engine.h"
#include "train/simulation/planar/activation.h"
#include "train/simulation/planar/dynamics.h"
#include "train/simulation/planar/linear.h"
#include "train/simulation/planar/muscles.h"

namespace stride {
namespace {

using State = planar::PlanarDynamics::State;
using Fibers = planar::PlanarDynamics::Fibers;

/// The runner on its feet, fibres in equilibrium.
struct Standing {
  Standing()
      : model(osim::load_osim(osim::default_model_file())),
        dynamics(planar::planar_model(model), {}) {
    const auto engine = simulation::make_engine("planar", model);
    engine->equilibrate_fibers();
    const simulation::RunnerState& s = engine->state();
    for (int i = 0; i < simulation::kCoordinates; ++i)
      state.set_q(dynamics.model().coordinate[i], s.q[i]);
    for (int lane = 0; lane < 4 * planar::PlanarDynamics::kGroups; ++lane) {
      const int i = lane < simulation::kMuscles ? lane : lane - 2;
      const int muscle = i / 2 + i % 2 * planar::PlanarModel::kMusclesOfLeg;
      state.y[State::kFiber + lane / 4][lane % 4] = s.fiber_length_m[muscle];
      activation[lane / 4][lane % 4] = s.activation[muscle];
    }
    dynamics.set_modes(dynamics.modes_at(state));
    dynamics.evaluate(state, activation, rate, &linear);
  }
  osim::Model model;
  planar::PlanarDynamics dynamics;
  State state, rate;
  Fibers activation{};
  planar::PlanarLinear linear;
};

void exponential(benchmark::State& loop) {
  simd::V4 x{-0.1, 0.2, -3, 1};
  for (auto _ : loop) {
    benchmark::DoNotOptimize(x);
    benchmark::DoNotOptimize(simd::exp(x));
  }
}
BENCHMARK(exponential);

void sine_and_cosine(benchmark::State& loop) {
  simd::V4 x{-0.1, 0.2, -3, 1}, s, c;
  for (auto _ : loop) {
    benchmark::DoNotOptimize(x);
    simd::sin_cos(x, s, c);
    benchmark::DoNotOptimize(s);
    benchmark::DoNotOptimize(c);
  }
}
BENCHMARK(sine_and_cosine);

void one_muscle_by_the_law(benchmark::State& loop) {
  const Standing at;
  const laws::MuscleLaw law(at.model.muscles[6]);
  double path = 0.45;
  for (auto _ : loop) {
    benchmark::DoNotOptimize(path);
    benchmark::DoNotOptimize(laws::muscle_forces(law, 0.3, 0.05, path));
  }
}
BENCHMARK(one_muscle_by_the_law);

void four_muscles_at_once(benchmark::State& loop) {
  const Standing at;
  simd::V4 path = simd::all(0.45);
  for (auto _ : loop) {
    benchmark::DoNotOptimize(path);
    benchmark::DoNotOptimize(planar::muscle_group<false>(
        at.dynamics.model().muscles[3], at.activation[3], at.state.y[State::kFiber + 3], path));
  }
}
BENCHMARK(four_muscles_at_once);

void evaluation(benchmark::State& loop) {
  Standing at;
  for (auto _ : loop) {
    at.dynamics.evaluate(at.state, at.activation, at.rate);
    benchmark::DoNotOptimize(at.rate);
  }
}
BENCHMARK(evaluation);

void evaluation_with_linearisation(benchmark::State& loop) {
  Standing at;
  for (auto _ : loop) {
    at.dynamics.evaluate(at.state, at.activation, at.rate, &at.linear);
    benchmark::DoNotOptimize(at.linear);
  }
}
BENCHMARK(evaluation_with_linearisation);

void factorisation(benchmark::State& loop) {
  Standing at;
  planar::PlanarSolver solver;
  for (auto _ : loop) {
    solver.factor(at.linear, 5e-4);
    benchmark::DoNotOptimize(solver);
  }
}
BENCHMARK(factorisation);

void solution(benchmark::State& loop) {
  Standing at;
  planar::PlanarSolver solver;
  solver.factor(at.linear, 5e-4);
  State result;
  for (auto _ : loop) {
    solver.solve(at.linear, at.rate, result);
    benchmark::DoNotOptimize(result);
  }
}
BENCHMARK(solution);

void activations_of_a_step(benchmark::State& loop) {
  Standing at;
  Fibers excitation;
  excitation.fill(simd::all(0.7));
  planar::ActivationTrack track;
  for (auto _ : loop) {
    track.build(at.dynamics, at.activation, excitation, 0.01, 8);
    benchmark::DoNotOptimize(track);
  }
}
BENCHMARK(activations_of_a_step);

void evaluation_by(benchmark::State& loop, const char* name) {
  const Standing at;
  const auto engine = simulation::make_engine(name, at.model);
  engine->equilibrate_fibers();
  for (auto _ : loop) benchmark::DoNotOptimize(engine->derivative({}));
}
BENCHMARK_CAPTURE(evaluation_by, simbody, "simbody");
BENCHMARK_CAPTURE(evaluation_by, planar, "planar");

}  // namespace
}  // namespace stride
