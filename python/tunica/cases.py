"""Cases: what a case file says, as a value.

>>> import tunica
>>> case = tunica.Case(
...     analysis="flow", elements="linear", meshes={"tube": {"radius": "5 mm", "length": "10 mm", "cells_around": 8}},
...     fluid={}, boundary={"lumen_inlet": {"flow": "10 ml/s"}, "lumen_outlet": {"pressure": "0 Pa"},
...                         "lumen_wall": "no_slip"},
...     time={"step": "1 ms", "steps": 4})
>>> case["time.steps"]
4
>>> case.replace({"time.steps": 8}).settings["time.steps"]
'8'
>>> tunica.Case.from_yaml(case.yaml) == case
True
"""

import copy
import json
import os
from pathlib import Path

from . import _core, _solver

__all__ = ["Case"]


def _plain(value):
    """numpy's numbers and arrays, and paths, as what YAML knows."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"{value!r} cannot stand in a case")


def _text(tree):
    return json.dumps(tree, default=_plain, ensure_ascii=False)


class Case:
    """A case: the path of a case file, a dict of its sections, or sections by name; names given replace those of the first.

    Values are what the case file takes: ``"20 kPa"``, ``4``, ``True``, dicts and lists. Files that they name count from the
    folder of the case file; of a case without one from ``folder``, the present one when left out.
    The case is looked at when it is used, or by check(). It does not change: replace() makes another.
    """

    def __init__(self, source=None, *, folder=None, **sections):
        self._file = Path(folder or ".").resolve() / "case.yaml"
        if source is None:
            tree = {}
        elif isinstance(source, Case):
            tree, self._file = source.tree, source._file if folder is None else self._file
        elif isinstance(source, dict):
            tree = source
        else:
            self._file = Path(os.fspath(source)).resolve()
            try:
                text = self._file.read_text(encoding="utf-8")
            except (OSError, UnicodeDecodeError) as cause:
                raise _core.input_error(str(source), f"cannot be read ({cause})", "name a case file") from cause
            tree = _solver.case_tree(text, str(self._file))
        if not isinstance(tree, dict):
            raise _core.input_error(str(source), "is no case: its top level has no keys", "name a case file")
        self._tree = json.loads(_text({**tree, **sections}))

    @classmethod
    def from_yaml(cls, text, folder=None):
        """The case of a text."""
        return cls(_solver.case_tree(text, "case.yaml") or {}, folder=folder)

    @property
    def tree(self):
        """All that the case says, as nested dicts: a copy."""
        return copy.deepcopy(self._tree)

    @property
    def file(self):
        """The file that the case is from, or would be in: paths in it count from its folder."""
        return self._file

    @property
    def yaml(self):
        """The text of a case file, each key with a comment on what it is."""
        return _solver.case_yaml(_text(self._tree), self._file, self._file.parent)

    def __getitem__(self, path):
        """What stands at a path of keys such as ``time.step``."""
        at = self._tree
        for key in path.split("."):
            if not isinstance(at, dict) or key not in at:
                raise KeyError(path)
            at = at[key]
        return copy.deepcopy(at)

    def __contains__(self, path):
        try:
            self[path]
        except KeyError:
            return False
        return True

    def replace(self, changes):
        """The same case with other values at paths of keys: ``{"time.step": "1 ms"}``; None removes what is there."""
        tree = self.tree
        for path, value in changes.items():
            *sections, last = path.split(".")
            at = tree
            for key in sections:
                at = at.setdefault(key, {})
                if not isinstance(at, dict):
                    raise _core.input_error(path, f"goes through {key}, which is a value", "replace that value")
            if value is None:
                at.pop(last, None)
            else:
                at[last] = value
        changed = Case(tree)
        changed._file = self._file
        return changed

    def check(self):
        """Looks at all values and files, but not at the mesh. Returns warnings; raises InputError with all that is wrong."""
        return _solver.check_case(self.yaml, self._file)["warnings"]

    @property
    def settings(self):
        """Every value by its path, in SI units and with defaults, as text; raises InputError as check()."""
        return _solver.check_case(self.yaml, self._file)["settings"]

    def save(self, path):
        """Writes a case file; files that it names count from its folder then. Returns its path."""
        path = Path(os.fspath(path)).resolve()
        path.write_text(_solver.case_yaml(_text(self._tree), self._file, path.parent), encoding="utf-8")
        return path

    def __eq__(self, other):
        """Do both settle every key alike?"""
        if not isinstance(other, Case):
            return NotImplemented
        return self.settings == other.settings

    __hash__ = None

    def __repr__(self):
        return f"<case {self._tree.get('title', '')!r}: {', '.join(self._tree)}>"


def as_case(case):
    """A Case of what stands for one."""
    return case if isinstance(case, Case) else Case(case)
