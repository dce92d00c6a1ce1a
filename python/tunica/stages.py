"""Stages around a run: prestress and outlets before it, quantities of its cycles after it."""

import json
import os
import signal
from pathlib import Path

from . import _solver
from .cases import as_case

__all__ = ["CycleQuantities", "Outlets", "Prestress", "cycle_quantities", "prestress", "tune_outlets"]


def _read(file):
    return json.loads(file.read_text(encoding="utf-8"))


def _stopped(number):
    if number == signal.SIGINT:
        raise KeyboardInterrupt
    if number:
        raise SystemExit(128 + number)


class Prestress:
    """``path`` of its folder, ``report`` as prestress.json has it; apply() names it in a case."""

    def __init__(self, path):
        self.path = Path(path)
        self.report = _read(self.path / "prestress.json")

    def apply(self, case):
        """The case of a run of the prestressed wall, which starts from its state."""
        return as_case(case).replace({"wall.prestress": str(self.path / "wall.vtu"), "prestress": None,
                                      "start": str(self.path / "start.checkpoint")})


class Outlets:
    """``path`` of its folder, ``report`` as tuning.json has it, ``file`` of the outlets, which a run of the case takes."""

    def __init__(self, path, file):
        self.path, self.file = Path(path), Path(file)
        self.report = _read(self.path / "tuning.json")


class CycleQuantities:
    """``path`` of its folder and ``report`` as post.json has it."""

    def __init__(self, path):
        self.path = Path(path)
        self.report = _read(self.path / "post.json")


def prestress(case, output, *, overwrite=False, keep_flow=False, comm=None, verbose=False):
    """Finds the prestress of the wall as `tunica prestress` does, into the folder ``output``; returns a Prestress.

    Ctrl-C stops it with what it has found; called again it goes on. ``verbose`` prints its log. Collective.
    """
    case, output = as_case(case), Path(os.fspath(output)).resolve()
    _stopped(_solver.prestress(case.yaml, case.file, output, overwrite, keep_flow, comm, verbose))
    return Prestress(output)


def tune_outlets(case, output, *, overwrite=False, comm=None, verbose=False):
    """Finds the outlets that the section ``outlets`` of the case asks for as `tunica tune` does; returns Outlets.

    Ctrl-C stops it; called again it goes on. Raises SolverError where no outlets do what is asked. Collective.
    """
    case, output = as_case(case), Path(os.fspath(output)).resolve()
    case = case.replace({"outlets.output": str(output)})
    _stopped(_solver.tune(case.yaml, case.file, output, overwrite, comm, verbose))
    return Outlets(output, case.settings.get("outlets.file") or output / "outlets.yaml")


def cycle_quantities(case, output, *, results=None, overwrite=False, comm=None, verbose=False):
    """Quantities of a cycle of a finished run as `tunica post` finds them: shear, lumens, tears; returns CycleQuantities.

    ``results``: the folder of the run, in place of the case's. Collective.
    """
    case, output = as_case(case), Path(os.fspath(output)).resolve()
    folder = case.settings["output.directory"] if results is None else os.path.abspath(os.fspath(results))
    _solver.cycle_quantities(case.yaml, case.file, folder, output, overwrite, comm, verbose)
    return CycleQuantities(output)
