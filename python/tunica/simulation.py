"""Runs, step by step.

>>> import tempfile, tunica
>>> case = tunica.Case(
...     analysis="flow", elements="linear", meshes={"tube": {"radius": "5 mm", "length": "10 mm", "cells_around": 8}},
...     fluid={}, boundary={"lumen_inlet": {"flow": "10 ml/s"}, "lumen_outlet": {"pressure": "0 Pa"},
...                         "lumen_wall": "no_slip"},
...     time={"step": "1 ms", "steps": 2})
>>> with tempfile.TemporaryDirectory() as folder:
...     for step in tunica.Simulation(case, directory=folder):
...         print(step.number, f"{step.time:.3f} s, {1e6 * step.flow['lumen_outlet']:.2f} ml/s")
1 0.001 s, 6.67 ml/s
2 0.002 s, 10.00 ml/s
"""

import json
import os
import sys
import time

from . import _core, _solver
from .cases import as_case
from .results import open_results

__all__ = ["Simulation", "Step", "quantities"]

_UNITS = {"proximal": "Pa s/m^3", "distal": "Pa s/m^3", "resistance": "Pa s/m^3", "capacitance": "m^3/Pa",
          "distal_pressure": "Pa"}


class Step:
    """What a step has brought, in SI units; of its last part, where it was taken in parts.

    ``number`` completed steps, ``time`` at its end (the load factor in statics), ``dt``, ``newton_iterations``,
    ``linear_iterations``, ``residual``, ``seconds``. By lumen face at the time ``evaluated``, or at the end with
    ``output: {instant: end}``: ``flow`` out of the lumen [m^3/s], mean ``pressure`` [Pa], ``area`` [m^2]. ``lumen_volume``,
    ``wall_volume`` [m^3], ``max_velocity`` [m/s], ``max_displacement`` [m]; ``points``: of the case, by name.
    """

    def __init__(self, values):
        faces = values.pop("faces")
        for name in ("flow", "pressure", "area"):
            setattr(self, name, {face: of_face[name] for face, of_face in faces.items()})
        for name, value in values.items():
            setattr(self, name, value)

    def __repr__(self):
        return f"<step {self.number}: t = {self.time:.6g} s, {self.newton_iterations} iterations>"


def quantities():
    """What results can have and Simulation.quantity() gives: dict of a line of text by key.

    >>> import tunica
    >>> tunica.quantities()["vorticity"]
    'curl of the velocity of the blood: mean over the elements at a node'
    """
    return {key: text for key, _, text, _ in _solver.quantities()}


class _Outlets:
    """Parameters of the outlets by face, as dicts in SI units, to be read and set between steps."""

    def __init__(self, core):
        self._core = core

    def __getitem__(self, face):
        return self._core.outlet(face)

    def __setitem__(self, face, values):
        """Other parameters from now on; those left out stay. Plain numbers are in SI units; text has its unit."""
        merged = {**self._core.outlet(face), **values}
        kind = "resistance" if "resistance" in merged else "rcr"
        merged = {key: value if isinstance(value, str) else f"{float(value)!r} {_UNITS.get(key, '')}"
                  for key, value in merged.items()}
        self._core.set_outlet(face, json.dumps({kind: merged}))

    def keys(self):
        return list(self._core.outlet_states())

    def __iter__(self):
        return iter(self.keys())

    def __len__(self):
        return len(self.keys())

    @property
    def states(self):
        """``flow`` [m^3/s], ``pressure`` and ``stored_pressure`` [Pa] of each at the end of the last step."""
        return self._core.outlet_states()


class _Progress:
    """One line that is written over; at most five times a second, and where someone can see it."""

    def __init__(self, wanted):
        self._on = (sys.stderr.isatty() or "ipykernel" in sys.modules) if wanted is None else bool(wanted)
        self._shown, self._began = 0.0, None

    def show(self, done, asked, seconds):
        now = time.monotonic()
        if self._began is None:
            self._began = now, done - 1
        if not self._on or (now - self._shown < 0.2 and done < asked):
            return
        self._shown = now
        each = (now - self._began[0]) / max(done - self._began[1] - 1, 1)
        left = f"  {each * (asked - done):.0f} s left" if done - self._began[1] > 1 else ""
        sys.stderr.write(f"\rstep {done}/{asked}  t {seconds:.6g} s{left}   ")
        sys.stderr.flush()

    def end(self):
        if self._on and self._shown:
            sys.stderr.write("\n")
            self._shown = 0.0


