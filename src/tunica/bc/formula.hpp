// A formula of place and time, as it stands in a case file: `1.5*y*(0.41-y)/0.2^2 * (t < 2 ? (1-cos(pi*t/2))/2 : 1)`.
//
// Operators + - * / ^, comparisons, && || and a ? b : c; functions sin, cos, tan, exp, ln, log10, sqrt, abs, sinh,
// cosh, tanh, asin, acos, atan, atan2, min, max and the others of muParser; the number pi.
#pragma once

#include <memory>
#include <string>

namespace tunica::bc {

class Formula {
 public:
  /// Throws InputError when the text is no formula of x, y, z and t.
  explicit Formula(const std::string& text);

  /// Value at a place and a time; NaN and infinity are returned as they come.
  double operator()(double x, double y, double z, double t) const;

 private:
  struct Parser;
  std::shared_ptr<Parser> parser_;  ///< holds the variables: copies share it, one thread at a time
};

}  // namespace tunica::bc
