// Discrete fibre dispersion: the energy of the fibres summed over representative directions, (1.13) and (1.14),
//   Psi = sum_n rho_n f(C : N_n (x) N_n - 1),   S = 2 sum_n rho_n f' N (x) N,   CC = 4 sum_n rho_n f'' N (x) N (x) N
//   (x) N
// (Li, Holzapfel et al. 2018, "A discrete fibre dispersion method for excluding fibres under compression").
//
// A batch of elements is one lane each. Directions come in pairs that mirror each other in the plane of the wall,
// (N1, N2, N3) and (N1, N2, -N3), as in every set that is symmetric about the plane. The two strains are even +- odd, a
// part with C11 C22 C33 C12 and one with C23 C13, and the sums need the sum of the two slopes in the first four
// entries and their difference in the others, so that a pair costs little more than one direction but for its two
// exponentials.
//
// The pairs are taken in chunks: strains of those that pull in any lane; their exponentials; sums. N (x) N (x) N (x) N
// has 15 distinct entries; with those of N (x) N they are summed in one go where the registers suffice, else in two.
#pragma once

#include <span>
#include <vector>

#include "tunica/wall/materials/fibre_energy.hpp"

namespace tunica::wall {

/// Directions of fibres that have the same energy.
struct FibreBundle {
  /// Two directions that mirror each other in the e1-e2 plane, a cache line: N (x) N of the first in Voigt order, and
  /// their densities. The second is zero where a direction has no mirror image in the set.
  struct Pair {
    double NN[voigt_size];
    double density[2];
  };
  FibreEnergy energy;
  std::vector<Pair> pairs;
  std::size_t directions = 0;  ///< number of them

  /// `directions` unit vectors in the fibre frame, no two of them equal up to the sign; `densities` rho_n, equally
  /// many.
  static FibreBundle make(const FibreEnergy& energy, std::span<const Vec3<double>> directions,
                          std::span<const double> densities);
};

namespace detail {

/// At most one chunk of pairs, with those left out that pull in no lane.
template <class T>
struct FibreChunk {
  static constexpr int size = 32;
  T strain[size][2];                     ///< of a direction and its mirror image
  T slope[size][2], curvature[size][2];  ///< sum over the two, and difference
  const FibreBundle::Pair* pair[size];
  int count;

  TUNICA_INLINE void find(const FibreBundle::Pair* first, int n, const Symmetric<T>& C, bool tension_only) {
    const T C12 = T(2.0) * C[3], C23 = T(2.0) * C[4], C13 = T(2.0) * C[5], pulling(switch_strain);
    count = 0;
    for (int i = 0; i < n; ++i) {
      const double* NN = first[i].NN;
      const T even = (C[0] * T(NN[0]) + C[1] * T(NN[1])) + (C[2] * T(NN[2]) + (C12 * T(NN[3]) - T(1.0)));
      const T odd = C23 * T(NN[4]) + C13 * T(NN[5]);
      strain[count][0] = even + odd;
      strain[count][1] = even - odd;
      pair[count] = first + i;
      count += !tension_only || any_above(max(strain[count][0], strain[count][1]), pulling) ? 1 : 0;
    }
  }
  /// 2 rho f' and, if `with_curvature`, 4 rho f''.
  template <bool with_curvature>
  TUNICA_INLINE void differentiate(const FibreEnergy& energy, bool tension_only) {
    const T lowest = tension_only ? T(0.0) : T(-2.0);  // C : N (x) N - 1 is above -1
    const T pulling = tension_only ? T(switch_strain) : lowest;
    const T twice_k1(2.0 * energy.k1), four_k2(4.0 * energy.k2);
    for (int i = 0; i < count; ++i) {
      T f[2], ff[2];
#pragma GCC unroll 2
      for (int side = 0; side < 2; ++side) {
        const T E = max(strain[i][side], lowest);
        const T scaled = twice_k1 * T(pair[i]->density[side]) * energy.exponential(E);
        f[side] = scaled * E;
        if constexpr (with_curvature)
          ff[side] = select(strain[i][side] > pulling, scaled * (T(2.0) + four_k2 * (E * E)), T(0.0));
      }
      slope[i][0] = f[0] + f[1];
      slope[i][1] = f[0] - f[1];
      if constexpr (with_curvature) {
        curvature[i][0] = ff[0] + ff[1];
        curvature[i][1] = ff[0] - ff[1];
      }
    }
  }
};

}  // namespace detail

struct DiscreteFibres {
  std::vector<FibreBundle> bundles;
  bool tension_only = true;

  template <class T>
  T energy(const Symmetric<T>& C) const {
    T psi(0.0);
    for (const FibreBundle& bundle : bundles)
      for (const auto& pair : bundle.pairs)
        for (const int side : {0, 1}) {
          T E(-1.0);
          for (int n = 0; n < voigt_size; ++n)
            E += T((n < 3 ? 1.0 : 2.0) * (n > 3 && side == 1 ? -pair.NN[n] : pair.NN[n])) * C[n];
          psi += T(pair.density[side]) * bundle.energy.value(admitted(E, tension_only));
        }
    return psi;
  }

