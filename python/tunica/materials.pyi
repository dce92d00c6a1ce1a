from typing import Any, Dict, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Floats = NDArray[np.float64]
_Key = Union[str, float, Sequence[Any], Dict[str, Any], None]
_Direction = Union[str, Sequence[float], _Floats]

class Test:
    load: _Floats
    F: _Floats
    J: _Floats
    energy: _Floats
    pressure: _Floats
    cauchy: _Floats
    first_piola_kirchhoff: _Floats
    second_piola_kirchhoff: _Floats
    tangent: _Floats
    def __init__(self, load: _Floats, values: Dict[str, _Floats]) -> None: ...
    def stress(self, measure: str = ..., across: bool = ...) -> _Floats: ...
    def __len__(self) -> int: ...

class Material:
    def __init__(self, yaml: str) -> None: ...
    @property
    def yaml(self) -> str: ...
    @property
    def incompressible(self) -> bool: ...
    @property
    def bulk_modulus(self) -> float: ...
    @property
    def shear_modulus(self) -> float: ...
    @property
    def fibre_directions(self) -> _Floats: ...
    @property
    def notes(self) -> Sequence[str]: ...
    @property
    def warnings(self) -> Sequence[str]: ...
    def energy(self, F: ArrayLike, out: Optional[_Floats] = ...) -> _Floats: ...
    def stress(
        self, F: ArrayLike, measure: str = ..., pressure: Optional[ArrayLike] = ..., out: Optional[_Floats] = ...
    ) -> _Floats: ...
    def tangent(
        self, F: ArrayLike, pressure: Optional[ArrayLike] = ..., out: Optional[_Floats] = ...
    ) -> _Floats: ...
    def response(
        self,
        F: ArrayLike,
        pressure: Optional[ArrayLike] = ...,
        out: Tuple[Optional[_Floats], Optional[_Floats]] = ...,
    ) -> Tuple[_Floats, _Floats]: ...
    def uniaxial(
        self,
        to: Optional[float] = ...,
        steps: int = ...,
        along: _Direction = ...,
        stretches: Optional[ArrayLike] = ...,
    ) -> Test: ...
    def biaxial(
        self,
        to: Optional[float] = ...,
        to_across: Optional[float] = ...,
        steps: int = ...,
        along: _Direction = ...,
        across: _Direction = ...,
        stretches: Optional[ArrayLike] = ...,
    ) -> Test: ...
    def simple_shear(
        self,
        to: Optional[float] = ...,
        steps: int = ...,
        along: _Direction = ...,
        across: _Direction = ...,
        shears: Optional[ArrayLike] = ...,
    ) -> Test: ...

def from_yaml(text: str) -> Material: ...
def laws() -> Dict[str, Dict[str, Any]]: ...

def neo_hooke(
    *,
    young_modulus: _Key = ...,
    shear_modulus: _Key = ...,
    poisson_ratio: _Key = ...,
    bulk_modulus: _Key = ...,
    volumetric_energy: Optional[str] = ...,
    incompressible: Optional[bool] = ...,
) -> Material: ...
def mooney_rivlin(
    *,
    poisson_ratio: _Key = ...,
    bulk_modulus: _Key = ...,
    c1: _Key = ...,
    c2: _Key = ...,
    volumetric_energy: Optional[str] = ...,
    incompressible: Optional[bool] = ...,
) -> Material: ...
def hgo(
    *,
    young_modulus: _Key = ...,
    shear_modulus: _Key = ...,
    poisson_ratio: _Key = ...,
    bulk_modulus: _Key = ...,
    exclusion: _Key = ...,
    fibre_energy: _Key = ...,
    families: _Key = ...,
    volumetric_energy: Optional[str] = ...,
    incompressible: Optional[bool] = ...,
) -> Material: ...
def goh(
    *,
    young_modulus: _Key = ...,
    shear_modulus: _Key = ...,
    poisson_ratio: _Key = ...,
    bulk_modulus: _Key = ...,
    exclusion: _Key = ...,
    fibre_energy: _Key = ...,
    families: _Key = ...,
    volumetric_energy: Optional[str] = ...,
    incompressible: Optional[bool] = ...,
) -> Material: ...
def fung(
    *,
    poisson_ratio: _Key = ...,
    bulk_modulus: _Key = ...,
    c: _Key = ...,
    b_cc: _Key = ...,
    b_ll: _Key = ...,
    b_rr: _Key = ...,
    b_cl: _Key = ...,
    b_lr: _Key = ...,
    b_rc: _Key = ...,
    g_cl: _Key = ...,
    g_lr: _Key = ...,
    g_rc: _Key = ...,
    volumetric_energy: Optional[str] = ...,
    incompressible: Optional[bool] = ...,
) -> Material: ...
def dfd(
    *,
    young_modulus: _Key = ...,
    shear_modulus: _Key = ...,
    poisson_ratio: _Key = ...,
    bulk_modulus: _Key = ...,
    exclusion: _Key = ...,
    fibre_energy: _Key = ...,
    directions: _Key = ...,
    families: _Key = ...,
    volumetric_energy: Optional[str] = ...,
    incompressible: Optional[bool] = ...,
) -> Material: ...
def st_venant_kirchhoff(
    *,
    young_modulus: _Key = ...,
    shear_modulus: _Key = ...,
    poisson_ratio: _Key = ...,
    bulk_modulus: _Key = ...,
    volumetric_energy: Optional[str] = ...,
    incompressible: Optional[bool] = ...,
) -> Material: ...
def holzapfel_ogden(
    *,
    exclusion: _Key = ...,
    fibre_energy: _Key = ...,
    poisson_ratio: _Key = ...,
    bulk_modulus: _Key = ...,
    a: _Key = ...,
    b: _Key = ...,
    a_f: _Key = ...,
    b_f: _Key = ...,
    a_s: _Key = ...,
    b_s: _Key = ...,
    a_fs: _Key = ...,
    b_fs: _Key = ...,
    volumetric_energy: Optional[str] = ...,
    incompressible: Optional[bool] = ...,
) -> Material: ...
def aortic_tissue(
    value: str, *, volumetric_energy: Optional[str] = ..., incompressible: Optional[bool] = ...
) -> Material: ...
def fitted(
    value: str, *, volumetric_energy: Optional[str] = ..., incompressible: Optional[bool] = ...
) -> Material: ...
