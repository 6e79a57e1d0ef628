#pragma once

#include "train/simulation/simd/simd.h"

namespace stride::simd {

/// A vector of the sagittal plane for each leg. Not initialised, because arrays of it are scratch.
struct Pair {
  V2 x, y;
};
inline Pair operator+(Pair a, Pair b) { return {a.x + b.x, a.y + b.y}; }
inline Pair operator-(Pair a, Pair b) { return {a.x - b.x, a.y - b.y}; }
inline Pair operator*(V2 s, Pair a) { return {s * a.x, s * a.y}; }
inline Pair perp(Pair a) { return {-a.y, a.x}; }  // a quarter turn: z × a
inline V2 dot(Pair a, Pair b) { return a.x * b.x + a.y * b.y; }
inline V2 cross(Pair a, Pair b) { return a.x * b.y - a.y * b.x; }
inline double sum(V2 v) { return v[0] + v[1]; }

}  // namespace stride::simd
