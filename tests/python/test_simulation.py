"""Cases and runs by Python, against the program and against each other. TUNICA_PROGRAM names the program."""
import gc
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

import numpy as np
import tunica

CASE = {
    "analysis": "flow",
    "elements": "linear",
    "meshes": {"tube": {"radius": "5 mm", "length": "2 cm", "cells_around": 8, "cells_radial": 1, "cells_along": 5}},
    "fluid": {"density": "1.06 g/cm^3", "viscosity": {"newtonian": {"viscosity": "4 mPa s"}}},
    "boundary": {
        "lumen_inlet": {"flow": {"value": "20 ml/s", "ramp_time": "10 ms"}},
        "lumen_outlet": {"rcr": {"proximal": "1e7 Pa s/m^3", "capacitance": "1e-9 m^3/Pa", "distal": "1e8 Pa s/m^3"}},
        "lumen_wall": "no_slip",
    },
    "time": {"step": "2 ms", "steps": 6},
    "newton": {"relative_tolerance": 1e-8},
    "output": {"every": 3, "units": {"pressure": "Pa", "flow": "ml/s"}, "points": {"middle": ["0 mm", "0 mm", "10 mm"]}},
}


def ramp(t):
    """The inflow of CASE [m^3/s]."""
    return 20e-6 * (0.5 * (1 - np.cos(np.pi * t / 10e-3)) if t < 10e-3 else 1.0)


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.case = tunica.Case(CASE, folder=self.folder)

    def simulation(self, name, case=None, **options):
        return tunica.Simulation(case or self.case, directory=self.folder / name, **options)

    def program(self, name, *arguments, case=None):
        file = (case or self.case).save(self.folder / f"{name}.yaml")
        subprocess.run([os.environ["TUNICA_PROGRAM"], "run", str(file), "--output", str(self.folder / name), *arguments],
                       check=True, stdout=subprocess.DEVNULL)
        return tunica.open(self.folder / name, unfinished=True)

    def expect_same(self, one, other, rtol=0.0):
        for name in ("faces", "outlets", "points"):
            a, b = one.history(name), other.history(name)
            self.assertEqual(a.keys(), b.keys())
            for column in a:
                np.testing.assert_allclose(a[column], b[column], rtol=rtol, atol=rtol * np.abs(a[column]).max(),
                                           err_msg=f"{name}: {column}")


class Cases(InAFolder):
    def test_round_trip(self):
        self.assertEqual(self.case.check(), [])
        self.assertEqual(tunica.Case.from_yaml(self.case.yaml, folder=self.folder), self.case)
        self.assertIn("# ", self.case.yaml)
        self.assertEqual(tunica.Case(self.case.save(self.folder / "saved.yaml")), self.case)
        self.assertEqual(tunica.Case(**CASE, folder=self.folder), self.case)
        self.assertEqual(tunica.Case(self.case.tree, folder=self.folder), self.case)

    def test_values(self):
        self.assertEqual(self.case["time.steps"], 6)
        self.assertIn("boundary.lumen_inlet.flow", self.case)
        self.assertNotIn("boundary.lumen_inlet.pressure", self.case)
        with self.assertRaises(KeyError):
            self.case["time.nothing"]
        changed = self.case.replace({"time.steps": np.int64(9), "output.points": None})
        self.assertEqual((changed["time.steps"], self.case["time.steps"]), (9, 6))
        self.assertNotEqual(changed, self.case)
        self.assertEqual(float(self.case.settings["time.step"]), 0.002)
        self.case["boundary"].clear()
        self.case.tree.clear()
        self.assertEqual(len(self.case["boundary"]), 3)

    def test_files_count_from_the_folder(self):
        (self.folder / "q.csv").write_text("t,q\n0,0\n1,1\n")
        flow = {"flow": {"table": {"file": "q.csv", "time_unit": "s", "unit": "ml/s", "periodic": False}}}
        case = self.case.replace({"boundary.lumen_inlet": flow})
        (self.folder / "below").mkdir()
        saved = tunica.Case(case.save(self.folder / "below" / "case.yaml"))
        self.assertEqual(saved["boundary.lumen_inlet.flow.table.file"], "../q.csv")
        saved.check()

    def test_what_is_wrong_is_told_at_once(self):
        wrong = self.case.replace({"time.step": "2 mm", "fluid.density": "-1 g/cm^3", "colour": "red"})
        with self.assertRaises(tunica.InputError) as caught:
            wrong.check()
        places = " ".join(where for where, _, _ in caught.exception.problems)
        for key in ("time.step", "fluid.density", "colour"):
            self.assertIn(key, places)
        with self.assertRaises(tunica.InputError):
            tunica.Case(self.folder / "none.yaml")
        with self.assertRaises(tunica.InputError):
            self.case.replace({"time.steps.more": 1})
        with self.assertRaisesRegex(tunica.InputError, "stage of its own"):
            self.simulation("results", tunica.Case(CASE, mesh={"parametric": {}}))


