from os import PathLike
from pathlib import Path
from typing import Any, Dict, Optional, Union

from .cases import Case

_Path = Union[str, "PathLike[str]"]
_Case = Union[Case, Dict[str, Any], _Path]

class Prestress:
    path: Path
    report: Dict[str, Any]
    def __init__(self, path: _Path) -> None: ...
    def apply(self, case: _Case) -> Case: ...

class Outlets:
    path: Path
    file: Path
    report: Dict[str, Any]
    def __init__(self, path: _Path, file: _Path) -> None: ...

class CycleQuantities:
    path: Path
    report: Dict[str, Any]
    def __init__(self, path: _Path) -> None: ...

def prestress(
    case: _Case, output: _Path, *, overwrite: bool = ..., keep_flow: bool = ..., comm: Any = ..., verbose: bool = ...
) -> Prestress: ...
def tune_outlets(
    case: _Case, output: _Path, *, overwrite: bool = ..., comm: Any = ..., verbose: bool = ...
) -> Outlets: ...
def cycle_quantities(
    case: _Case,
    output: _Path,
    *,
    results: Optional[_Path] = ...,
    overwrite: bool = ...,
    comm: Any = ...,
    verbose: bool = ...,
) -> CycleQuantities: ...
