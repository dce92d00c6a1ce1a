"""Data of a patient: measured flow, motion over the beat, scans over the years, values found from measurements, and what
a treatment would change.

Each takes the YAML file of the subcommand of that name.
"""

import csv
import os
from pathlib import Path

from . import _core, _solver
from .stages import _read, _stopped

__all__ = ["Motion", "MeasuredFlow", "follow_up", "identify", "measure", "motion", "what_if"]


class MeasuredFlow:
    """``path`` of its folder, ``report`` as flows.json has it, ``curves``: columns of flows.csv by their headings."""

    def __init__(self, path):
        self.path = Path(path)
        self.report = _read(self.path / "flows.json") if (self.path / "flows.json").exists() else {}
        self.curves = _curves(self.path / "flows.csv")


class Motion:
    """``path`` of its folder, ``report`` as motion.json has it, ``curves``: columns of curves.csv by their headings."""

    def __init__(self, path):
        self.path = Path(path)
        self.report = _read(self.path / "motion.json")
        self.curves = _curves(self.path / "curves.csv")


def _curves(file):
    return _core.read_table(file, "measure again") if file.exists() else {}


def _paths(file, output):
    return Path(os.fspath(file)).resolve(), None if output is None else Path(os.fspath(output)).resolve()


def measure(file, output=None, *, overwrite=False, comm=None, verbose=False):
    """Flows and inlet profiles in velocity images, as `tunica measure`; returns a MeasuredFlow. Collective."""
    file, output = _paths(file, output)
    return MeasuredFlow(_solver.measure(file, output, overwrite, comm, verbose))


def motion(file, output=None, *, overwrite=False, comm=None, verbose=False):
    """Motion of wall, flap and lumens over the beat, as `tunica motion`; returns a Motion. Collective."""
    file, output = _paths(file, output)
    return Motion(_solver.motion(file, output, overwrite, comm, verbose))


def follow_up(file, output, *, run=False, comm=None, verbose=False):
    """Growth between scans, as `tunica follow-up`, into ``output``; returns the numbers of follow_up.json.

    ``run`` computes the beat of every scan. Ctrl-C stops it; called again it goes on. Collective.
    """
    file, output = _paths(file, output)
    _stopped(_solver.follow_up(file, output, run, comm, verbose))
    return _read(output / "follow_up.json")


def identify(file, output, *, comm=None, verbose=False):
    """Values of a case from measurements, as `tunica identify`, into ``output``; returns the numbers of identify.json.

    ``converged`` there says whether the search came to its end. Ctrl-C stops it; called again it goes on. Collective.
    """
    file, output = _paths(file, output)
    _stopped(_solver.identify(file, output, comm, verbose))
    return _read(output / "identify.json")


def what_if(file, output, *, comm=None, verbose=False):
    """A case and its variants side by side, as `tunica what-if`, into ``output``; returns what_if.csv: for each quantity,
    with its unit in brackets, the values by the name of the variant, nan where there is none.

    Ctrl-C stops it; called again it goes on. Collective.
    """
    file, output = _paths(file, output)
    _stopped(_solver.what_if(file, output, comm, verbose))
    with open(output / "what_if.csv", newline="", encoding="utf-8") as table:
        names, *rows = csv.reader(table)
    return {f"{what} [{unit}]": {name: float(value or "nan") for name, value in zip(names[2:], values)}
            for what, unit, *values in rows}
