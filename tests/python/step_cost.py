"""What a step costs more from Python than in `tunica run`: time of the processor, the same case by both, in turn.

TUNICA_PROGRAM names the program. Arguments: cells around the tube, steps.
"""
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import tunica


def case(cells, steps):
    return tunica.Case(
        analysis="flow", elements="linear", meshes={"tube": {"radius": "1 cm", "length": "6 cm", "cells_around": cells}},
        fluid={}, boundary={"lumen_inlet": {"flow": "0 ml/s"}, "lumen_wall": "no_slip",
                            "lumen_outlet": {"resistance": {"resistance": "1e8 Pa s/m^3"}}},
        time={"step": "2 ms", "steps": steps}, output={"every": 1000, "checkpoint_every": 1000})


def by_table(given, folder):
    (folder / "q.csv").write_text("t,q\n0,0\n1,500\n")
    table = {"file": "q.csv", "time_unit": "s", "unit": "ml/s", "periodic": False}
    return given.replace({"boundary.lumen_inlet.flow": {"table": table}})


def processor():
    return sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])


def program(file, folder, steps):
    before = processor()
    subprocess.run([os.environ["TUNICA_PROGRAM"], "run", str(file), "--output", str(folder), "--overwrite", "--until",
                    str(steps)], check=True, stdout=subprocess.DEVNULL)
    return processor() - before


def python(given, folder):
    """Seconds of a step after the first one, and the share of them that is spent outside of the library's step()."""
    simulation = tunica.Simulation(given, directory=folder, overwrite=True, inflow={"lumen_inlet": lambda t: 500e-6 * t})
    velocity = simulation.velocity
    simulation.step()
    core, inside = simulation._core.step, [0.0]

    class Timed:
        def __getattr__(self, name):
            return getattr(simulation_core, name)

        def step(self):
            start = time.process_time()
            done = core()
            inside[0] += time.process_time() - start
            return done

    simulation_core, simulation._core = simulation._core, Timed()
    start, first = time.process_time(), simulation.steps
    for step in simulation:
        assert velocity[0, 0] == velocity[0, 0] and step.flow
        if simulation.steps == simulation.steps_asked:
            break
    taken = time.process_time() - start
    return taken / (simulation.steps - first), 1 - inside[0] / taken


def main(cells=32, steps=21, repetitions=3):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        given = case(cells, steps)
        file = by_table(tunica.Case(given, folder=folder), folder).save(folder / "case.yaml")
        best = [float("inf")] * 2
        for _ in range(repetitions):
            own, outside = python(given, folder / "python")
            whole, begin = program(file, folder / "program", steps), program(file, folder / "program", 1)
            best = [min(best[0], own), min(best[1], (whole - begin) / (steps - 1))]
            print(f"python {own:.4f} s a step, {100 * outside:.3f} % of it outside of the library; program "
                  f"{(whole - begin) / (steps - 1):.4f} s")
        print(f"least of each: {best[0]:.4f} and {best[1]:.4f} s: {100 * (best[0] / best[1] - 1):+.2f} %")


if __name__ == "__main__":
    main(*(int(a) for a in sys.argv[1:]))
