from os import PathLike
from typing import Any, Union

from . import materials as materials
from ._core import InputError as InputError
from ._core import SolverError as SolverError
from .cases import Case as Case
from .meshes import Mesh as Mesh
from .meshes import material_axes as material_axes
from .patient import MeasuredFlow as MeasuredFlow
from .patient import Motion as Motion
from .patient import follow_up as follow_up
from .patient import identify as identify
from .patient import measure as measure
from .patient import motion as motion
from .patient import what_if as what_if
from .results import Fields as Fields
from .results import Pipeline as Pipeline
from .results import Results as Results
from .simulation import Simulation as Simulation
from .simulation import Step as Step
from .simulation import quantities as quantities
from .stages import CycleQuantities as CycleQuantities
from .stages import Outlets as Outlets
from .stages import Prestress as Prestress
from .stages import cycle_quantities as cycle_quantities
from .stages import prestress as prestress
from .stages import tune_outlets as tune_outlets

__version__: str

def open(folder: Union[str, "PathLike[str]"], unfinished: bool = ...) -> Any: ...
