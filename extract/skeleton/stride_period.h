#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace stride {

/// The period of a stride, for everything that asks for it: tracking, the repair of legs, the fit.
///
/// People take 0.4 s (sprinting) to 1.8 s (strolling) a stride; slow motion that nobody told
/// stretches that, eight times from 240 to 30 Hz, and a clip that plays too fast shortens it.
inline constexpr double kShortestPeriod_s = 0.2, kLongestPeriod_s = 10;

/// Periods that a clip can show.
struct PeriodBounds {
  double shortest_s = kShortestPeriod_s, longest_s = kLongestPeriod_s;
};

/// Of a clip seen at these times: no shorter than three median steps between frames, below which
/// another stride in reverse looks the same, no longer than the clip and a tenth.
PeriodBounds period_bounds(const std::vector<double>& times_s);

/// −log probability of a period before anything is seen, 0 at its peak: real time, log-normal about
/// 0.75 s, or, one time in seven, slow motion, about 2.5 s and wide.
double period_improbability(double period_s);

/// A joint of both legs relative to the pelvis on one frame; NaN where it was not seen.
struct JointPair {
  std::array<Eigen::Vector2d, 2> p_px;  // right, left
  std::array<double, 2> weight;         // 0 … 1
};

/// Whether right is right on every frame. Where it may not be, only what does not change when the
/// legs are exchanged is used: sum and squared difference of the two. Twice the period may then
/// explain as much.
enum class LegNames { trusted, unknown };

struct StridePeriod {
  double period_s = 0;
  double cost = 0;       // −log probability of what was seen, and of the period
  double explained = 0;  // part of the robust variance that the period explains; names trusted
};

/// The most likely periods, best first, at most `count`, each at least a tenth from the others:
/// Fourier series of joints (outer index) seen at times (inner index), the left leg half a period
/// behind the right, by robust least squares at every period within the bounds. Of a clip of more
/// than 20 s its middle is used. None if no joint was seen on 12 frames.
std::vector<StridePeriod> stride_periods(const std::vector<std::vector<JointPair>>& joints,
                                         const std::vector<double>& times_s, LegNames names,
                                         int count);

}  // namespace stride
