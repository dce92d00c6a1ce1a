from os import PathLike
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.float64]
_Path = Union[str, "PathLike[str]"]
_Say = Optional[Callable[[str], Any]]

class Mesh:
    points: _Floats
    elements: NDArray[np.int64]
    fields: Dict[str, _Floats]
    regions: Dict[str, Tuple[str, slice]]
    faces: List[str]
    section: Dict[str, Any]
    report: Optional[Dict[str, Any]]
    def __init__(
        self, source: Union[Dict[str, Any], _Path], *, fields: Sequence[str] = ..., folder: Optional[_Path] = ...
    ) -> None: ...
    @classmethod
    def make(
        cls, output: _Path, *, overwrite: bool = ..., say: _Say = ..., folder: Optional[_Path] = ..., **sections: Any
    ) -> "Mesh": ...
    def face(self, name: str) -> NDArray[np.int64]: ...
    @property
    def notes(self) -> List[str]: ...

def material_axes(
    mesh: Mesh, output: _Path, *, overwrite: bool = ..., comm: Any = ..., say: _Say = ..., **settings: Any
) -> Mesh: ...
