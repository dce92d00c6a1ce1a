// The extension module tunica._solver; the package tunica is what a user imports.
#include "../bindings/bindings.hpp"
#include "solver.hpp"

PYBIND11_MODULE(_solver, m) {
  m.doc() = "Compiled part of the package tunica: cases, meshes and runs.";
  tunica::python::use_errors();
  tunica::python::bind_cases(m);
  tunica::python::bind_meshes(m);
  tunica::python::bind_simulation(m);
  tunica::python::bind_stages(m);
  tunica::python::bind_patient(m);
}
