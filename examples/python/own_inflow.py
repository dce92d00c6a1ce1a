# A tube with an inflow of one's own, a Windkessel that changes on the way, and fields looked at between the steps.
#
#   export PYTHONPATH=$PWD/build/release/python
#   /usr/bin/python3 examples/python/own_inflow.py out/own_inflow
#
# The cells (# %%) run one by one in editors that know them; examples/notebooks has the same for Jupyter.

# %% The case: what a case file says, as a dict of its sections
import sys

import numpy as np
import tunica

given = [] if "ipykernel" in sys.modules else sys.argv[1:]  # a notebook has no command line
folder = given[0] if given else "out/own_inflow"
steps = int(given[1]) if len(given) > 1 else 200

case = tunica.Case(
    title="A tube with an inflow of its own",
    analysis="flow",
    elements="linear",
    meshes={"tube": {"radius": "10 mm", "length": "40 mm", "cells_around": 16}},
    fluid={"density": "1060 kg/m^3", "viscosity": {"newtonian": {"viscosity": "4 mPa s"}}},
    boundary={
        "lumen_inlet": {"flow": "0 ml/s"},  # stands for the function below
        "lumen_outlet": {"rcr": {"proximal": "1e7 Pa s/m^3", "capacitance": "5e-9 m^3/Pa", "distal": "1.2e8 Pa s/m^3"}},
        "lumen_wall": "no_slip",
    },
    time={"step": "5 ms", "steps": steps},
    output={"every": 20},
)
for warning in case.check():
    print(warning)


# %% The inflow: a function of the time [s] that gives m^3/s, into the lumen; half a sine for a third of a second
def inflow(t):
    phase = t % 1.0
    return 400e-6 * np.sin(np.pi * phase / 0.33) if phase < 0.33 else 0.0


# %% The run: the files of `tunica run`, and between the steps whatever one likes
simulation = tunica.Simulation(case, directory=folder, inflow={"lumen_inlet": inflow}, overwrite=True)
speed = simulation.velocity  # a view: it shows the last step, whenever it was taken
pressures = []
for step in simulation:
    pressures.append(step.pressure["lumen_inlet"])
    if step.number % 20 == 0:
        largest = np.linalg.norm(speed, axis=1).max()
        print(f"t {step.time:.3f} s  inlet {step.pressure['lumen_inlet'] / 133.322:6.1f} mmHg  fastest {largest:.3f} m/s")
    if step.number == steps // 2:  # vessels downstream narrow
        simulation.outlets["lumen_outlet"] = {"distal": 1.5 * simulation.outlets["lumen_outlet"]["distal"]}

# %% What it has left
results = simulation.results
print(results.status, sorted(results.histories()), f"largest pressure {max(pressures) / 133.322:.1f} mmHg")
