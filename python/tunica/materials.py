"""Wall laws at material points.

Every law of the case file is a function here, with its keys as parameters:

>>> import numpy as np
>>> from tunica import materials
>>> wall = materials.neo_hooke(young_modulus="1 MPa", poisson_ratio=0.45)
>>> F = np.diag([1.1, 1.0, 1.0])
>>> wall.stress(F).shape
(3, 3)
>>> wall.tangent(np.stack([np.eye(3), F])).shape
(2, 6, 6)

A value is what the case file takes, such as ``"20 kPa"`` or ``"35 deg"``; a plain number is in the SI unit. Families
of fibres are lists of dictionaries. ``help(materials.hgo)`` tells the keys of a law, their units and their ranges.

Tensors refer to the fibre frame: axis 0 circumferential, 1 longitudinal, 2 radial. Everything that comes back is in SI
units: stresses and tangents in Pa, energies in J/m^3.
"""

import inspect
import json

import numpy as np

from . import _core

__all__ = ["Material", "Test", "from_yaml", "laws"]

_MEASURES = ("cauchy", "first_piola_kirchhoff", "second_piola_kirchhoff")


class Test:
    """What a test of a specimen gives: one entry for each load.

    Attributes, all numpy arrays of n points: ``load`` (n,) stretch or amount of shear, ``F`` (n, 3, 3), ``J`` (n,),
    ``energy`` (n,) [J/m^3], ``pressure`` (n,) [Pa], positive in compression, ``cauchy``, ``first_piola_kirchhoff`` and
    ``second_piola_kirchhoff`` (n, 3, 3) [Pa], ``tangent`` (n, 6, 6) [Pa] in the order 11 22 33 12 23 13. ``stress()``
    gives the component that a testing machine reads.
    """

    def __init__(self, load, values):
        self.load = load
        self._along, self._across = values.pop("along"), values.pop("across")
        for name, value in values.items():
            setattr(self, name, value)

    def stress(self, measure="cauchy", across=False):
        """Stress [Pa] (n,) along the loading axis, or in shear; ``across``: along the second axis."""
        return (self._across if across else self._along)[:, _choice(measure, "measure", _MEASURES)]

    def __len__(self):
        return len(self.load)

    def __repr__(self):
        return f"<{len(self)} points of a test, load {self.load[0]:.6g} to {self.load[-1]:.6g}>"


