"""What a finished run has left in its folder.

    results = tunica.open("out/dissection")         # of `tunica run case.yaml`, one stage or all
    flow = results.history("faces")["lumen_inlet flow [ml/s]"]
    lumen = results.fields("lumen", -1)             # the last instant
    lumen["pressure [mmHg]"].max()
"""

import json
import os
from pathlib import Path

import numpy as np

from . import _core

__all__ = ["Fields", "Pipeline", "Results", "open_results"]

_FINISHED = "completed"


def _error(where, what, remedy):
    return _core.input_error(str(where), what, remedy)


def _read_json(path, remedy):
    try:
        value = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as cause:
        raise _error(path, f"does not read ({cause})", remedy) from cause
    if not isinstance(value, dict):
        raise _error(path, "is no object of JSON", remedy)
    return value


class Fields:
    """The fields of one region at one instant, as the files have them: units stand in the names.

    ``points`` (n, 3) in the initial mesh, in the length unit of the output; ``point_data`` and ``cell_data``: arrays
    (n,) or (n, components) by name; ``cells``: nodes of each cell (cells, 4 or 10); ``node_ids``, ``element_ids``: their
    numbers in the mesh of the case, ascending; ``time`` [s]; ``file``. A field is found by its name with or without
    unit. All instants of a region share points, cells and numbers.
    """

    def __init__(self, time, file, mesh, point_data, cell_data):
        self.time = time
        self.file = file
        self.points, self.cells, self.node_ids, self.element_ids = mesh
        self.point_data = point_data
        self.cell_data = cell_data

    def __getitem__(self, name):
        for data in (self.point_data, self.cell_data):
            for key, values in data.items():
                if name in (key, key.split(" [")[0]):
                    return values
        raise KeyError(f"{name!r}; there are " + ", ".join(repr(n) for n in self.keys()))

    def keys(self):
        """Names of all fields."""
        return [*self.point_data, *self.cell_data]

    def to_vtk(self):
        """The same as a vtkUnstructuredGrid; needs the package vtk."""
        from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
        from vtkmodules.vtkCommonCore import vtkPoints
        from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkUnstructuredGrid

        grid, points, cells = vtkUnstructuredGrid(), vtkPoints(), vtkCellArray()
        points.SetData(numpy_to_vtk(self.points, deep=True))
        grid.SetPoints(points)
        offsets = np.arange(len(self.cells) + 1, dtype=np.int64) * self.cells.shape[1]
        cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                      numpy_to_vtkIdTypeArray(np.ascontiguousarray(self.cells.ravel(), dtype=np.int64), deep=True))
        grid.SetCells(24 if self.cells.shape[1] == 10 else 10, cells)  # VTK_QUADRATIC_TETRA, VTK_TETRA
        for data, target in ((self.point_data, grid.GetPointData()), (self.cell_data, grid.GetCellData())):
            for name, values in data.items():
                array = numpy_to_vtk(values, deep=True)
                array.SetName(name)
                target.AddArray(array)
        return grid

    def to_pyvista(self):
        """The same as a pyvista.UnstructuredGrid; needs the package pyvista."""
        import pyvista

        return pyvista.wrap(self.to_vtk())

    def __repr__(self):
        return f"<fields at {self.time:.6g} s: {len(self.points)} points, {len(self.cells)} cells, {self.keys()}>"


