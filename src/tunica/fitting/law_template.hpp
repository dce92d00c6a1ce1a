// A wall law in which some values are still to be found: the section `material` of a case in which `$name` and `-$name`
// stand for parameters. Whatever the schema of a law accepts as a number can be one, of every law alike, and what is
// found is read the way a case reads it.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "tunica/config/document.hpp"
#include "tunica/wall/material.hpp"

namespace tunica::fitting {

/// A value to be found, in SI units.
struct Parameter {
  std::string name;
  config::Dimension dimension{};
  double start = 0.0, low = 0.0, high = 0.0;
  bool own = false;  ///< has every specimen a value of its own?

  /// Is it searched by its logarithm? Where it is positive over a decade or more.
  bool logarithmic() const { return low > 0.0 && high >= 10.0 * low; }
  /// From the value to 0 ... 1 between the bounds, and back.
  double scaled(double value) const;
  double value(double scaled) const;
  /// Of a value in a usual unit: "61.2 kPa".
  std::string text(double value, int digits = 4) const;
  double per_unit() const;   ///< SI value of one of that unit
  std::string unit() const;  ///< "kPa", "deg" or empty
};

/// The parts of a law section that name parameters.
class LawTemplate {
 public:
  /// `material` is what stands below the key `material`. Throws InputError, with `where`, when it names a parameter
  /// that is not there or does not name one that is, and for a law that reads no value of a parameter.
  LawTemplate(const config::Document& material, std::vector<Parameter> parameters, const std::string& where);
  LawTemplate(const LawTemplate& other);
  LawTemplate& operator=(const LawTemplate&) = delete;

  const std::vector<Parameter>& parameters() const { return parameters_; }
  /// Where a parameter stands: "dfd.families[1].k1". Its first place.
  const std::string& key(std::size_t parameter) const { return keys_[parameter]; }

  /// The law with these values, one for each parameter. Throws InputError where its schema refuses them. Not for two
  /// threads at once: each takes a copy.
  wall::LawParameters at(std::span<const double> values) const;
  /// The section `material` with these values, in usual units.
  std::string yaml(std::span<const double> values) const;
  /// The document with the starting values.
  config::Document started() const;

 private:
  struct Slot;
  void find_slots();
  void fill(std::span<const double> values, bool usual_units) const;

  config::Document document_;
  std::vector<Parameter> parameters_;
  std::vector<std::string> keys_;
  std::string where_;
  std::vector<std::shared_ptr<Slot>> slots_;
  config::Schema<wall::LawParameters> schema_;
};

}  // namespace tunica::fitting
