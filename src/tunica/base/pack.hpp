// Pack<W>: W doubles that are computed on together, one lane per element of a batch.
//
// Built on the vector extensions of GCC and Clang, so that a pack of any width compiles for any target; it is fast
// where W matches the registers (2: SSE2, 4: AVX2, 8: AVX-512). Each instruction set uses its own width, so code
// instantiated for different instruction sets has different symbols and never mixes at link time.
//
// The functions here have scalar twins of the same name for double, so that a kernel is written once.
#pragma once

#include <cmath>
#include <cstdint>
#include <initializer_list>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#define TUNICA_INLINE inline __attribute__((always_inline))

namespace tunica {

namespace detail {
// One specialisation per width: GCC drops a vector_size that depends on a template parameter.
template <int W>
struct Registers;
template <>
struct Registers<2> {
  typedef double Vector __attribute__((vector_size(16)));
  typedef std::int64_t Integers __attribute__((vector_size(16)));
};
template <>
struct Registers<4> {
  typedef double Vector __attribute__((vector_size(32)));
  typedef std::int64_t Integers __attribute__((vector_size(32)));
};
template <>
struct Registers<8> {
  typedef double Vector __attribute__((vector_size(64)));
  typedef std::int64_t Integers __attribute__((vector_size(64)));
};
}  // namespace detail

template <int W>
struct Pack {
  static constexpr int width = W;
  using Vector = typename detail::Registers<W>::Vector;
  using Integers = typename detail::Registers<W>::Integers;
  using Mask = Integers;  ///< all bits set where true

  Vector v;

  Pack() = default;
  /// Implicit, so that literals mix with packs. Subtracting zero is no operation to the compiler, adding it would be:
  /// -0 + 0 is 0.
  TUNICA_INLINE Pack(double value) : v(value - Vector{}) {}  // NOLINT
  TUNICA_INLINE explicit Pack(Vector value) : v(value) {}
  TUNICA_INLINE static Pack load(const double* p) {
    Pack r;
    __builtin_memcpy(&r.v, p, sizeof(Vector));
    return r;
  }
  TUNICA_INLINE void store(double* p) const { __builtin_memcpy(p, &v, sizeof(Vector)); }
  TUNICA_INLINE double operator[](int lane) const { return v[lane]; }
  TUNICA_INLINE void set(int lane, double value) { v[lane] = value; }

