// The parts of the extension module tunica._core, one function and one file each.
#pragma once

#include <pybind11/pybind11.h>

namespace tunica::python {

/// InputError and SolverError, into which the errors of the library turn, with the same text.
void bind_errors(pybind11::module_& m);
/// The same types for another extension module of the package: errors of the library turn into them there, too.
void use_errors();

/// Wall laws at material points.
void bind_materials(pybind11::module_& m);

/// Tables and manifests that a run has left.
void bind_results(pybind11::module_& m);

}  // namespace tunica::python