  template <class T>
  TUNICA_INLINE Symmetric<T> stress(const Symmetric<T>& C) const {
    const T zero(0.0);
    Symmetric<T> S{{zero, zero, zero, zero, zero, zero}};
    visit_chunks<T, false>(C, [&](const detail::FibreChunk<T>& chunk) { add_stress(chunk, S); });
    return S;
  }

  template <class T>
  TUNICA_INLINE Response<T> response(const Symmetric<T>& C) const {
    Response<T> r;
    for (T& x : r.stress.v) x = T(0.0);
    T NNNN[15];  // 1111 1122 1133 1112 1123 1113 | 2222 2233 2212 2223 2213 | 3333 3312 3323 3313
    for (T& x : NNNN) x = T(0.0);
    visit_chunks<T, true>(C, [&](const detail::FibreChunk<T>& chunk) {
      if constexpr (lanes<T> >= 8) {  // 32 registers hold all sums
        add<true, true>(chunk, r.stress.v, NNNN);
      } else {
        add<true, false>(chunk, r.stress.v, NNNN);
        add<false, true>(chunk, r.stress.v, NNNN);
      }
    });
    constexpr int entry[21] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 1, 10, 4, 7, 12, 2};
    for (int n = 0; n < 21; ++n) r.tangent.v[n] = NNNN[entry[n]];
    return r;
  }

  std::size_t directions() const {
    std::size_t sum = 0;
    for (const FibreBundle& bundle : bundles) sum += bundle.directions;
    return sum;
  }

 private:
  template <class T, bool with_curvature, class Visitor>
  TUNICA_INLINE void visit_chunks(const Symmetric<T>& C, Visitor visitor) const {
    using Chunk = detail::FibreChunk<T>;
    Chunk chunk;
    for (const FibreBundle& bundle : bundles) {
      const int n = static_cast<int>(bundle.pairs.size());
      for (int begin = 0; begin < n; begin += Chunk::size) {
        chunk.find(bundle.pairs.data() + begin, n - begin < Chunk::size ? n - begin : Chunk::size, C, tension_only);
        chunk.template differentiate<with_curvature>(bundle.energy, tension_only);
        visitor(chunk);
      }
    }
  }

  template <class T>
  static TUNICA_INLINE void add_stress(const detail::FibreChunk<T>& chunk, Symmetric<T>& S) {
    Symmetric<T> sum = S;
    for (int i = 0; i < chunk.count; ++i) {
      const double* NN = chunk.pair[i]->NN;
#pragma GCC unroll 6
      for (int n = 0; n < voigt_size; ++n) sum[n] += chunk.slope[i][n > 3] * T(NN[n]);
    }
    S = sum;
  }

  /// The stress and the entries 11.. of the tangent (`first`), its entries 22.. and 33.. without 11 (`second`).
  template <bool first, bool second, class T>
  static TUNICA_INLINE void add(const detail::FibreChunk<T>& chunk, T* stress, T* tangent) {
    T S[6], a[6], b[9];
#pragma GCC unroll 6
    for (int n = 0; n < 6; ++n) S[n] = stress[n], a[n] = tangent[n];
#pragma GCC unroll 9
    for (int n = 0; n < 9; ++n) b[n] = tangent[6 + n];
    for (int i = 0; i < chunk.count; ++i) {
      const double* NN = chunk.pair[i]->NN;
      const T &even = chunk.curvature[i][0], &odd = chunk.curvature[i][1];
      if constexpr (first) {
        const T N11(NN[0]), rows[2] = {even * N11, odd * N11};
#pragma GCC unroll 6
        for (int n = 0; n < 6; ++n) {
          const T entry(NN[n]);
          S[n] += chunk.slope[i][n > 3] * entry;
          a[n] += rows[n > 3] * entry;
        }
      }
      if constexpr (second) {
        const T N22(NN[1]), N33(NN[2]);
        const T rows2[2] = {even * N22, odd * N22}, rows3[2] = {even * N33, odd * N33};
#pragma GCC unroll 5
        for (int n = 0; n < 5; ++n) b[n] += rows2[n + 1 > 3] * T(NN[n + 1]);
#pragma GCC unroll 4
        for (int n = 0; n < 4; ++n) b[n + 5] += rows3[n + 2 > 3] * T(NN[n + 2]);
      }
    }
    if constexpr (first)
#pragma GCC unroll 6
      for (int n = 0; n < 6; ++n) stress[n] = S[n], tangent[n] = a[n];
    if constexpr (second)
#pragma GCC unroll 9
      for (int n = 0; n < 9; ++n) tangent[6 + n] = b[n];
  }
};

}  // namespace tunica::wall
