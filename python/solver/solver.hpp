// The parts of the extension module tunica._solver: cases, meshes and runs. It starts MPI and PETSc with the first call
// that needs them, and is loaded with the first name that needs it.
#pragma once

#include <pybind11/pybind11.h>

namespace tunica::python {

/// Cases as text: checks, settings, their tree and their YAML.
void bind_cases(pybind11::module_& m);

/// Meshes that are read or made, and material axes.
void bind_meshes(pybind11::module_& m);

/// Runs, step by step.
void bind_simulation(pybind11::module_& m);

/// Prestress, outlets and quantities of cycles.
void bind_stages(pybind11::module_& m);
void bind_patient(pybind11::module_& m);

}  // namespace tunica::python
