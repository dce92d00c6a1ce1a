// Discrete fibre dispersion: the energy of the fibres summed over representative directions, (1.13) and (1.14),
//   Psi = sum_n rho_n f(C : N_n (x) N_n - 1),   S = 2 sum_n rho_n f' N (x) N,   CC = 4 sum_n rho_n f'' N (x) N (x) N
//   (x) N
// (Li, Holzapfel et al. 2018, "A discrete fibre dispersion method for excluding fibres under compression").
//
// A batch of elements is one lane each. The directions are taken in chunks: strains of the fibres that pull in any
// lane; their exponentials; sums. N (x) N (x) N (x) N has 15 distinct entries; with those of N (x) N they are summed in
// one go where the registers suffice, else in two.
#pragma once

#include <span>
#include <vector>

#include "tunica/wall/materials/fibre_energy.hpp"

namespace tunica::wall {

/// Directions of fibres that have the same energy.
struct FibreBundle {
  /// One direction, a cache line: N (x) N in Voigt order, and its density.
  struct Direction {
    double NN[voigt_size];
    double density;
    double unused = 0.0;
  };
  FibreEnergy energy;
  std::vector<Direction> directions;

  /// `directions` unit vectors in the fibre frame, `densities` rho_n; equally many.
  static FibreBundle make(const FibreEnergy& energy, std::span<const Vec3<double>> directions,
                          std::span<const double> densities);
};

namespace detail {

/// Strains of at most one chunk of directions, with those left out that pull in no lane.
template <class T>
struct FibreChunk {
  static constexpr int size = 64;
  T strain[size], slope[size], curvature[size];
  const FibreBundle::Direction* direction[size];
  int count;

  TUNICA_INLINE void find(const FibreBundle::Direction* first, int n, const Symmetric<T>& C, bool tension_only) {
    const T C12 = T(2.0) * C[3], C23 = T(2.0) * C[4], C13 = T(2.0) * C[5];
    count = 0;
    for (int i = 0; i < n; ++i) {
      const double* NN = first[i].NN;
      const T E = (C[0] * T(NN[0]) + C[1] * T(NN[1]) + C[2] * T(NN[2])) +
                  (C12 * T(NN[3]) + C23 * T(NN[4]) + (C13 * T(NN[5]) - T(1.0)));
      strain[count] = E;
      direction[count] = first + i;
      count += !tension_only || any_above(E, T(switch_strain)) ? 1 : 0;
    }
  }
  /// 2 rho f' and, if `with_curvature`, 4 rho f''.
  template <bool with_curvature>
  TUNICA_INLINE void differentiate(const FibreEnergy& energy, bool tension_only) {
    const T lowest = tension_only ? T(0.0) : T(-2.0);  // C : N (x) N - 1 is above -1
    const T pulling = tension_only ? T(switch_strain) : lowest;
    const T twice_k1(2.0 * energy.k1), four_k2(4.0 * energy.k2);
    for (int i = 0; i < count; ++i) {
      const T E = max(strain[i], lowest);
      const T scaled = twice_k1 * T(direction[i]->density) * energy.exponential(E);
      slope[i] = scaled * E;
      if constexpr (with_curvature)
        curvature[i] = select(strain[i] > pulling, scaled * (T(2.0) + four_k2 * (E * E)), T(0.0));
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
      for (const auto& d : bundle.directions) {
        T E(-1.0);
        for (int n = 0; n < voigt_size; ++n) E += T((n < 3 ? 1.0 : 2.0) * d.NN[n]) * C[n];
        psi += T(d.density) * bundle.energy.value(admitted(E, tension_only));
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
    for (const FibreBundle& bundle : bundles) sum += bundle.directions.size();
    return sum;
  }

 private:
  template <class T, bool with_curvature, class Visitor>
  TUNICA_INLINE void visit_chunks(const Symmetric<T>& C, Visitor visitor) const {
    using Chunk = detail::FibreChunk<T>;
    Chunk chunk;
    for (const FibreBundle& bundle : bundles) {
      const int n = static_cast<int>(bundle.directions.size());
      for (int begin = 0; begin < n; begin += Chunk::size) {
        chunk.find(bundle.directions.data() + begin, n - begin < Chunk::size ? n - begin : Chunk::size, C,
                   tension_only);
        chunk.template differentiate<with_curvature>(bundle.energy, tension_only);
        visitor(chunk);
      }
    }
  }

  template <class T>
  static TUNICA_INLINE void add_stress(const detail::FibreChunk<T>& chunk, Symmetric<T>& S) {
    Symmetric<T> sum = S;
    for (int i = 0; i < chunk.count; ++i) {
      const double* NN = chunk.direction[i]->NN;
#pragma GCC unroll 6
      for (int n = 0; n < voigt_size; ++n) sum[n] += chunk.slope[i] * T(NN[n]);
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
      const double* NN = chunk.direction[i]->NN;
      if constexpr (first) {
        const T slope = chunk.slope[i], row = chunk.curvature[i] * T(NN[0]);
#pragma GCC unroll 6
        for (int n = 0; n < 6; ++n) {
          const T entry(NN[n]);
          S[n] += slope * entry;
          a[n] += row * entry;
        }
      }
      if constexpr (second) {
        const T row2 = chunk.curvature[i] * T(NN[1]), row3 = chunk.curvature[i] * T(NN[2]);
#pragma GCC unroll 5
        for (int n = 0; n < 5; ++n) b[n] += row2 * T(NN[n + 1]);
#pragma GCC unroll 4
        for (int n = 0; n < 4; ++n) b[n + 5] += row3 * T(NN[n + 2]);
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
