"""Holds the type stubs against the package (mypy, stubtest), and a small program against the stubs. 77: no mypy."""
import os
import pathlib
import subprocess
import sys
import tempfile

RIGHT = """
import numpy as np
import tunica
from tunica import materials
law = materials.hgo(shear_modulus="20 kPa", families=[{"k1": 1e3}])
stress = law.stress(np.eye(3), measure="cauchy")
simulation = tunica.Simulation(tunica.Case(time={"steps": 2}), inflow={"inlet": lambda t: 1e-6 * t})
for step in simulation:
    print(step.flow["inlet"] + float(simulation.velocity.max()), simulation.outlets["outlet"]["distal"])
print(tunica.Mesh({"tube": {}}).points.shape, tunica.prestress("case.yaml", "out").apply("case.yaml").yaml)
print(stress.shape, law.uniaxial(to=1.2).load.max(), tunica.open("results").fields("lumen").points)
"""
WRONG = """
from tunica import materials
materials.hgo(shear_modulus=1e3).stress([[1.0]], measure=3)
"""


def mypy(folder, text):
    (folder / "program.py").write_text(text)
    return subprocess.run([sys.executable, "-m", "mypy", "--strict", "--no-incremental", "program.py"], cwd=folder,
                          capture_output=True, text=True, env={**os.environ, "MYPYPATH": str(folder)})


def main():
    if subprocess.run([sys.executable, "-m", "mypy", "--version"], capture_output=True).returncode:
        print("skipped: mypy is not there")
        return 77
    package = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "tunica").symlink_to(package)
        right, wrong = mypy(folder, RIGHT), mypy(folder, WRONG)
        if right.returncode or not wrong.returncode:
            print(right.stdout, right.stderr, wrong.stdout, sep="\n")
            return 1
        (folder / "allowed").write_text(  # their metaclass is one of pybind11
            "tunica._core.Law\ntunica._solver.MeshData\ntunica._solver.MeshData.__init__\ntunica._solver.Simulation\n")
        test = subprocess.run([sys.executable, "-m", "mypy.stubtest", "tunica._core", "tunica.materials",
                               "tunica.results", "tunica._solver", "tunica.cases", "tunica.meshes", "tunica.simulation",
                               "tunica.stages", "--ignore-missing-stub", "--allowlist", "allowed"], cwd=folder, capture_output=True, text=True,
                              env={**os.environ, "MYPYPATH": str(folder)})
        print(test.stdout, test.stderr)
        return test.returncode


if __name__ == "__main__":
    sys.exit(main())