class Material:
    """A wall law with its volumetric part; made by the functions of this module.

    Methods take one deformation gradient (3, 3) or many (..., 3, 3), rows are the axes of the deformed body, columns
    those of the fibre frame, and compute them in packs, as the solver does. Memory for results can be given as
    ``out``: of the right shape, C-contiguous, float64. A gradient with det F <= 0 raises InputError.

    An incompressible law has no bulk modulus: its pressure [Pa], positive in compression, is given as ``pressure``, a
    number or an array (...), and is 0 when left out. Its gradients must have det F = 1 to 1e-3.
    """

    def __init__(self, yaml):
        self._yaml = yaml
        self._law = _core.Law(yaml)

    @property
    def yaml(self):
        """The text that a case file would have in its section ``wall`` (YAML)."""
        return self._yaml

    @property
    def incompressible(self):
        """Is the volume kept whatever the pressure?"""
        return self._law.incompressible

    @property
    def bulk_modulus(self):
        """K [Pa], infinite when incompressible."""
        return self._law.bulk_modulus

    @property
    def shear_modulus(self):
        """At rest [Pa]: the modulus that scales the stabilisation of the mixed element."""
        return self._law.shear_modulus

    @property
    def fibre_directions(self):
        """Mean directions of the families of fibres (families, 3), unit vectors in the fibre frame."""
        return self._law.fibre_directions

    @property
    def notes(self):
        """What a log says of the law: the rule of its fibre directions and its error."""
        return self._law.notes

    @property
    def warnings(self):
        """Values that look like slips."""
        return self._law.warnings

    def energy(self, F, out=None):
        """Strain energy (...) per reference volume [J/m^3], with its volumetric part."""
        return self._evaluate(F, None, energy=_new(out))["energy"]

    def stress(self, F, measure="cauchy", pressure=None, out=None):
        """Stress (..., 3, 3) [Pa]; ``measure``: cauchy, first_piola_kirchhoff (P = F S) or second_piola_kirchhoff (S)."""
        kind = _choice(measure, "measure", _MEASURES)
        if kind == 0:
            return self._evaluate(F, pressure, cauchy=_new(out))["cauchy"]
        if kind == 2:
            return self._evaluate(F, pressure, stress=_new(out))["stress"]
        return np.matmul(F, self._evaluate(F, pressure, stress=True)["stress"], out=out)

    def tangent(self, F, pressure=None, out=None):
        """Material tangent CC = 2 dS/dC (..., 6, 6) [Pa], tensor components in the order 11 22 33 12 23 13."""
        return self._evaluate(F, pressure, tangent=_new(out))["tangent"]

    def response(self, F, pressure=None, out=(None, None)):
        """Second Piola-Kirchhoff stress (..., 3, 3) and tangent (..., 6, 6) in one pass [Pa]."""
        both = self._evaluate(F, pressure, stress=_new(out[0]), tangent=_new(out[1]))
        return both["stress"], both["tangent"]

    def uniaxial(self, to=None, steps=20, along=(1, 0, 0), stretches=None):
        """Stretched along one axis; the other faces bear no traction.

        ``to``, ``steps``: stretches from 1 to ``to`` in equal steps; or ``stretches``, given one by one.
        """
        load = _path(1.0, to, steps, stretches, "stretches")
        return Test(load, self._law.pull(_vector(along), load))

    def biaxial(self, to=None, to_across=None, steps=20, along=(1, 0, 0), across=(0, 1, 0), stretches=None):
        """Stretched along two axes, without shear between them; the third face bears no traction.

        ``to``, ``to_across``: last stretches, reached from 1 in equal steps (``to_across`` left out: the same as ``to``);
        or ``stretches`` (n, 2).
        """
        if stretches is None:
            first = _path(1.0, to, steps, None, "stretches")
            second = _path(1.0, to if to_across is None else to_across, steps, None, "stretches")
        else:
            both = np.asarray(stretches, dtype=float)
            if both.ndim != 2 or both.shape[1] != 2:
                raise _error("stretches", f"has the shape {both.shape}", "give an array (n, 2)")
            first, second = both[:, 0].copy(), both[:, 1].copy()
        return Test(first, self._law.pull_both(_vector(along), _vector(across), first, second))

    def simple_shear(self, to=None, steps=20, along=(1, 0, 0), across=(0, 1, 0), shears=None):
        """F = I + shear along (x) across, wholly prescribed; an incompressible law has no normal traction on the third
        face."""
        load = _path(0.0, to, steps, shears, "shears")
        return Test(load, self._law.shear(_vector(along), _vector(across), load))

    def _evaluate(self, F, pressure, **wanted):
        given = np.asarray(F, dtype=float)
        if given.ndim < 2 or given.shape[-2:] != (3, 3):
            raise _error("F", f"has the shape {given.shape}", "give one gradient (3, 3) or many (..., 3, 3)")
        shape = given.shape[:-2]
        tails = {"energy": (), "stress": (3, 3), "cauchy": (3, 3), "tangent": (6, 6)}
        results = {}
        for name, out in wanted.items():
            expected = shape + tails[name]
            if out is True:
                out = np.empty(expected)
            elif out.shape != expected or out.dtype != np.float64 or not out.flags.c_contiguous:
                raise _error("out", f"has the shape {out.shape} and the type {out.dtype}",
                             f"give a C-contiguous array of float64 of the shape {expected}")
            results[name] = out
        if pressure is not None:
            pressure = np.ascontiguousarray(np.broadcast_to(np.asarray(pressure, dtype=float), shape))
        arguments = {name: results.get(name) for name in tails}
        self._law.evaluate(np.ascontiguousarray(given), pressure, **arguments)
        return results

    def __repr__(self):
        return f"<{next(iter(json.loads(self._yaml)['material']))}, shear modulus {self.shear_modulus:.6g} Pa>"


def from_yaml(text):
    """The material of a section ``wall`` of a case file, or a section ``material`` alone (YAML text)."""
    return Material(text)


def laws():
    """Description of every law by its name, from the schema of the case file: help, keys, units, ranges."""
    section = next(key for key in _core.describe_laws()["keys"] if key["key"] == "material")["section"]
    return {key["key"]: key for key in section["keys"]}


def _error(where, what, remedy):
    return _core.input_error(str(where), what, remedy)


def _new(out):
    return True if out is None else out


def _choice(value, name, allowed):
    if value not in allowed:
        raise _error(name, f"is {value!r}", "choose one of " + ", ".join(allowed))
    return allowed.index(value)