class Meshes(InAFolder):
    def test_a_tube(self):
        mesh = tunica.Mesh(CASE["meshes"])
        self.assertEqual((mesh.points.shape[1], mesh.elements.shape[1]), (3, 4))
        self.assertEqual(list(mesh.regions), ["lumen"])
        self.assertEqual(mesh.regions["lumen"], ("lumen", slice(0, len(mesh.elements))))
        corners = mesh.points[mesh.elements]
        volume = np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6
        section = np.pi * 5e-3**2  # the polygon has the area of the circle
        self.assertAlmostEqual(volume / (section * 2e-2), 1, places=9)
        inlet = mesh.points[mesh.face("lumen_inlet")]
        area = np.linalg.norm(np.cross(inlet[:, 1] - inlet[:, 0], inlet[:, 2] - inlet[:, 0]), axis=1).sum() / 2
        self.assertAlmostEqual(area / section, 1, places=9)
        with self.assertRaises(ValueError):
            mesh.points[0] = 0
        points = mesh.points
        del mesh
        gc.collect()
        self.assertTrue(np.isfinite(points).all())
        with self.assertRaises(tunica.InputError):
            tunica.Mesh({"tube": {"radius": "5 mm"}})


@unittest.skipUnless("TUNICA_PROGRAM" in os.environ, "TUNICA_PROGRAM does not name the program")
class Simulations(InAFolder):
    def test_same_as_the_program(self):
        times = []
        with self.simulation("python") as simulation:
            for step in simulation:
                times.append(step.time)
                self.assertEqual(step.number, len(times))
                self.assertLess(step.flow["lumen_inlet"], 0)
                self.assertEqual(step.pressure.keys(), step.area.keys())
                self.assertGreater(np.linalg.norm(step.points["middle"]["velocity"]), 0)
        np.testing.assert_allclose(times, 0.002 * np.arange(1, 7), rtol=1e-12)
        self.assertTrue(simulation.finished)
        self.assertIsNone(simulation.step())
        results, program = simulation.results, self.program("program")
        self.assertEqual(results.status, "completed")
        self.expect_same(results, program)
        one, other = results.fields("lumen"), program.fields("lumen")
        for name in one.keys():
            np.testing.assert_array_equal(one[name], other[name])

    def test_fields_are_views(self):
        simulation = self.simulation("results")
        velocity, pressure, nothing = simulation.velocity, simulation.pressure, simulation.displacement
        self.assertEqual(velocity.shape, (len(simulation.points), 3))
        self.assertEqual(simulation.owned_nodes, len(velocity))
        self.assertEqual(np.abs(velocity).max(), 0)
        simulation.step()
        first = velocity.copy()
        self.assertTrue(np.shares_memory(velocity, simulation.velocity))
        np.testing.assert_array_equal(velocity, simulation.velocity)
        self.assertGreater(np.abs(velocity).max(), 0)
        simulation.step()
        self.assertGreater(np.abs(velocity - first).max(), 0)
        np.testing.assert_array_equal(velocity, simulation.velocity)
        self.assertEqual(np.abs(nothing).max(), 0)
        with self.assertRaises(ValueError):
            velocity[0, 0] = 1
        self.assertEqual(simulation.elements("lumen").shape[1], 4)
        self.assertLess(simulation.elements("lumen").max(), len(velocity))
        gradient = simulation.quantity("velocity_gradient")
        self.assertEqual(gradient.shape, (len(velocity), 9))
        np.testing.assert_allclose(simulation.quantity("vorticity", "lumen")[:, 2], gradient[:, 3] - gradient[:, 1])
        for key, region in (("vortex", None), ("jacobian", None), ("vorticity", "wall")):
            with self.assertRaises(tunica.InputError):
                simulation.quantity(key, region)
        with self.assertRaises(tunica.InputError):
            simulation.elements("wall")
        results = simulation.finish()
        self.assertEqual(results.status, "stopped")
        stored = results.fields("lumen")["velocity"]
        np.testing.assert_allclose(np.sort(np.linalg.norm(stored, axis=1)), np.sort(np.linalg.norm(velocity, axis=1)),
                                   rtol=1e-5, atol=1e-7)
        del simulation
        gc.collect()
        np.testing.assert_array_equal(np.isfinite(velocity), True)

    def test_own_inflow(self):
        asked = []

        def inflow(t):
            asked.append(t)
            return ramp(t)

        case = self.case.replace({"boundary.lumen_inlet.flow": "0 ml/s"})
        results = self.simulation("own", case, inflow={"lumen_inlet": inflow}).run()
        self.expect_same(results, self.program("program"), rtol=1e-9)
        self.assertAlmostEqual(max(asked), 0.012, places=12)
        # A table whose straight lines are met at the ends of steps.
        times = np.linspace(0, 0.012, 7)
        values = 1e-6 * np.array([0, 3, 11, 20, 18, 9, 4.0])
        rows = "".join(f"{t:.17g},{1e6 * q:.17g}\n" for t, q in zip(times, values))
        (self.folder / "q.csv").write_text("t,q\n" + rows)
        table = {"flow": {"table": {"file": "q.csv", "time_unit": "s", "unit": "ml/s", "periodic": False}}}
        by_table = self.program("table", case=self.case.replace({"boundary.lumen_inlet": table}))
        by_function = self.simulation("function", case, inflow={"lumen_inlet": lambda t: np.interp(t, times, values)}).run()
        self.expect_same(by_function, by_table, rtol=1e-9)

    def test_inflows_that_go_wrong(self):
        case = self.case.replace({"boundary.lumen_inlet.flow": "0 ml/s"})
        with self.assertRaisesRegex(tunica.InputError, "no condition `flow`"):
            self.simulation("none", case, inflow={"lumen_outlet": ramp})
        with self.assertRaisesRegex(ZeroDivisionError, "division"):
            self.simulation("raises", case, inflow={"lumen_inlet": lambda t: 1 / 0}).step()
        self.assertEqual(tunica.open(self.folder / "raises", unfinished=True).status, "failed")
        with self.assertRaisesRegex(tunica.InputError, "is nan at t"):
            self.simulation("nan", case, inflow={"lumen_inlet": lambda t: float("nan")}).step()
        simulation = self.simulation("text", case, inflow={"lumen_inlet": lambda t: "20 ml/s"})
        with self.assertRaises(TypeError):
            simulation.step()
        self.assertIsNone(simulation.step())

    def test_outlets_between_steps(self):
        simulation = self.simulation("python")
        for step in simulation:
            if step.number == 3:
                self.assertAlmostEqual(simulation.outlets["lumen_outlet"]["distal"], 1e8)
                simulation.outlets["lumen_outlet"] = {"distal": 3e8, "proximal": "20e6 Pa s/m^3"}
                self.assertEqual(simulation.outlets["lumen_outlet"]["capacitance"], 1e-9)
        state = simulation.outlets.states["lumen_outlet"]
        self.assertAlmostEqual(state["pressure"] / (state["stored_pressure"] + 2e7 * state["flow"]), 1, places=12)
        # The same by a restart of the program with another case file.
        changed = self.case.replace({"boundary.lumen_outlet.rcr.distal": "3e8 Pa s/m^3",
                                     "boundary.lumen_outlet.rcr.proximal": "2e7 Pa s/m^3"})
        self.program("program", "--until", "3")
        self.expect_same(simulation.results, self.program("program", "--restart", case=changed))
        self.assertIn("outlet lumen_outlet", (self.folder / "python" / "run.log").read_text())
        other = self.simulation("other")
        with self.assertRaisesRegex(tunica.InputError, "is a Windkessel"):
            other._core.set_outlet("lumen_outlet", "resistance: {resistance: 1e8 Pa s/m^3}")
        with self.assertRaisesRegex(tunica.InputError, "name one of: lumen_outlet"):
            other.outlets["lumen_inlet"]
        with self.assertRaises(tunica.InputError):
            other.outlets["lumen_outlet"] = {"capacitance": -1.0}

    def test_checkpoint_and_restart(self):
        first = self.simulation("results")
        first.step(), first.step()
        file = first.checkpoint()
        self.assertTrue(file.is_file())
        del first
        gc.collect()
        with self.assertRaises(tunica.InputError):
            self.simulation("results")
        again = self.simulation("results", restart=True)
        self.assertEqual((again.steps, again.steps_asked), (2, 6))
        self.expect_same(again.run(), self.program("program"))
        with self.assertRaises(tunica.InputError):
            self.simulation("results", restart=True, overwrite=True)
        self.assertEqual(self.simulation("results", overwrite=True, until=1).run().status, "completed")

    def test_ctrl_c_loses_nothing(self):
        case = self.case.replace({"time.steps": 400, "output.every": 1000})
        simulation = self.simulation("python", case)
        threading.Timer(0.1, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            for _ in simulation:
                pass
        self.assertFalse(simulation.finished)
        done = simulation.steps
        self.assertLess(done, 400)
        self.assertEqual(simulation.run().status, "completed")
        # To the digits of the tables but the last: over many steps a process with another memory rounds otherwise.
        self.expect_same(simulation.results, self.program("program", case=case), rtol=1e-7)

    def test_several_at_a_time(self):
        one, other = self.simulation("one"), self.simulation("other")
        while one.step():
            other.step()
        self.expect_same(one.results, other.finish())


PARALLEL = """
import os, sys
from mpi4py import MPI
os.environ["PETSC_OPTIONS"] = "-ksp_view_nothing"
import tunica
world = MPI.COMM_WORLD
case = tunica.Case(sys.argv[1])
own = lambda t: 1e-3 * t
simulation = tunica.Simulation(case, directory=sys.argv[2], comm=world, inflow={"lumen_inlet": own})
for step in simulation: pass
owned = world.allreduce(simulation.owned_nodes)
alone = tunica.Simulation(case, directory=sys.argv[2] + f"_{world.rank}", comm=MPI.COMM_SELF)
alone.run()
assert owned == alone.owned_nodes, (owned, alone.owned_nodes)
def fails(t): raise ValueError("of my own")
try:
    tunica.Simulation(case, directory=sys.argv[2] + "_fails", comm=world, inflow={"lumen_inlet": fails}).step()
except Exception as error:
    assert isinstance(error, ValueError if world.rank == 0 else RuntimeError), error
    assert "of my own" in str(error)
assert os.environ["PETSC_OPTIONS"] == "-ksp_view_nothing"
assert world.allreduce(1) == world.size
if world.rank == 0: print("fine")
"""


@unittest.skipUnless("TUNICA_PROGRAM" in os.environ, "TUNICA_PROGRAM does not name the program")
class InParallel(InAFolder):
    def test_beside_mpi4py(self):
        if subprocess.run([sys.executable, "-c", "import mpi4py"], capture_output=True).returncode:
            self.skipTest("mpi4py is not there")
        file = self.case.save(self.folder / "case.yaml")
        script = self.folder / "script.py"
        script.write_text(PARALLEL)
        found = {}
        for ranks in (1, 2):
            folder = self.folder / str(ranks)
            command = ["mpirun", "--oversubscribe", "-n", str(ranks), sys.executable, str(script), str(file), str(folder)]
            done = subprocess.run(command, capture_output=True, text=True, timeout=250)
            self.assertEqual((done.stdout.strip(), done.returncode), ("fine", 0), done.stderr)
            found[ranks] = tunica.open(folder)
        self.expect_same(found[1], found[2], rtol=1e-5)

    def test_handlers_and_exit(self):
        text = f"""
import signal, sys
before = [signal.getsignal(n) for n in (signal.SIGINT, signal.SIGTERM, signal.SIGSEGV)]
import tunica
s = tunica.Simulation({str(self.case.save(self.folder / 'case.yaml'))!r}, directory={str(self.folder / 'r')!r})
s.step()
assert before == [signal.getsignal(n) for n in (signal.SIGINT, signal.SIGTERM, signal.SIGSEGV)]
view = s.velocity
print("fine")
"""
        done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, timeout=100)
        self.assertEqual((done.stdout, done.stderr, done.returncode), ("fine\n", "", 0))