class Results:
    """The folder of a run of one case.

    ``path``, ``manifest`` (what was run with what), ``status`` (completed, stopped, failed, running), ``regions``.
    """

    def __init__(self, path, unfinished=False):
        self.path = Path(path)
        again = "run the case again with --overwrite"
        self.manifest = _read_json(self.path / "manifest.json", again)
        try:
            run = self.manifest["runs"][-1]
            self.status, message = run["status"], run["message"]
            self.regions = [region["name"] for region in self.manifest["mesh"]["regions"]]
        except (KeyError, IndexError, TypeError) as cause:
            raise _error(self.path / "manifest.json", "is not the manifest of a run", again) from cause
        if self.status != _FINISHED and not unfinished:
            raise _error(self.path, f"holds a run that is not finished: {self.status}" + (f" ({message})" * bool(message)),
                         "go on with it by `tunica run CASE --restart`, or open what there is with unfinished=True")
        self._series = {region: self._read_series(region) for region in self.regions}
        self._meshes = {}

    @property
    def case_text(self):
        """The case file of the run (YAML)."""
        return self.manifest["case"]["text"]

    def histories(self):
        """Names of the histories, for history()."""
        return sorted(path.stem for path in self.path.glob("*.csv"))

    def history(self, name):
        """A history as a dict of numpy arrays by the heading of the column, with its unit: "time [s]", ...

        Numbers that are not there are nan. Units are those of the output of the case.
        """
        if name not in self.histories():
            raise _error(self.path, f"has no history {name!r}", "there are " + ", ".join(self.histories()))
        remedy = "it is a history of the run: put it back, or run the case again with --overwrite"
        return _core.read_table(self.path / f"{name}.csv", remedy)

    def frame(self, name):
        """The same as a pandas.DataFrame; needs the package pandas."""
        import pandas

        return pandas.DataFrame(self.history(name))

    def times(self, region):
        """Instants [s] whose fields were written, ascending (n,)."""
        return np.array([time for time, _ in self._entries(region)])

    def fields(self, region, instant=-1):
        """The fields of a region at the instant of this number, see times(); negative ones count from the end."""
        entries = self._entries(region)
        try:
            time, file = entries[instant]
        except IndexError:
            raise _error(f"{region}.hdf.series", f"has {len(entries)} instants, number {instant} is none of them",
                         "see times()") from None
        if region not in self._meshes:
            self._meshes[region] = _core.read_mesh(self.path / f"{region}_mesh.hdf")
        mesh, file = self._meshes[region], self.path / file
        point_data, cell_data = _core.read_fields(file)
        for data, count in ((point_data, len(mesh[0])), (cell_data, len(mesh[1]))):
            for name, values in data.items():
                if len(values) != count:
                    raise _error(file, f"`{name}` is not of the size of the mesh",
                                 "put the file back, or run the case again with --overwrite")
        return Fields(time, file, mesh, point_data, cell_data)

    def _entries(self, region):
        if region not in self._series:
            raise _error(self.path, f"has no region {region!r}", "there are " + ", ".join(self.regions))
        return self._series[region]

    def _read_series(self, region):
        series, again = f"{region}.hdf.series", "put the file back, or run the case again with --overwrite"
        entries = _core.read_series(self.path / series)
        if not entries:
            raise _error(self.path / series, "is missing, or names no instant", again)
        for name in [f"{region}_mesh.hdf", *(file for _, file in entries)]:
            if not (self.path / name).is_file():
                raise _error(self.path / name, f"is missing, but {series} names it", again)
        return entries

    def __repr__(self):
        return f"<results in {self.path}: {self.status}, regions {', '.join(self.regions)}>"


class Pipeline:
    """The folder of a case with several stages: a folder for each of them.

    ``stages``: the record of each by its name (status, seconds, ranks, ...); ``report``: what each has found, by its
    name; ``run``: the Results of the run, None where the case was done only as far as an earlier stage.
    """

    _numbers = ("report.json", "prestress.json", "tuning.json", "post.json")

    def __init__(self, path, unfinished=False):
        self.path = Path(path)
        records = sorted(self.path.glob("*/stage.json"), key=lambda file: file.stat().st_mtime)
        again = "do the case again: tunica run CASE"
        self.stages = {file.parent.name: _read_json(file, again) for file in records}
        for name, record in self.stages.items():
            if record.get("status") != "done" and not unfinished:
                raise _error(self.path / name, f"holds a stage that is not finished: {record.get('status')}",
                             "go on by `tunica run CASE`, or open what there is with unfinished=True")
            lost = [file for file in record.get("outputs", {}) if not (self.path / name / file).is_file()]
            if lost:
                raise _error(self.path / name / lost[0], "is missing, but the record of its stage names it",
                             "put it back, or do the stage again: tunica run CASE")
        folder = self.path / "run"
        self.run = Results(folder, unfinished) if (folder / "manifest.json").exists() else None

    @property
    def report(self):
        """The numbers of all stages: {"mesh": {...}, "post": {...}, ...}, as docs/ describes their files."""
        found = {}
        for name in self.stages:
            for file in self._numbers:
                if (self.path / name / file).is_file():
                    found[name] = _read_json(self.path / name / file, "do the stage again: tunica run CASE")
        return found

    def __repr__(self):
        return f"<stages in {self.path}: {', '.join(self.stages)}>"


def open_results(folder, unfinished=False):
    """Opens the folder of results of `tunica run`: Results of a run, or a Pipeline of a case with several stages.

    A run that is not finished, a folder of something else and files that are missing or damaged raise InputError;
    with ``unfinished=True`` a run that was stopped, has failed or still goes on is opened as far as it is.
    """
    path = Path(os.fspath(folder))
    if not path.is_dir():
        raise _error(path, "is no folder", "name the folder that `tunica run` has written its results into")
    if (path / "manifest.json").exists():
        return Results(path, unfinished)
    if any(path.glob("*/stage.json")):
        return Pipeline(path, unfinished)
    raise _error(path, "holds no results of `tunica run`: neither manifest.json nor folders of stages",
                 "name the folder that `tunica run` has written its results into")
