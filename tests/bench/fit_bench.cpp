// The fit of five seconds of running with points in every frame, on one core.
#include <benchmark/benchmark.h>

#include "calibrate/calibrate.h"
#include "tests/calibrate/synthetic.h"

namespace stride {
namespace {

struct FiveSeconds {
  SagittalModel model = sagittal_model(osim::load_osim(osim::default_model_file()));
  Trajectory trajectory =
      synthetic_trajectory(synthetic_runner(), model, {.duration_s = 5, .noise_px = 1.5});
  fit::Marks marks = fit::observe(trajectory, false);
};

void fit(benchmark::State& loop, bool numeric_derivatives) {
  const FiveSeconds clip;
  fit::FitOptions options;
  options.numeric_derivatives = numeric_derivatives;
  int iterations = 0;
  for (auto _ : loop) {
    const fit::StrideFit fit = fit::fit_stride(clip.marks, clip.model, options);
    benchmark::DoNotOptimize(fit.runner);
    iterations = fit.iterations;
  }
  loop.counters["iterations"] = iterations;
}

void fit_with_automatic_derivatives(benchmark::State& loop) { fit(loop, false); }
BENCHMARK(fit_with_automatic_derivatives)->Unit(benchmark::kMillisecond);

void fit_with_numeric_derivatives(benchmark::State& loop) { fit(loop, true); }
BENCHMARK(fit_with_numeric_derivatives)->Unit(benchmark::kMillisecond);

/// `stride calibrate` without files and pictures.
void calibrate_five_seconds(benchmark::State& loop) {
  const FiveSeconds clip;
  for (auto _ : loop) {
    const Calibration found = calibrate(clip.trajectory, clip.model);
    benchmark::DoNotOptimize(found.run.period_s);
  }
}
BENCHMARK(calibrate_five_seconds)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace stride
