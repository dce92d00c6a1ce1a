# What a finished run has left: histories as arrays, fields as arrays and VTK data sets, the numbers of the report.
#
#   /usr/bin/python3 examples/python/finished_run.py out/own_inflow

# %%
import sys

import numpy as np
import tunica

given = [] if "ipykernel" in sys.modules else sys.argv[1:]  # a notebook has no command line
results = tunica.open(given[0] if given else "out/own_inflow")
run = results.run if isinstance(results, tunica.Pipeline) else results

# %% Histories
faces = run.history("faces")
for name, values in faces.items():
    if "pressure" in name:
        print(f"{name}: {np.nanmin(values):.2f} to {np.nanmax(values):.2f}")

# %% Fields of the last instant
region = run.regions[0]
last = run.fields(region, -1)
print(last)
speed = next(name for name in last.keys() if name.startswith("velocity"))
print(f"largest {speed}: {np.linalg.norm(last[speed], axis=1).max():.4g}")

# %% The same for VTK, where it is installed
try:
    print(last.to_vtk().GetNumberOfCells(), "cells")
except ImportError:
    print("the package vtk is not there")

# %% What a case with several stages has found
if isinstance(results, tunica.Pipeline):
    for stage, numbers in results.report.items():
        print(stage, sorted(numbers))
