// Laws as they are usually fitted to the wall of an artery: an incompressible matrix with two families of fibres on
// either side of the circumference, every parameter free within bounds that hold for arteries.
#pragma once

#include <string>
#include <vector>

#include "tunica/fitting/law_template.hpp"

namespace tunica::fitting {

/// "neo_hooke", "mooney_rivlin", "fung", "hgo", "goh", "dfd".
const std::vector<std::string>& standard_laws();

/// One of them, as YAML with the sections `material` and `parameters`.
std::string standard_law(const std::string& name);

/// A parameter as the case file has it: bounds and start with their unit.
struct ParameterSettings {
  std::string from, to;
  std::string start{};  ///< empty: in the middle
  bool own = false;
};

/// Throws InputError, with `where`, for texts that are no quantities or not of one kind, and for bounds in the wrong
/// order.
Parameter make_parameter(const std::string& name, const ParameterSettings& settings, const std::string& where);

/// Of the sections `material` and `parameters`. Throws InputError with all problems.
LawTemplate read_law(const config::Document& law, const std::string& where);

config::Schema<ParameterSettings> parameter_schema();

}  // namespace tunica::fitting
