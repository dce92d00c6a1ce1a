// Discrete fibre dispersion: the energy of the fibres summed over representative directions, (1.13) and (1.14),
//   Psi = sum_n rho_n f(C : N_n (x) N_n - 1),   S = 2 sum_n rho_n f' N (x) N,   CC = 4 sum_n rho_n f'' N (x) N (x) N
//   (x) N
// (Li, Holzapfel et al. 2018, "A discrete fibre dispersion method for excluding fibres under compression").
//
// A batch of elements is one lane each. Directions come in groups that mirror each other: (N1, N2, +-N3) in every set
// that is symmetric about the plane of the wall, (N1, +-N2, +-N3) where the families lie symmetrically about e1 too.
// The strains of a group are sums and differences of two or four parts of C : N (x) N, and the sums over a group need
// its slopes in as many combinations, one for each pattern of signs among the entries of N (x) N. A group thereby costs
// little more than one direction but for its exponentials.
//
// Groups are taken in chunks: strains of those that pull in any lane; their exponentials; sums, with the 15 distinct
// entries of N (x) N (x) N (x) N and the 6 of N (x) N from a table. Strains carry the factor that makes their square
// the exponent of two; it and all else that is common to the directions is applied to the sums.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <vector>

#include "tunica/wall/materials/fibre_energy.hpp"

namespace tunica::wall {

/// The image 0 of a direction is (N1, N2, N3), 1 is (N1, N2, -N3), 2 is (N1, -N2, N3) and 3 is (N1, -N2, -N3).
template <int images>
struct FibreGroup {
  /// N (x) N of the image 0 in Voigt order, and N (x) N (x) N (x) N:
  /// 1111 1122 1133 1112 1123 1113, 2222 2233 2212 2223 2213, 3333 3312 3323 3313.
  double products[21];
  double density[images];  ///< zero where the set has no such direction

  /// Sign of the entry n of N (x) N in an image.
  static constexpr double sign(int image, int n) {
    const bool third = n > 3 && image % 2 == 1, second = (n == 3 || n == 4) && image > 1;
    return third == second ? 1.0 : -1.0;
  }
};

/// Directions of fibres that have the same energy.
struct FibreBundle {
  FibreEnergy energy;
  std::vector<FibreGroup<4>> fours;
  std::vector<FibreGroup<2>> pairs;
  std::size_t directions = 0;  ///< number of them

  /// `directions` unit vectors in the fibre frame, no two of them equal up to the sign; `densities` rho_n, equally
  /// many.
  static FibreBundle make(const FibreEnergy& energy, std::span<const Vec3<double>> directions,
                          std::span<const double> densities);

  template <class Visitor>
  void visit_groups(const Visitor& visitor) const {
    for (const auto& group : fours) visitor(group);
    for (const auto& group : pairs) visitor(group);
  }
};

namespace detail {

/// Sums over the images with the signs of 11, 12, 23 and 13 (four images) or of 11 and 23 (two). Being its own
/// transpose, the same map takes the parts of a strain with these signs to the strains of the images.
template <class T>
TUNICA_INLINE void combine_images(const T (&x)[2], T (&sum)[2]) {
  sum[0] = x[0] + x[1];
  sum[1] = x[0] - x[1];
}
template <class T>
TUNICA_INLINE void combine_images(const T (&x)[4], T (&sum)[4]) {
  const T plus = x[0] + x[1], minus = x[0] - x[1], plus_mirrored = x[2] + x[3], minus_mirrored = x[2] - x[3];
  sum[0] = plus + plus_mirrored;
  sum[1] = plus - plus_mirrored;
  sum[2] = minus - minus_mirrored;
  sum[3] = minus + minus_mirrored;
}

/// Which of these sums goes with FibreGroup::products[n].
constexpr int combination(int images, int n) {
  constexpr int second_pair[21] = {0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4, 5, 1, 2, 3, 4, 5, 2, 3, 4, 5};
  const int voigt = second_pair[n];
  return images == 4 ? std::max(voigt - 2, 0) : voigt / 4;
}

/// Quantities that the directions of a bundle have in common.
template <class T>
struct FibreScales {
  double root;  ///< of k2 log2(e)
  double stress, tangent;
  T C[voigt_size];  ///< root C, shear counted twice
  double pulling;   ///< root times the strain above which a fibre takes part

  TUNICA_INLINE FibreScales(const FibreEnergy& energy, const Symmetric<T>& strain, bool tension_only) {
    constexpr double no_stiffening = 1e-30;  // keeps the root from vanishing
    root = std::sqrt(std::max(energy.k2, no_stiffening) * std::numbers::log2e);
    stress = 2.0 * energy.k1 / root;
    tangent = 4.0 * energy.k1;
    for (int n = 0; n < voigt_size; ++n) C[n] = T(n < 3 ? root : 2.0 * root) * strain[n];
    pulling = tension_only ? root * switch_strain : -std::numeric_limits<double>::infinity();
  }
};

/// At most one chunk of groups, with those left out that pull in no lane.
template <class T, int images>
struct FibreChunk {
  static constexpr int size = 128 / images;  // 16 KiB of AVX-512, half of the first cache
  T slope[size][images];                     ///< strains scaled by FibreScales::root, then combinations of the slopes
  T curvature[size][images];                 ///< combinations of the images, as the slopes without the common factors
  const FibreGroup<images>* group[size];
  int count;

