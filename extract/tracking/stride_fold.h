#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace stride::tracking {

/// A joint of both legs relative to the pelvis on one frame; NaN if not seen.
struct JointPair {
  std::array<Eigen::Vector2d, 2> p_px;  // right, left
  std::array<double, 2> weight;         // 0 … 1
};

/// The periodic motion of a joint that both legs share, the left half a stride later: a Fourier
/// series of four harmonics and an offset for each leg, fitted robustly.
struct StrideFold {
  double period_s = 0;
  std::vector<std::array<Eigen::Matrix<double, 10, 1>, 2>> joints;  // coefficients of x and y
  std::vector<double> spread_px;  // median distance of a joint from its fold

  Eigen::Vector2d place(std::size_t joint, int side, double time_s) const;
};

/// Folds joints (outer index) seen at times (inner index). The period is found from quantities that
/// are invariant under swapping the legs, so it does not depend on their labels. Nothing if there
/// are too few frames.
std::optional<StrideFold> fold_stride(const std::vector<std::vector<JointPair>>& joints,
                                      const std::vector<double>& times_s);

}  // namespace stride::tracking