class Patient(InAFolder):
    """Images of a computed beat, made by the program and read by Python."""

    def test_flow_and_areas_of_a_tube(self):
        case = self.folder / "case.yaml"
        tunica.Case({**CASE, "output": {"every": 1, "directory": str(self.folder / "run")}}).save(case)
        program = [os.environ["TUNICA_PROGRAM"]]
        subprocess.run([*program, "run", case], check=True, capture_output=True)
        for kind, text in (("--flow", "scan: {voxel: 1 mm, frames: 4, signal_to_noise: 50}"),
                           ("--motion", "phases: 3\nscan: {voxel: 0.7 mm}")):
            scan = self.folder / "scan.yaml"
            scan.write_text(f"case: case.yaml\nperiod: 10 ms\n{text}\noutput: images{kind}\n")
            subprocess.run([*program, "synthesise", kind, scan], check=True, capture_output=True)
        file = self.folder / "flow.yaml"
        file.write_text("case: case.yaml\nvelocity: {x: images--flow/velocity_x.nii.gz, y: images--flow/velocity_y.nii.gz,"
                        " z: images--flow/velocity_z.nii.gz, unit: m/s, axes: image, period: 10 ms}\n"
                        "planes: {middle: {centre: [0 mm, 0 mm, 10 mm], normal: [0, 0, 1]}}\n")
        flow = tunica.measure(file, self.folder / "flow")
        self.assertEqual(len(flow.curves["middle [ml/s]"]), 4)
        self.assertAlmostEqual(flow.curves["middle [ml/s]"][-1] / (1e6 * ramp(9.5e-3)), 1, delta=0.15)
        file = self.folder / "motion.yaml"
        file.write_text("case: case.yaml\nphases: {labels: images--motion/labels_*.nrrd, period: 10 ms}\n"
                        "planes: {middle: {centre: [0 mm, 0 mm, 10 mm], normal: [0, 0, 1]}}\n")
        motion = tunica.motion(file, self.folder / "motion")
        areas = motion.curves["middle [mm^2]"]
        self.assertEqual(len(areas), 3)
        np.testing.assert_allclose(areas, areas[0], rtol=0.02)
        self.assertEqual(len(motion.report["phases"]), 3)
        with self.assertRaisesRegex(tunica.InputError, "overwrite"):
            tunica.motion(file, self.folder / "motion")

    def test_what_is_wrong_is_told_as_by_the_program(self):
        for call in (tunica.measure, tunica.motion, tunica.follow_up, tunica.identify, tunica.what_if):
            with self.assertRaises(tunica.InputError):
                call(self.folder / "none.yaml", self.folder / "out")


if __name__ == "__main__":
    unittest.main()
