"""tunica: fluid-structure interaction in aortic dissection.

- `tunica.materials`: wall laws with their units, stress and tangent of arrays of deformation gradients, tests.
- `tunica.open(folder)`: histories, fields and figures that a finished run has left.

What the command line refuses is refused here with the same text: `InputError` (a `ValueError`) for input that is
wrong, `SolverError` (a `RuntimeError`) for a computation that failed.
"""

from . import materials
from ._core import InputError, SolverError
from ._core import version as __version__
from .results import Fields, Pipeline, Results
from .results import open_results as open

__all__ = ["Fields", "InputError", "Pipeline", "Results", "SolverError", "__version__", "materials", "open"]
