from os import PathLike
from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

_Floats = NDArray[np.float64]

class Fields:
    time: float
    file: Path
    points: _Floats
    cells: NDArray[np.int64]
    node_ids: NDArray[np.int64]
    element_ids: NDArray[np.int64]
    point_data: Dict[str, _Floats]
    cell_data: Dict[str, _Floats]
    def __init__(
        self,
        time: float,
        file: Path,
        mesh: Tuple[_Floats, NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]],
        point_data: Dict[str, _Floats],
        cell_data: Dict[str, _Floats],
    ) -> None: ...
    def __getitem__(self, name: str) -> _Floats: ...
    def keys(self) -> List[str]: ...
    def to_vtk(self) -> Any: ...
    def to_pyvista(self) -> Any: ...

class Results:
    path: Path
    manifest: Dict[str, Any]
    status: str
    regions: List[str]
    def __init__(self, path: Union[str, "PathLike[str]"], unfinished: bool = ...) -> None: ...
    @property
    def case_text(self) -> str: ...
    def histories(self) -> List[str]: ...
    def history(self, name: str) -> Dict[str, _Floats]: ...
    def frame(self, name: str) -> Any: ...
    def times(self, region: str) -> _Floats: ...
    def fields(self, region: str, instant: int = ...) -> Fields: ...

class Pipeline:
    path: Path
    stages: Dict[str, Dict[str, Any]]
    run: Optional[Results]
    def __init__(self, path: Union[str, "PathLike[str]"], unfinished: bool = ...) -> None: ...
    @property
    def report(self) -> Dict[str, Dict[str, Any]]: ...

def open_results(folder: Union[str, "PathLike[str]"], unfinished: bool = ...) -> Any: ...