class Simulation:
    """The run of a case, an iterator over its steps: the same steps and files as `tunica run` takes and writes.

    ``case``: a Case, the path of a case file or a dict, without stages before the run. ``inflow``: functions of the time [s]
    by face, that give the flow into the lumen [m^3/s] in the place of what the condition ``flow`` of the case says (which
    stands there as ``flow: 0 ml/s``, say); called on process 0 several times a step, with ascending times but for steps that
    are repeated. ``directory``: of the results, in place of the case's; ``overwrite``: earlier ones there may be removed;
    ``restart``: go on from the last checkpoint there (True) or from this file; ``until``: stop when so many steps are
    completed; ``comm``: a communicator of mpi4py, all processes when left out; every method is collective then.
    ``progress``: show the state of the run on one line, where left out in terminals and notebooks; ``verbose``: print the log.

    Ctrl-C raises KeyboardInterrupt between two steps, and nothing is lost: the loop can be taken up again, or the run be
    finished. An error of a step, or of a function that is called, ends the run, with a checkpoint of the step before.
    A loop that comes to its end finishes the run; one that is left early has finish() to write its last step, as the end of
    a ``with`` block does.
    """

    def __init__(self, case, *, inflow=None, directory=None, overwrite=False, restart=False, until=None, comm=None,
                 progress=None, verbose=False):
        case = as_case(case)
        for section, function in (("mesh", "Mesh.make"), ("fibres", "material_axes")):
            if section in case:
                raise _core.input_error(section, "is a stage of its own, before the run",
                                        f"make it by tunica.{function}, and give the case its section `meshes`")
        if restart and overwrite:
            raise _core.input_error("restart", "is given together with overwrite", "leave out one of them")
        file = None if isinstance(restart, bool) else os.fspath(restart)
        directory = None if directory is None else os.path.abspath(os.fspath(directory))
        self.case = case
        self._core = _solver.Simulation(case.yaml, case.file, comm, directory, restart is True, file, overwrite, until,
                                        dict(inflow or {}), verbose)
        self._progress = _Progress(False if verbose and progress is None else progress)
        self.outlets = _Outlets(self._core)

    def __iter__(self):
        return self

    def __next__(self):
        step = self.step()
        if step is None:
            raise StopIteration
        return step

    def step(self):
        """Takes one step. None where there is none left, and the run is finished then."""
        if self._core.finished:
            return None
        if not self._core.step():
            self.finish()
            return None
        self._progress.show(self._core.steps, self._core.steps_asked, self._core.time)
        return Step(self._core.values())

    def run(self):
        """All steps that are left; returns the results."""
        for _ in self:
            pass
        return self.results

    def finish(self):
        """Writes fields and checkpoint of the last step and how the run has ended; fields stay. Returns the results."""
        self._progress.end()
        self._core.finish()
        return self.results

    def checkpoint(self):
        """Writes a checkpoint and returns its path, which ``restart`` takes; the last two are kept."""
        return self._core.checkpoint()

    @property
    def results(self):
        """What is in the folder of the results: see tunica.open()."""
        return open_results(self._core.folder, unfinished=True)

    @property
    def finished(self):
        """Has the run ended, by finish() or by an error?"""
        return self._core.finished

    @property
    def steps(self):
        """Completed steps."""
        return self._core.steps

    @property
    def steps_asked(self):
        """Completed steps at the end at the latest."""
        return self._core.steps_asked

    @property
    def time(self):
        """Time [s]; load factor in statics."""
        return self._core.time

    @property
    def warnings(self):
        """Values of the case and shapes of the mesh that look like slips; on process 0."""
        return self._core.warnings

    # Fields: views of the solver's memory, read-only; they show the last step, whenever they were taken. Nodes of this
    # process come first (`owned_nodes`), then those that it shares with others.

    @property
    def velocity(self):
        """(n, 3) [m/s]."""
        return self._core.field("velocity")

    @property
    def pressure(self):
        """(n,) [Pa], at the instant of balance within the last step."""
        return self._core.field("pressure")

    @property
    def end_pressure(self):
        """(n,) [Pa], at the end of the last step."""
        return self._core.field("end_pressure")

    @property
    def displacement(self):
        """(n, 3) [m]; in the lumen that of the mesh."""
        return self._core.field("displacement")

    @property
    def acceleration(self):
        """(n, 3) [m/s^2], at nodes of the moving mesh."""
        return self._core.field("acceleration")

    @property
    def points(self):
        """(n, 3) [m]: the nodes of the initial mesh."""
        return self._core.points

    @property
    def original_ids(self):
        """(n,): the number of each node in the mesh as it was read, the same on any number of processes."""
        return self._core.original_ids

    @property
    def owned_nodes(self):
        """How many of the nodes belong to this process: they come first."""
        return self._core.owned_nodes

    @property
    def regions(self):
        """Names of the regions."""
        return self._core.regions

    def quantity(self, key, region=None):
        """A quantity of the last step, of those that ``output: {fields}`` of a case can name (tunica.quantities()), in SI
        units: (nodes,) or (nodes, components) at the nodes of this process, (elements,) or (elements, components) in the
        elements of a region of the wall; where it has a value for each family of fibres, a column for each. ``region``: a
        name, the first that has this quantity when left out. With several processes all call it.
        """
        if region is not None:
            return self._core.quantity(key, region)
        refused = None
        for name in self.regions:
            try:
                return self._core.quantity(key, name)
            except _core.InputError as error:
                refused = error
        raise refused

    def elements(self, region):
        """(m, 4): corners of the tetrahedra of a region that this process counts."""
        return self._core.elements(region)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if not self._core.finished:
            self.finish()

    def __repr__(self):
        state = "finished" if self.finished else "going on"
        return f"<simulation in {self._core.folder}: {self.steps} of {self.steps_asked} steps, {state}>"
