"""tunica: fluid-structure interaction in aortic dissection.

- `tunica.materials`: wall laws with their units, stress and tangent of arrays of deformation gradients, tests.
- `tunica.Case`, `tunica.Mesh`, `tunica.material_axes`: what is computed, and on what.
- `tunica.prestress`, `tunica.tune_outlets`, `tunica.Simulation`, `tunica.cycle_quantities`: the computation, runs step by step.
- `tunica.measure`, `tunica.motion`, `tunica.follow_up`, `tunica.identify`, `tunica.what_if`: data of a patient, variants of a case.
- `tunica.open(folder)`: histories, fields and figures that a finished run has left.

What the command line refuses is refused here with the same text: `InputError` (a `ValueError`) for input that is
wrong, `SolverError` (a `RuntimeError`) for a computation that failed.
"""

from importlib import import_module as _import_module

from . import materials
from ._core import InputError, SolverError
from ._core import version as __version__
from .results import Fields, Pipeline, Results
from .results import open_results as open

# These bring MPI, PETSc and VTK, so they are loaded when they are asked for.
_solver_names = {
    "Case": "cases",
    "Mesh": "meshes",
    "material_axes": "meshes",
    "Simulation": "simulation",
    "Step": "simulation",
    "quantities": "simulation",
    "CycleQuantities": "stages",
    "Outlets": "stages",
    "Prestress": "stages",
    "cycle_quantities": "stages",
    "prestress": "stages",
    "tune_outlets": "stages",
    "MeasuredFlow": "patient",
    "Motion": "patient",
    "follow_up": "patient",
    "identify": "patient",
    "measure": "patient",
    "motion": "patient",
    "what_if": "patient",
}

__all__ = ["Fields", "InputError", "Pipeline", "Results", "SolverError", "__version__", "materials", "open",
           *_solver_names]


def __getattr__(name):
    if name not in _solver_names:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value = getattr(_import_module("." + _solver_names[name], __name__), name)
    return value


def __dir__():
    return sorted({*globals(), *_solver_names})