def _vector(direction):
    named = {"e1": (1.0, 0.0, 0.0), "e2": (0.0, 1.0, 0.0), "e3": (0.0, 0.0, 1.0)}
    vector = np.asarray(named.get(direction, (0.0, 0.0)) if isinstance(direction, str) else direction, dtype=float)
    if vector.shape != (3,) or not np.linalg.norm(vector) > 0:
        raise _error("along", f"is {direction!r}", "give e1, e2, e3 or three components that are not all zero")
    return vector


def _path(start, to, steps, values, name):
    if (to is None) == (values is None):
        raise _error(name, "and `to` are both left out" if to is None else "and `to` are both given", "give one of them")
    if to is not None:
        return np.linspace(start, to, int(steps) + 1)
    path = np.array(values, dtype=float)
    if path.ndim != 1 or len(path) == 0:
        raise _error(name, f"has the shape {path.shape}", "give a list of numbers")
    return path


def _in_units(value, key):
    """Plain numbers are SI values: they get the unit that the case file wants."""
    if isinstance(value, (np.floating, np.integer)):
        value = value.item()
    if key["kind"] == "quantity" and key["unit"] and isinstance(value, (int, float)) and not isinstance(value, bool):
        return f"{value!r} {key['unit']}"
    if key["kind"] == "quantities" and not isinstance(value, str):
        return [_in_units(entry, {**key, "kind": "quantity"}) for entry in value]
    if key["kind"] == "section" and isinstance(value, dict):
        return _section(value, key["section"])
    if key["kind"] == "list" and not isinstance(value, (str, dict)):
        return [_section(entry, key["section"]) if isinstance(entry, dict) else entry for entry in value]
    return value


def _section(values, description):
    keys = {key["key"]: key for key in description["keys"]}
    return {name: _in_units(value, keys[name]) if name in keys else value for name, value in values.items()}


def _allowed(key):
    if key["names"]:
        return "one of " + ", ".join(key["names"])
    return key["allowed"]


def _key_lines(description, indent):
    lines = []
    for key in description["keys"]:
        unit = key.get("unit")
        head = f"{indent}{key['key']}" + (f" [{unit}]" if unit else "")
        about = [key["help"].rstrip(".") + "."]
        if _allowed(key):
            about.append(f"Allowed: {_allowed(key)}.")
        if key["default"] is not None:
            about.append(f"Default: {key['default']}.")
        elif not key["required"]:
            about.append("May be left out.")
        lines.append(f"{head}: {' '.join(about)}")
        if "section" in key:
            if key["section"]["one_of"]:
                lines.append(f"{indent}    one of:")
            lines += _key_lines(key["section"], indent + "    ")
    return lines


def _document(key):
    text = [key["help"], ""]
    if "section" in key:
        text += ["Keys, with the SI unit that a plain number has:", ""] + _key_lines(key["section"], "    ")
    elif key["names"]:
        text.append("First argument: one of " + ", ".join(key["names"]) + ".")
    text += [
        "",
        "volumetric_energy: simo_taylor (default), quadratic or miehe.",
        "incompressible: True keeps the volume whatever the bulk modulus; when left out, the bulk modulus decides.",
    ]
    return "\n".join(text)


def _law_function(name, key):
    def law(*value, volumetric_energy=None, incompressible=None, **parameters):
        parameters = {k: given for k, given in parameters.items() if given is not None}
        if "section" in key:
            if value:
                raise _error(name, "has an argument without a name", "name the keys of the law: key=value")
            content = _section(parameters, key["section"])
        elif len(value) + ("value" in parameters) != 1 or set(parameters) - {"value"}:
            raise _error(name, "takes one value", f"give {_allowed(key) or 'the name of a file'}")
        else:
            content = str([*value, *parameters.values()][0])
        tree = {"material": {name: content}}
        if volumetric_energy is not None:
            tree["volumetric_energy"] = volumetric_energy
        if incompressible is not None:
            tree["incompressible"] = bool(incompressible)
        return Material(json.dumps(tree))

    law.__name__ = law.__qualname__ = name
    law.__doc__ = _document(key)
    kinds = inspect.Parameter
    if "section" in key:
        arguments = [kinds(k["key"], kinds.KEYWORD_ONLY, default=None) for k in key["section"]["keys"]]
    else:
        arguments = [kinds("value", kinds.POSITIONAL_OR_KEYWORD)]
    arguments += [kinds(n, kinds.KEYWORD_ONLY, default=None) for n in ("volumetric_energy", "incompressible")]
    law.__signature__ = inspect.Signature(arguments)
    return law


for _name, _key in laws().items():
    globals()[_name] = _law_function(_name, _key)
    __all__.append(_name)
