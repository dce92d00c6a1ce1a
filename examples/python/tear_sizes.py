# How much pressure the blood needs at the inlet of an idealised dissection, over the size of its entry tear: a mesh and a
# short run for each size.
#
#   export PYTHONPATH=$PWD/build/release/python
#   /usr/bin/python3 examples/python/tear_sizes.py out/tear_sizes
#
# Areas [mm^2] and the number of steps may follow: ... out/tear_sizes 80,150,228 40

# %%
import pathlib
import sys

import tunica

given = [] if "ipykernel" in sys.modules else sys.argv[1:]  # a notebook has no command line
folder = pathlib.Path(given[0] if given else "out/tear_sizes")
areas = [float(a) for a in (given[1] if len(given) > 1 else "80,150,228").split(",")]
steps = int(given[2]) if len(given) > 2 else 40


# %% The case of a mesh: steady flow between rigid walls, the same resistance at every outlet
def case_on(mesh):
    boundary = {"lumen_inlet": {"flow": {"value": "90 ml/s", "ramp_time": "50 ms"}}, "lumen_wall": "no_slip"}
    for face in mesh.faces:
        if face.startswith("lumen_") and face not in boundary:
            boundary[face] = {"resistance": {"resistance": "5e8 Pa s/m^3"}}
    return tunica.Case(
        analysis="flow",
        elements="linear",
        meshes={key: mesh.section[key] for key in ("length_unit", "lumen")},
        fluid={},
        boundary=boundary,
        time={"step": "5 ms", "steps": steps, "rho_infinity": 0.0},
        output={"every": steps},
    )


# %% One after the other; a mesh that is there is read again
table = []
for area in areas:
    place = folder / f"{area:g}_mm2"
    if (place / "mesh" / "meshes.yaml").exists():
        mesh = tunica.Mesh(place / "mesh" / "meshes.yaml")
    else:
        parametric = {"flap": {"entry_tear": {"area": f"{area} mm^2"}}}
        mesh = tunica.Mesh.make(place / "mesh", geometry={"parametric": parametric}, size="coarse", say=print)
    for step in tunica.Simulation(case_on(mesh), directory=place / "run", overwrite=True):
        pass
    table.append((area, len(mesh.elements), step.pressure["lumen_inlet"] / 133.322, step.max_velocity))

# %%
print("entry tear [mm^2]  elements  pressure at the inlet [mmHg]  fastest [m/s]")
for area, elements, pressure, speed in table:
    print(f"{area:17g}  {elements:8d}  {pressure:28.2f}  {speed:13.3f}")