  TUNICA_INLINE void find(const FibreGroup<images>* first, int n, const FibreScales<T>& scales) {
    count = 0;
    for (int i = 0; i < n; ++i) {
      const double* NN = first[i].products;
      const T diagonal = scales.C[0] * T(NN[0]) + (scales.C[1] * T(NN[1]) + (scales.C[2] * T(NN[2]) - T(scales.root)));
      if constexpr (images == 4) {
        const T parts[4] = {diagonal, scales.C[3] * T(NN[3]), scales.C[4] * T(NN[4]), scales.C[5] * T(NN[5])};
        combine_images(parts, slope[count]);
      } else {
        const T parts[2] = {diagonal + scales.C[3] * T(NN[3]), scales.C[4] * T(NN[4]) + scales.C[5] * T(NN[5])};
        combine_images(parts, slope[count]);
      }
      T largest = max(slope[count][0], slope[count][1]);
      if constexpr (images == 4) largest = max(largest, max(slope[count][2], slope[count][3]));
      group[count] = first + i;
      count += any_above(largest, T(scales.pulling)) ? 1 : 0;
    }
  }

  /// Combinations of rho f'/k1 and, if `with_curvature`, rho f''/k1.
  template <bool with_curvature>
  TUNICA_INLINE void differentiate(const FibreScales<T>& scales) {
    const T pulling(scales.pulling), zero(0.0), twice_ln2(2.0 * std::numbers::ln2);
    for (int i = 0; i < count; ++i) {
      T f[images], ff[images];
#pragma GCC unroll 4
      for (int image = 0; image < images; ++image) {
        const T E = slope[i][image], exponent = E * E;
        const T scaled = select(E > pulling, T(group[i]->density[image]) * exp2_of_nonnegative(exponent), zero);
        f[image] = scaled * E;
        if constexpr (with_curvature) ff[image] = scaled * (T(1.0) + twice_ln2 * exponent);
      }
      combine_images(f, slope[i]);
      if constexpr (with_curvature) combine_images(ff, curvature[i]);
    }
  }

  /// Adds the products begin ... end - 1 to the sums of stress and tangent.
  template <int begin, int end>
  TUNICA_INLINE void add(T (&sums)[21]) const {
    T s[end - begin];
#pragma GCC unroll 21
    for (int n = begin; n < end; ++n) s[n - begin] = sums[n];
    for (int i = 0; i < count; ++i) {
      const double* products = group[i]->products;
#pragma GCC unroll 21
      for (int n = begin; n < end; ++n)
        s[n - begin] += (n < 6 ? slope : curvature)[i][combination(images, n)] * T(products[n]);
    }
#pragma GCC unroll 21
    for (int n = begin; n < end; ++n) sums[n] = s[n - begin];
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
      bundle.visit_groups([&]<int images>(const FibreGroup<images>& group) {
        for (int image = 0; image < images; ++image) {
          T E(-1.0);
          for (int n = 0; n < voigt_size; ++n)
            E += T((n < 3 ? 1.0 : 2.0) * group.sign(image, n) * group.products[n]) * C[n];
          psi += T(group.density[image]) * bundle.energy.value(admitted(E, tension_only));
        }
      });
    return psi;
  }

  template <class T>
  TUNICA_INLINE Symmetric<T> stress(const Symmetric<T>& C) const {
    const T zero(0.0);
    Symmetric<T> S{{zero, zero, zero, zero, zero, zero}};
    for (const FibreBundle& bundle : bundles) {
      T sums[21];
      const double scale = sum<T, false>(bundle, C, sums).stress;
      for (int n = 0; n < voigt_size; ++n) S[n] += T(scale) * sums[n];
    }
    return S;
  }

  template <class T>
  TUNICA_INLINE Response<T> response(const Symmetric<T>& C) const {
    constexpr int entry[21] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 1, 10, 4, 7, 12, 2};
    Response<T> r = zero_response<T>();
    for (const FibreBundle& bundle : bundles) {
      T sums[21];
      const auto scales = sum<T, true>(bundle, C, sums);
#pragma GCC unroll 6
      for (int n = 0; n < voigt_size; ++n) r.stress[n] += T(scales.stress) * sums[n];
#pragma GCC unroll 21
      for (int n = 0; n < 21; ++n) r.tangent.v[n] += T(scales.tangent) * sums[6 + entry[n]];
    }
    return r;
  }

  std::size_t directions() const {
    std::size_t sum = 0;
    for (const FibreBundle& bundle : bundles) sum += bundle.directions;
    return sum;
  }

 private:
  /// The sums of stress and tangent over a bundle, and what they are to be multiplied by.
  template <class T, bool with_tangent>
  TUNICA_INLINE detail::FibreScales<T> sum(const FibreBundle& bundle, const Symmetric<T>& C, T (&sums)[21]) const {
#pragma GCC unroll 21
    for (int n = 0; n < 21; ++n) sums[n] = T(0.0);
    const detail::FibreScales<T> scales(bundle.energy, C, tension_only);
    sum_groups<T, with_tangent, 4>(bundle.fours, scales, sums);
    sum_groups<T, with_tangent, 2>(bundle.pairs, scales, sums);
    return scales;
  }

  template <class T, bool with_tangent, int images>
  static TUNICA_INLINE void sum_groups(const std::vector<FibreGroup<images>>& groups,
                                       const detail::FibreScales<T>& scales, T (&sums)[21]) {
    detail::FibreChunk<T, images> chunk;
    const int n = static_cast<int>(groups.size());
    for (int begin = 0; begin < n; begin += chunk.size) {
      chunk.find(groups.data() + begin, std::min(n - begin, chunk.size), scales);
      chunk.template differentiate<with_tangent>(scales);
      if constexpr (!with_tangent) {
        chunk.template add<0, 6>(sums);
      } else if constexpr (lanes<T> >= 8) {  // 32 registers hold all sums
        chunk.template add<0, 21>(sums);
      } else {
        chunk.template add<0, 11>(sums);
        chunk.template add<11, 21>(sums);
      }
    }
  }
};

}  // namespace tunica::wall
