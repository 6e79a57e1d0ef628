#include "train/rollout/human_gait.h"

#include <array>
#include <cmath>

namespace stride::rollout {
namespace {

struct Measured {
  double speed_m_s, cadence_per_min, duty_factor, duty_factor_sd;
};
constexpr std::array kRunners{Measured{2.5, 162, 0.394, 0.028}, Measured{3.5, 171, 0.348, 0.022},
                              Measured{4.5, 183, 0.328, 0.021}};
constexpr double kCadenceSd = 9;
constexpr double kSlowest_m_s = 2, kFastest_m_s = 5.5;

constexpr GaitBand band(double mean, double sd) { return {mean - 2 * sd, mean + 2 * sd}; }

}  // namespace

std::optional<HumanGait> human_gait(double speed_m_s) {
  if (!(speed_m_s >= kSlowest_m_s && speed_m_s <= kFastest_m_s)) return std::nullopt;
  const std::size_t i = speed_m_s < kRunners[1].speed_m_s ? 0 : 1;
  const Measured &a = kRunners[i], &b = kRunners[i + 1];
  const double share = (speed_m_s - a.speed_m_s) / (b.speed_m_s - a.speed_m_s);
  HumanGait human;
  human.cadence_per_min = band(std::lerp(a.cadence_per_min, b.cadence_per_min, share), kCadenceSd);
  human.duty_factor = band(std::lerp(a.duty_factor, b.duty_factor, share),
                           std::lerp(a.duty_factor_sd, b.duty_factor_sd, share));
  human.step_length_m = {60 * speed_m_s / human.cadence_per_min.high,
                         60 * speed_m_s / human.cadence_per_min.low};
  human.flight_share = {1 - 2 * human.duty_factor.high, 1 - 2 * human.duty_factor.low};
  return human;
}

const char* leg_pattern(double leg_phase) {
  if (leg_phase >= 0.4) return "the legs take turns";
  return leg_phase > 0.1 ? "one leg leads, a gallop" : "both legs at once, hops";
}

}  // namespace stride::rollout
