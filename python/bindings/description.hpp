// What a section of the case file may hold, as Python objects.
#pragma once

#include <pybind11/pybind11.h>

#include "tunica/config/description.hpp"

namespace tunica::python {

/// {name, help, one_of, keys: [{key, kind, help, required, default, unit, units, allowed, names, section}]}; keys of
/// included sections stand among the others.
pybind11::dict to_dict(const config::Description& description);

}  // namespace tunica::python
