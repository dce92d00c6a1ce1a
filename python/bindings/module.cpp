// The extension module tunica._core; the package tunica is what a user imports.
#include "bindings.hpp"

PYBIND11_MODULE(_core, m) {
  m.doc() = "Compiled part of the package tunica.";
  m.attr("version") = TUNICA_VERSION;
  tunica::python::bind_errors(m);
  tunica::python::bind_materials(m);
  tunica::python::bind_results(m);
}
