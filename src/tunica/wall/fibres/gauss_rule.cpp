#include "tunica/wall/fibres/gauss_rule.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

namespace tunica::wall {

namespace {

/// Recurrence p_{k+1} = (x - a_k) p_k - b_k p_{k-1} of the monic polynomials that are orthogonal under the measure; b_0
/// = 0.
struct Recurrence {
  std::vector<double> a, b;

  /// Points of the rule below x: the sign changes of the Sturm sequence.
  int points_below(double x) const {
    int below = 0;
    double ratio = 1.0;  // p_{k+1} / p_k
    for (std::size_t k = 0; k < a.size(); ++k) {
      ratio = x - a[k] - b[k] / ratio;
      if (ratio == 0.0) ratio = 1e-300;
      below += ratio > 0.0;
    }
    return below;
  }
  /// Weight of the point x (Golub & Welsch 1969): 1 / sum of the squares of the orthonormal polynomials.
  double weight(double x) const {
    double previous = 0.0, p = 1.0, sum = 1.0;
    for (std::size_t k = 0; k + 1 < a.size(); ++k) {
      const double next = ((x - a[k]) * p - std::sqrt(b[k]) * previous) / std::sqrt(b[k + 1]);
      previous = p;
      p = next;
      sum += p * p;
    }
    return 1.0 / sum;
  }
};

/// An even weight has a_k = 0; its measure is given on one half.
Recurrence stieltjes(const Quadrature& measure, int count, bool even) {
  struct Value {
    double previous = 0.0, p = 1.0;
  };
  std::vector<Value> values(measure.points.size());
  Recurrence r;
  double last = 1.0;
  for (int k = 0; k < count; ++k) {
    double square = 0.0, moment = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double w = measure.weights[i] * values[i].p * values[i].p;
      square += w;
      moment += w * measure.points[i];
    }
    const double a = even ? 0.0 : moment / square, b = k > 0 ? square / last : 0.0;
    r.a.push_back(a);
    r.b.push_back(b);
    last = square;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto [previous, p] = values[i];
      values[i] = {p, (measure.points[i] - a) * p - b * previous};
    }
  }
  return r;
}

/// Points number `first` and following, by bisection of [-1, 1].
Quadrature rule_of(const Recurrence& r, int first) {
  Quadrature rule;
  for (int n = first; n < static_cast<int>(r.a.size()); ++n) {
    double low = -1.0, high = 1.0;
    for (int halving = 0; halving < 55; ++halving) {
      const double middle = 0.5 * (low + high);
      (r.points_below(middle) > n ? high : low) = middle;
    }
    rule.points.push_back(0.5 * (low + high));
    rule.weights.push_back(r.weight(rule.points.back()));
  }
  return rule;
}

}  // namespace

Quadrature composite_rule(double from, double to, int panels) {
  using Gauss = boost::math::quadrature::gauss<double, 20>;
  Quadrature rule;
  const double half = 0.5 * (to - from) / panels;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = from + (2 * panel + 1) * half;
    for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i)
      for (const double side : {-1.0, 1.0}) {
        rule.points.push_back(middle + side * half * Gauss::abscissa()[i]);
        rule.weights.push_back(half * Gauss::weights()[i]);
      }
  }
  return rule;
}

Quadrature even_gauss_rule(const Quadrature& measure, int count) {
  Quadrature rule = rule_of(stieltjes(measure, count, true), count / 2);
  if (count % 2 == 1) rule.points.front() = 0.0;
  return rule;
}

Quadrature gauss_rule(const Quadrature& measure, int count) { return rule_of(stieltjes(measure, count, false), 0); }

}  // namespace tunica::wall
