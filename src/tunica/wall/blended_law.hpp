// Laws that share an element: Psi = sum_i w_i Psi_i with weights that go smoothly from one material to the next, so
// that neither energy nor stress jumps at the border between two regions.
//
// Each law is evaluated by out-of-line functions, so that the element kernels are compiled for the blend alone and not
// once more for every law of the list.
#pragma once

#include <span>
#include <variant>

#include "tunica/wall/material.hpp"

namespace tunica::wall {

/// What a kernel may leave out: laws that are linear in C_bar have no CC_bar, few have a part outside the split.
enum class LawKind { linear, isochoric, unsplit };

/// Of laws that are blended in one element.
LawKind kind_of(std::span<const Law* const> laws);

namespace detail {

/// S_bar = 2 dPsi/dC_bar of any law of the list.
template <class T>
__attribute__((noinline)) Symmetric<T> evaluate_stress(const Law& law, const Symmetric<T>& C_bar) {
  return std::visit([&](const auto& l) { return stress(l, C_bar); }, law);
}

/// S_bar and CC_bar of any law of the list.
template <class T>
__attribute__((noinline)) Response<T> evaluate_response(const Law& law, const Symmetric<T>& C_bar) {
  return std::visit(
      [&](const auto& l) {
        if constexpr (is_linear<std::decay_t<decltype(l)>>) {
          Response<T> r = zero_response<T>();
          r.stress = stress(l, C_bar);
          return r;
        } else {
          return response(l, C_bar);
        }
      },
      law);
}

/// Calls `visitor` with the law if it has a part outside the isochoric split.
template <class Visitor>
void visit_unsplit(const Law& law, const Visitor& visitor) {
  std::visit(
      [&](const auto& l) {
        if constexpr (can_be_unsplit<std::decay_t<decltype(l)>>)
          if (l.has_unsplit_part()) visitor(l);
      },
      law);
}

template <class T>
__attribute__((noinline)) Symmetric<T> evaluate_unsplit_stress(const Law& law, const Symmetric<T>& C) {
  Symmetric<T> S = zero_response<T>().stress;
  visit_unsplit(law, [&](const auto& l) { S = l.unsplit_stress(C); });
  return S;
}

template <class T>
__attribute__((noinline)) Response<T> evaluate_unsplit_response(const Law& law, const Symmetric<T>& C) {
  Response<T> r = zero_response<T>();
  visit_unsplit(law, [&](const auto& l) { r = l.unsplit_response(C); });
  return r;
}

}  // namespace detail

/// A law (material_concept.hpp) made of laws of the list. It refers to its arguments.
template <class T>
struct BlendedLaw {
  std::span<const Law* const> laws;
  const double* weights = nullptr;        ///< [law][lane], summing to one; null for a single law
  const double* point_weights = nullptr;  ///< the same at each point [point][law][lane]; null: everywhere as `weights`
  T shear_modulus;                        ///< blended, at rest [Pa]
  T stabilising_modulus;                  ///< of the present state, (1.16) [Pa]

  TUNICA_INLINE T shear_modulus_at_rest() const { return shear_modulus; }

  TUNICA_INLINE BlendedLaw at_point(int q) const {
    BlendedLaw law = *this;
    law.go_to_point(q);
    return law;
  }

  T energy(const Symmetric<T>& C_bar) const {
    return sum_of([&](const Law& law) { return std::visit([&](const auto& l) { return l.energy(C_bar); }, law); });
  }
  Symmetric<T> stress(const Symmetric<T>& C_bar) const {
    return stress_of([&](const Law& law) { return detail::evaluate_stress(law, C_bar); });
  }
  Response<T> response(const Symmetric<T>& C_bar) const {
    return response_of([&](const Law& law) { return detail::evaluate_response(law, C_bar); });
  }

 protected:
  TUNICA_INLINE void go_to_point(int q) {
    if (point_weights != nullptr) weights = point_weights + q * static_cast<std::ptrdiff_t>(laws.size()) * lanes<T>;
  }
  TUNICA_INLINE T weight(std::size_t i) const {
    if constexpr (lanes<T> == 1)
      return weights[i];
    else
      return T::load(weights + i * lanes<T>);
  }
  template <class Energy>
  T sum_of(const Energy& energy_of) const {
    if (weights == nullptr) return energy_of(*laws[0]);
    T sum(0.0);
    for (std::size_t i = 0; i < laws.size(); ++i) sum += weight(i) * energy_of(*laws[i]);
    return sum;
  }
  template <class Evaluate>
  TUNICA_INLINE Symmetric<T> stress_of(const Evaluate& evaluate) const {
    Symmetric<T> sum = evaluate(*laws[0]);
    if (weights == nullptr) return sum;
    sum = weight(0) * sum;
    for (std::size_t i = 1; i < laws.size(); ++i) {
      sum = sum + weight(i) * evaluate(*laws[i]);
    }
    return sum;
  }
  template <class Evaluate>
  TUNICA_INLINE Response<T> response_of(const Evaluate& evaluate) const {
    Response<T> sum = evaluate(*laws[0]);
    if (weights == nullptr) return sum;
    scale(sum, weight(0));
    for (std::size_t i = 1; i < laws.size(); ++i) {
      Response<T> r = evaluate(*laws[i]);
      scale(r, weight(i));
      sum.stress = sum.stress + r.stress;
      for (int n = 0; n < 21; ++n) sum.tangent.v[n] += r.tangent.v[n];
    }
    return sum;
  }
  static TUNICA_INLINE void scale(Response<T>& r, const T& w) {
    r.stress = w * r.stress;
    for (T& x : r.tangent.v) x *= w;
  }
};

/// A blend some of whose laws may have a part outside the isochoric split.
template <class T>
struct UnsplitBlendedLaw : BlendedLaw<T> {
  bool has_unsplit_part() const { return true; }

  TUNICA_INLINE UnsplitBlendedLaw at_point(int q) const {
    UnsplitBlendedLaw law = *this;
    law.go_to_point(q);
    return law;
  }

  T unsplit_energy(const Symmetric<T>& C) const {
    return this->sum_of([&](const Law& law) {
      T psi(0.0);
      detail::visit_unsplit(law, [&](const auto& l) { psi = l.unsplit_energy(C); });
      return psi;
    });
  }
  Symmetric<T> unsplit_stress(const Symmetric<T>& C) const {
    return this->stress_of([&](const Law& law) { return detail::evaluate_unsplit_stress(law, C); });
  }
  Response<T> unsplit_response(const Symmetric<T>& C) const {
    return this->response_of([&](const Law& law) { return detail::evaluate_unsplit_response(law, C); });
  }
};

}  // namespace tunica::wall
