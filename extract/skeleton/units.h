#pragma once

#include <numbers>

namespace stride {

inline constexpr double kDegree = std::numbers::pi / 180;  // rad
inline constexpr int kKeyframesPerStride = 8;              // the paper's four a half step
inline constexpr double kGravity_m_s2 = 9.81;  // of a runner in a video; the model's is its file's

}  // namespace stride