  TUNICA_INLINE Pack operator-() const { return Pack(-v); }
  TUNICA_INLINE Pack& operator+=(const Pack& b) {
    v += b.v;
    return *this;
  }
  TUNICA_INLINE Pack& operator-=(const Pack& b) {
    v -= b.v;
    return *this;
  }
  TUNICA_INLINE Pack& operator*=(const Pack& b) {
    v *= b.v;
    return *this;
  }
  TUNICA_INLINE Pack& operator/=(const Pack& b) {
    v /= b.v;
    return *this;
  }
  friend TUNICA_INLINE Pack operator+(const Pack& a, const Pack& b) { return Pack(a.v + b.v); }
  friend TUNICA_INLINE Pack operator-(const Pack& a, const Pack& b) { return Pack(a.v - b.v); }
  friend TUNICA_INLINE Pack operator*(const Pack& a, const Pack& b) { return Pack(a.v * b.v); }
  friend TUNICA_INLINE Pack operator/(const Pack& a, const Pack& b) { return Pack(a.v / b.v); }
  friend TUNICA_INLINE Mask operator<(const Pack& a, const Pack& b) { return a.v < b.v; }
  friend TUNICA_INLINE Mask operator>(const Pack& a, const Pack& b) { return a.v > b.v; }
};

// --- choosing by lane -------------------------------------------------------------------------------------------

TUNICA_INLINE double select(bool mask, double a, double b) { return mask ? a : b; }
TUNICA_INLINE bool any(bool mask) { return mask; }

template <int W>
TUNICA_INLINE Pack<W> select(const typename Pack<W>::Mask& mask, const Pack<W>& a, const Pack<W>& b) {
  return Pack<W>(mask ? a.v : b.v);
}
template <class Mask>
TUNICA_INLINE bool any(const Mask& mask) {
  std::int64_t bits = 0;
  for (unsigned i = 0; i < sizeof(Mask) / sizeof(std::int64_t); ++i) bits |= mask[i];
  return bits != 0;
}

/// Is a lane above `limit`? With the instructions, since any() takes every lane of the mask out of the register.
TUNICA_INLINE bool any_above(double x, double limit) { return x > limit; }
template <int W>
TUNICA_INLINE bool any_above(const Pack<W>& x, const Pack<W>& limit) {
#if defined(__AVX512F__)
  if constexpr (W == 8) return _mm512_cmp_pd_mask((__m512d)x.v, (__m512d)limit.v, _CMP_GT_OQ) != 0;
#endif
#if defined(__AVX__)
  if constexpr (W == 4) return _mm256_movemask_pd((__m256d)(x.v > limit.v)) != 0;
#endif
#if defined(__SSE2__)
  if constexpr (W == 2) return _mm_movemask_pd((__m128d)(x.v > limit.v)) != 0;
#endif
  return any(x.v > limit.v);
}

TUNICA_INLINE double max(double a, double b) { return a > b ? a : b; }
TUNICA_INLINE double min(double a, double b) { return a < b ? a : b; }

/// The second of the two where one is NaN. One instruction; the comparison and choice by lane stay two.
template <int W>
TUNICA_INLINE Pack<W> max(const Pack<W>& a, const Pack<W>& b) {
#if defined(__AVX512F__)
  if constexpr (W == 8) return Pack<W>((typename Pack<W>::Vector)_mm512_max_pd((__m512d)a.v, (__m512d)b.v));
#endif
#if defined(__AVX__)
  if constexpr (W == 4) return Pack<W>((typename Pack<W>::Vector)_mm256_max_pd((__m256d)a.v, (__m256d)b.v));
#endif
#if defined(__SSE2__)
  if constexpr (W == 2) return Pack<W>((typename Pack<W>::Vector)_mm_max_pd((__m128d)a.v, (__m128d)b.v));
#endif
  return Pack<W>(a.v > b.v ? a.v : b.v);
}
template <int W>
TUNICA_INLINE Pack<W> min(const Pack<W>& a, const Pack<W>& b) {
#if defined(__AVX512F__)
  if constexpr (W == 8) return Pack<W>((typename Pack<W>::Vector)_mm512_min_pd((__m512d)a.v, (__m512d)b.v));
#endif
#if defined(__AVX__)
  if constexpr (W == 4) return Pack<W>((typename Pack<W>::Vector)_mm256_min_pd((__m256d)a.v, (__m256d)b.v));
#endif
#if defined(__SSE2__)
  if constexpr (W == 2) return Pack<W>((typename Pack<W>::Vector)_mm_min_pd((__m128d)a.v, (__m128d)b.v));
#endif
  return Pack<W>(a.v < b.v ? a.v : b.v);
}

// --- elementary functions ---------------------------------------------------------------------------------------

TUNICA_INLINE double sqrt(double x) { return __builtin_sqrt(x); }
TUNICA_INLINE double abs(double x) { return __builtin_fabs(x); }
inline double exp(double x) { return std::exp(x); }
inline double exp2_of_nonnegative(double x) { return std::exp2(x > 1023.0 ? 1023.0 : x); }
inline double log(double x) { return std::log(x); }
inline double pow(double x, double y) { return std::pow(x, y); }

/// Square root, correctly rounded; NaN for x < 0. Written with the instructions: a loop over the lanes stays scalar,
/// since __builtin_sqrt may set errno.
template <int W>
TUNICA_INLINE Pack<W> sqrt(const Pack<W>& x) {
#if defined(__AVX512F__)
  if constexpr (W == 8) return Pack<W>((typename Pack<W>::Vector)_mm512_sqrt_pd((__m512d)x.v));
#endif
#if defined(__AVX__)
  if constexpr (W == 4) return Pack<W>((typename Pack<W>::Vector)_mm256_sqrt_pd((__m256d)x.v));
#endif
#if defined(__SSE2__)
  if constexpr (W == 2) return Pack<W>((typename Pack<W>::Vector)_mm_sqrt_pd((__m128d)x.v));
#endif
  Pack<W> r;
  for (int i = 0; i < W; ++i) r.v[i] = __builtin_sqrt(x.v[i]);
  return r;
}
template <int W>
TUNICA_INLINE Pack<W> abs(const Pack<W>& x) {
  return Pack<W>(x.v < 0.0 ? -x.v : x.v);
}

/// e^x. Range reduction to |r| <= ln 2 / 2 and a degree-13 Taylor polynomial; error below 1 ulp for
/// -708 < x < 709. Larger arguments give +infinity and smaller ones 0, NaN stays NaN.
template <int W>
TUNICA_INLINE Pack<W> exp(const Pack<W>& x) {
  using P = Pack<W>;
  const typename P::Vector shift = typename P::Vector{} + 0x1.8p52;  // rounds to integer and leaves it in the low bits
  const typename P::Vector t = x.v * 1.4426950408889634074 + shift;
  const typename P::Vector n = t - shift;
  const P r((x.v - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10);
  P p(1.0 / 6227020800);
  for (double c : {1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880, 1.0 / 40320, 1.0 / 5040, 1.0 / 720,
                   1.0 / 120, 1.0 / 24, 1.0 / 6, 0.5})
    p = p * r + P(c);
  p = P(1.0) + (r + r * r * p);  // in this order the roundings of p hardly count
  typename P::Integers bits;
  __builtin_memcpy(&bits, &t, sizeof bits);
  bits = (bits + 1023) << 52;
  typename P::Vector scale;
  __builtin_memcpy(&scale, &bits, sizeof scale);
  P y(p.v * scale);
  y = select<W>(x.v > 709.0, P(__builtin_inf()), y);
  return select<W>(x.v < -708.0, P(0.0), y);
}

namespace detail {
#if defined(__AVX512F__)
/// 2^x for 0 <= x <= 1023: 2^(m/8) with the nearest integer m, whose eight fractions fit into a register, times a
/// polynomial of degree 5 in the rest. Relative error below 3e-13 (Remez).
TUNICA_INLINE Pack<8> exp2_by_table(const Pack<8>& x) {
  using P = Pack<8>;
  // 2^(j/8) as an integer minus j << 49: adding m << 49, of which j is the lowest part, leaves m / 8 in the exponent.
  constexpr std::int64_t j = std::int64_t{1} << 49;
  const __m512i table =
      _mm512_setr_epi64(__builtin_bit_cast(std::int64_t, 1.0), __builtin_bit_cast(std::int64_t, 1.0905077326652577) - j,
                        __builtin_bit_cast(std::int64_t, 1.189207115002721) - 2 * j,
                        __builtin_bit_cast(std::int64_t, 1.2968395546510096) - 3 * j,
                        __builtin_bit_cast(std::int64_t, 1.4142135623730951) - 4 * j,
                        __builtin_bit_cast(std::int64_t, 1.5422108254079407) - 5 * j,
                        __builtin_bit_cast(std::int64_t, 1.681792830507429) - 6 * j,
                        __builtin_bit_cast(std::int64_t, 1.8340080864093424) - 7 * j);
  const P shift(0x1.8p49), t = x + shift;  // the low bits hold m
  const P f = x - (t - shift);
  P p(0.0013332664434999625);
  for (double c :
       {0.009619031572318191, 0.055504109406632834, 0.24022650563741063, 0.6931471805591215, 1.0000000000002867})
    p = p * f + P(c);
  const __m512i m = _mm512_castpd_si512((__m512d)t.v);
  const __m512i power = _mm512_add_epi64(_mm512_permutexvar_epi64(m, table), _mm512_slli_epi64(m, 49));
  return p * P((P::Vector)_mm512_castsi512_pd(power));
}
#endif

/// The same with the nearest integer instead of m / 8 and degree 9. Relative error below 2e-14.
template <int W>
TUNICA_INLINE Pack<W> exp2_by_polynomial(const Pack<W>& x) {
  using P = Pack<W>;
  const P shift(0x1.8p52), t = x + shift;  // the low bits hold the exponent
  const P f = x - (t - shift), f2 = f * f;
  const P even = P(1.0000000000000127) +
                 f2 * (P(0.24022650695649655) +
                       f2 * (P(0.00961812919206659) + f2 * (P(0.0001540343494852222) + f2 * P(1.325940551832952e-06))));
  const P odd =
      P(0.693147180559871) +
      f2 * (P(0.05550410866868515) +
            f2 * (P(0.00133335576176754) + f2 * (P(1.5252984798658376e-05) + f2 * P(1.0150344092361341e-07))));
  const P p = even + f * odd;
  typename P::Integers bits, exponent;
  __builtin_memcpy(&bits, &p.v, sizeof bits);
  __builtin_memcpy(&exponent, &t.v, sizeof exponent);
  bits += exponent << 52;
  P power;
  __builtin_memcpy(&power.v, &bits, sizeof bits);
  return power;
}
}  // namespace detail

/// 2^x for x >= 0, relative error below 3e-13. Arguments above 1023 count as 1023, NaN stays NaN.
template <int W>
TUNICA_INLINE Pack<W> exp2_of_nonnegative(const Pack<W>& x) {
  const Pack<W> bounded = min(Pack<W>(1023.0), x);  // in this order NaN stays
#if defined(__AVX512F__)
  if constexpr (W == 8) return detail::exp2_by_table(bounded);
#endif
  return detail::exp2_by_polynomial(bounded);
}

/// Natural logarithm. Error below 2 ulp, also of subnormal numbers; -infinity for 0, +infinity for +infinity, NaN for
/// x < 0 and NaN.
template <int W>
TUNICA_INLINE Pack<W> log(const Pack<W>& x) {
  using P = Pack<W>;
  const typename P::Mask subnormal = x.v < 0x1p-1022;
  const typename P::Vector normal = subnormal ? x.v * 0x1p54 : x.v;
  typename P::Integers bits;
  __builtin_memcpy(&bits, &normal, sizeof bits);
  // Split x = 2^e m with m in [sqrt(1/2), sqrt(2)).
  const typename P::Integers offset = bits - 0x3fe6a09e667f3bcdLL;
  const typename P::Integers exponent = offset >> 52;
  bits -= exponent << 52;
  typename P::Vector m, e;
  __builtin_memcpy(&m, &bits, sizeof m);
  const typename P::Integers e_bits = exponent + 0x4338000000000000LL;  // e + 1.5 * 2^52 as a double
  __builtin_memcpy(&e, &e_bits, sizeof e);
  e -= subnormal ? typename P::Vector{} + (0x1.8p52 + 54.0) : typename P::Vector{} + 0x1.8p52;
  const P s((m - 1.0) / (m + 1.0)), z = s * s;  // ln m = 2 artanh(s)
  P p(2.0 / 23);
  for (double c : {2.0 / 21, 2.0 / 19, 2.0 / 17, 2.0 / 15, 2.0 / 13, 2.0 / 11, 2.0 / 9, 2.0 / 7, 2.0 / 5, 2.0 / 3})
    p = p * z + P(c);
  const P y(e * 6.93147180369123816490e-01 + (s.v * 2.0 + (s * z * p).v + e * 1.90821492927058770002e-10));
  const P inside = select<W>(x.v < __builtin_inf(), y, x);  // NaN stays
  return select<W>(x.v > 0.0, inside, select<W>(x.v == 0.0, P(-__builtin_inf()), P(__builtin_nan(""))));
}

/// x^y for x >= 0 (0^0 is NaN). The relative error grows with |y ln x|.
template <int W>
TUNICA_INLINE Pack<W> pow(const Pack<W>& x, double y) {
  return exp(log(x) * Pack<W>(y));
}

// --- transposing between "one lane per element" and "one row per element" -----------------------------------------

/// Lane count of a scalar type: 1 for double, W for Pack<W>.
template <class T>
inline constexpr int lanes = 1;
template <int W>
inline constexpr int lanes<Pack<W>> = W;

TUNICA_INLINE double lane(double x, int) { return x; }
template <int W>
TUNICA_INLINE double lane(const Pack<W>& x, int i) {
  return x.v[i];
}
TUNICA_INLINE void set_lane(double& x, int, double value) { x = value; }
template <int W>
TUNICA_INLINE void set_lane(Pack<W>& x, int i, double value) {
  x.v[i] = value;
}

}  // namespace tunica
