from os import PathLike
from typing import Any, Union

from . import materials as materials
from ._core import InputError as InputError
from ._core import SolverError as SolverError
from .results import Fields as Fields
from .results import Pipeline as Pipeline
from .results import Results as Results

__version__: str

def open(folder: Union[str, "PathLike[str]"], unfinished: bool = ...) -> Any: ...
