"""Meshes as numpy arrays: read, or made from parameters, surfaces or images; material axes in their walls."""

import json
import os
from pathlib import Path

from . import _core, _solver
from .cases import _text

__all__ = ["Mesh", "material_axes"]


class Mesh:
    """A mesh as a case names it: ``Mesh({"tube": {...}})``, or the path of a ``meshes.yaml``.

    Attributes, all read-only numpy arrays of the library's memory: ``points`` (n, 3) [m], ``elements`` (m, 4) corners of the
    tetrahedra, ``fields`` those of ``fields`` by name (m, components). ``regions``: {name: (kind, slice of the elements)},
    kind lumen or wall; ``faces``: names. ``section`` goes into a case: ``Case(meshes=mesh.section, ...)``; ``report`` has the
    numbers of a mesh that was made, None of others.
    """

    def __init__(self, source, *, fields=(), folder=None):
        self.report = None
        if isinstance(source, dict):
            self.section = source
            self._file = Path(folder or ".").resolve() / "meshes.yaml"
        else:
            self._file = Path(os.fspath(source)).resolve()
            try:
                text = self._file.read_text(encoding="utf-8")
            except (OSError, UnicodeDecodeError) as cause:
                raise _core.input_error(str(source), f"cannot be read ({cause})", "name a meshes.yaml") from cause
            tree = _solver.case_tree(text, str(self._file))
            self.section = _absolute(tree.get("meshes", tree), self._file.parent)
        self._data = _solver.read_mesh(_text(self.section), self._file, list(fields))
        self.points, self.elements, self.fields = self._data.points, self._data.elements, self._data.fields
        self.regions = {name: (kind, slice(first, end)) for name, kind, first, end in self._data.regions}
        self.faces = self._data.faces

    @classmethod
    def make(cls, output, *, overwrite=False, say=None, folder=None, **sections):
        """Makes a mesh as `tunica mesh` does and writes it into the folder ``output``.

        ``sections`` are those of the file of `tunica mesh`: ``parametric={...}, size="coarse"``, or surfaces, or an image.
        ``say``: a function that is told the state of the work, such as print; Ctrl-C ends it between two of these.
        """
        output = Path(os.fspath(output)).resolve()
        file = Path(folder or ".").resolve() / "mesh.yaml"
        _solver.make_mesh(_text({**sections, "output": str(output)}), file, output, overwrite, say)
        made = cls(output / "meshes.yaml")
        made.report = json.loads((output / "report.json").read_text(encoding="utf-8"))
        return made

    def face(self, name):
        """Triangles of a face (k, 3): points, counter-clockwise from outside."""
        return self._data.face(name)

    @property
    def notes(self):
        """What the reader has to say: sizes, quality, warnings."""
        return [*self._data.report, *self._data.warnings]

    def __repr__(self):
        return f"<mesh: {len(self.points)} points, {len(self.elements)} elements, regions {', '.join(self.regions)}>"


def material_axes(mesh, output, *, overwrite=False, comm=None, say=None, **settings):
    """Material directions in the wall of a mesh, as `tunica fibres` makes them; returns a Mesh with e1, e2, e3 in ``fields``.

    ``settings``: keys of the file of `tunica fibres`: inlet, regions, ... Writes into the folder ``output``. ``comm``: of
    mpi4py; collective. The case of a run on the result has ``wall: {fibre_frame: {mesh: {e1: e1, e2: e2}}}``.
    """
    output = Path(os.fspath(output)).resolve()
    text = _text({**settings, "meshes": mesh.section, "output": str(output)})
    _solver.make_axes(text, mesh._file.with_name("fibres.yaml"), output, overwrite, comm, say)
    made = Mesh(output / "meshes.yaml", fields=("e1", "e2", "e3"))
    made.report = json.loads((output / "report.json").read_text(encoding="utf-8"))
    return made


def _absolute(section, folder):
    """The same section with paths that do not depend on a folder."""
    if isinstance(section, dict):
        return {key: _absolute(value, folder) for key, value in section.items()}
    if isinstance(section, str) and (folder / section).exists():
        return str(folder / section)
    return section
