#pragma once

#include <immintrin.h>

#include <cstdint>
#include <cstring>

namespace stride::simd {

/// Two and four doubles; g++ and clang compile them for any processor. V2 holds the right and the
/// left leg, V4 two muscles or two contact spheres of both legs.
using V2 = double __attribute__((vector_size(16)));
using V4 = double __attribute__((vector_size(32)));
using I4 = std::int64_t __attribute__((vector_size(32)));

inline V2 both(double x) { return V2{x, x}; }
inline V4 all(double x) { return V4{x, x, x, x}; }

inline V2 sqrt(V2 x) { return _mm_sqrt_pd(x); }
inline V4 sqrt(V4 x) {
#ifdef __AVX__
  return _mm256_sqrt_pd(x);
#else
  return V4{__builtin_sqrt(x[0]), __builtin_sqrt(x[1]), __builtin_sqrt(x[2]), __builtin_sqrt(x[3])};
#endif
}

#ifdef __AVX__  // explicit, because g++ needs four instructions where a bound is constant
inline V4 max(V4 a, V4 b) { return _mm256_max_pd(a, b); }
inline V4 min(V4 a, V4 b) { return _mm256_min_pd(a, b); }
#else
inline V4 max(V4 a, V4 b) { return a > b ? a : b; }
inline V4 min(V4 a, V4 b) { return a < b ? a : b; }
#endif

/// One vector of four from two of two.
inline V4 join(V2 a, V2 b) { return V4{a[0], a[1], b[0], b[1]}; }
inline V2 low(V4 v) { return V2{v[0], v[1]}; }
inline V2 high(V4 v) { return V2{v[2], v[3]}; }

inline bool any(I4 mask) {
#ifdef __AVX__
  return !_mm256_testz_si256(reinterpret_cast<__m256i>(mask), reinterpret_cast<__m256i>(mask));
#else
  return (mask[0] | mask[1] | mask[2] | mask[3]) != 0;
#endif
}

/// x rounded to an integer n, |x| < 2^51; `low` holds n in its low bits.
inline V4 round(V4 x, I4& low) {
  const V4 magic = all(6755399441055744.0);  // 1.5 · 2^52
  const V4 shifted = x + magic;
  std::memcpy(&low, &shifted, sizeof low);
  return shifted - magic;
}

/// eˣ to 1e-15 relative for |x| < 700; x is clamped to that range.
inline V4 exp(V4 x) {
  x = max(min(x, all(700)), all(-700));
  I4 n;
  const V4 k = round(x * 1.4426950408889634, n);
  // Cody and Waite: x = k ln 2 + r, with ln 2 in two parts so that r keeps its last bits. Then the
  // Taylor series of eʳ to r¹³, by Estrin's scheme, times 2ᵏ through the exponent bits.
  const V4 r = (x - k * 6.93147180369123816490e-01) - k * 1.90821492927058770002e-10;
  const V4 r2 = r * r, r4 = r2 * r2;
  const V4 p01 = 1 + r, p23 = 1.0 / 2 + r * (1.0 / 6);
  const V4 p45 = 1.0 / 24 + r * (1.0 / 120), p67 = 1.0 / 720 + r * (1.0 / 5040);
  const V4 p89 = 1.0 / 40320 + r * (1.0 / 362880);
  const V4 pab = 1.0 / 3628800 + r * (1.0 / 39916800);
  const V4 pcd = 1.0 / 479001600 + r * (1.0 / 6227020800.0);
  const V4 low = p01 + r2 * p23, middle = p45 + r2 * p67, high = p89 + r2 * (pab + r2 * pcd);
  const V4 p = low + r4 * (middle + r4 * high);
  I4 bits;
  std::memcpy(&bits, &p, sizeof bits);
  bits += n << 52;
  V4 result;
  std::memcpy(&result, &bits, sizeof result);
  return result;
}

/// Sine and cosine to 1e-15 for |x| < 1e5.
inline void sin_cos(V4 x, V4& sine, V4& cosine) {
  I4 n;
  const V4 k = round(x * 0.63661977236758134308, n);
  V4 r = x - k * 1.57079632673412561417e+00;  // π/2 in three parts
  r = r - k * 6.07710050630396597660e-11;
  r = r - k * 2.02226624879595063154e-21;
  const V4 z = r * r;
  // The polynomials of fdlibm on [-π/4, π/4].
  const V4 s =
      r + r * z *
              (-1.66666666666666324348e-01 +
               z * (8.33333333332248946124e-03 +
                    z * (-1.98412698298579493134e-04 +
                         z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 +
                                                                z * 1.58969099521155010221e-10)))));
  const V4 c =
      1 - 0.5 * z +
      z * z *
          (4.16666666666666019037e-02 +
           z * (-1.38888888888741095749e-03 +
                z * (2.48015872894767294178e-05 +
                     z * (-2.75573143513906633035e-07 +
                          z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  const I4 odd = (n & 1) == 1;
  const V4 sine_size = odd ? c : s, cosine_size = odd ? s : c;
  sine = (n & 2) == 2 ? -sine_size : sine_size;
  cosine = ((n + 1) & 2) == 2 ? -cosine_size : cosine_size;
}

}  // namespace stride::simd
