from os import PathLike
from pathlib import Path
from typing import Any, Dict, Optional, Union

import numpy as np
from numpy.typing import NDArray

_Path = Union[str, "PathLike[str]"]
_Floats = NDArray[np.float64]

class MeasuredFlow:
    path: Path
    report: Dict[str, Any]
    curves: Dict[str, _Floats]
    def __init__(self, path: _Path) -> None: ...

class Motion:
    path: Path
    report: Dict[str, Any]
    curves: Dict[str, _Floats]
    def __init__(self, path: _Path) -> None: ...

def measure(
    file: _Path, output: Optional[_Path] = ..., *, overwrite: bool = ..., comm: Any = ..., verbose: bool = ...
) -> MeasuredFlow: ...
def motion(
    file: _Path, output: Optional[_Path] = ..., *, overwrite: bool = ..., comm: Any = ..., verbose: bool = ...
) -> Motion: ...
def follow_up(file: _Path, output: _Path, *, run: bool = ..., comm: Any = ..., verbose: bool = ...) -> Dict[str, Any]: ...
def what_if(
    file: _Path, output: _Path, *, comm: Any = ..., verbose: bool = ...
) -> Dict[str, Dict[str, float]]: ...
