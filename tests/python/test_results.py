"""Folders of results by Python: what a run of the program has left, whole, unfinished and damaged.

TUNICA_PROGRAM names the program.
"""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import numpy as np
import tunica

CASE = """\
title: Flow in a short tube
analysis: flow
elements: linear
meshes: {tube: {radius: 5 mm, length: 10 mm, cells_around: 8}}
fluid: {density: 1060 kg/m^3, viscosity: {newtonian: {viscosity: 4 mPa s}}}
boundary:
  lumen_inlet: {flow: 10 ml/s}
  lumen_outlet: {pressure: 0 Pa}
  lumen_wall: no_slip
time: {step: 1 ms, steps: 4}
output: {directory: results, every: 2, units: {pressure: Pa}}
"""


def run(folder, *, ranks=1, arguments=()):
    (folder / "case.yaml").write_text(CASE)
    command = [os.environ["TUNICA_PROGRAM"], "run", str(folder / "case.yaml"), *arguments]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-n", str(ranks)] + command
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return folder / "results"


@unittest.skipUnless("TUNICA_PROGRAM" in os.environ, "TUNICA_PROGRAM does not name the program")
class OfARun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        root = pathlib.Path(cls.folder.name)
        for name, ranks in (("one", 1), ("three", 3)):
            (root / name).mkdir()
            setattr(cls, name, run(root / name, ranks=ranks))

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def copy(self):
        target = pathlib.Path(tempfile.mkdtemp(dir=self.folder.name)) / "results"
        shutil.copytree(self.one, target)
        return target

    def expect(self, text, folder):
        with self.assertRaises(tunica.InputError) as caught:
            tunica.open(folder)
        self.assertIn(text, str(caught.exception))

    def test_histories(self):
        results = tunica.open(self.one)
        self.assertEqual(results.status, "completed")
        faces = results.history("faces")
        np.testing.assert_array_equal(faces["step"], [1, 2, 3, 4])
        np.testing.assert_allclose(faces["lumen_inlet flow [ml/s]"][1:], -10, rtol=1e-6)
        self.assertIn("steps", results.histories())
        with self.assertRaises(tunica.InputError):
            results.history("nothing")

    def test_frame(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("pandas is not there")
        frame = tunica.open(self.one).frame("faces")
        self.assertIsInstance(frame, pandas.DataFrame)
        self.assertEqual(len(frame), 4)

    def test_fields(self):
        results = tunica.open(self.one)
        np.testing.assert_allclose(results.times("lumen"), [0, 0.002, 0.004])
        last = results.fields("lumen")
        self.assertEqual(last["velocity [m s^-1]"].shape, (len(last.points), 3))
        self.assertIs(last["velocity"], last["velocity [m s^-1]"])
        self.assertEqual(last.cells.shape[1], 4)
        self.assertEqual(len(last.cells), results.manifest["mesh"]["elements"])
        self.assertGreater(last["pressure [Pa]"].max(), 0)
        with self.assertRaises(KeyError):
            last["nothing"]
        with self.assertRaises(tunica.InputError):
            results.fields("lumen", 3)

    def test_fields_of_three_ranks_are_those_of_one(self):
        one, three = (tunica.open(folder).fields("lumen") for folder in (self.one, self.three))
        self.assertEqual(len(one.points), len(three.points))
        for mine, other in ((one.points, three.points), (one.cells, three.cells), (one.node_ids, three.node_ids),
                            (one.element_ids, three.element_ids)):
            np.testing.assert_array_equal(mine, other)
        for name in ("velocity", "pressure", "wall shear stress [Pa]"):
            size = np.abs(one[name]).max()
            np.testing.assert_allclose(one[name], three[name], atol=2e-3 * size)

    def test_vtk(self):
        try:
            import vtkmodules.vtkCommonDataModel  # noqa: F401
        except ImportError:
            self.skipTest("vtk is not there")
        fields = tunica.open(self.one).fields("lumen")
        grid = fields.to_vtk()
        self.assertEqual(grid.GetNumberOfCells(), len(fields.cells))
        self.assertEqual(grid.GetPointData().GetArray("pressure [Pa]").GetNumberOfTuples(), len(fields.points))

    def test_vtk_reads_the_files(self):
        try:
            from vtkmodules.util.numpy_support import vtk_to_numpy
            from vtkmodules.vtkIOHDF import vtkHDFReader
        except ImportError:
            self.skipTest("vtk is not there")
        for folder in (self.one, self.three):
            fields = tunica.open(folder).fields("lumen")
            reader = vtkHDFReader()
            self.assertTrue(reader.CanReadFile(str(fields.file)))
            reader.SetFileName(str(fields.file))
            reader.Update()
            grid = reader.GetOutput()
            np.testing.assert_array_equal(vtk_to_numpy(grid.GetPoints().GetData()), fields.points)
            np.testing.assert_array_equal(vtk_to_numpy(grid.GetCells().GetConnectivityArray()), fields.cells.ravel())
            for name, values in fields.point_data.items():
                np.testing.assert_array_equal(vtk_to_numpy(grid.GetPointData().GetArray(name)), values)
            self.assertEqual(grid.GetPointData().GetNumberOfArrays(), len(fields.point_data))
            self.assertGreater(len(fields.point_data), 2)

    def test_unfinished(self):
        folder = self.copy()
        manifest = json.loads((folder / "manifest.json").read_text())
        manifest["runs"][-1].update(status="stopped", message="signal 15")
        (folder / "manifest.json").write_text(json.dumps(manifest))
        self.expect("not finished: stopped (signal 15)", folder)
        self.assertEqual(tunica.open(folder, unfinished=True).status, "stopped")

    def test_damaged(self):
        folder = self.copy()
        (folder / "lumen_000002.hdf").unlink()
        self.expect("lumen_000002.hdf", folder)
        folder = self.copy()
        (folder / "lumen_mesh.hdf").unlink()
        self.expect("lumen_mesh.hdf", folder)
        folder = self.copy()
        (folder / "manifest.json").write_text((folder / "manifest.json").read_text()[:100])
        self.expect("manifest.json", folder)
        folder = self.copy()
        (folder / "lumen.hdf.series").unlink()
        self.expect("lumen.hdf.series", folder)
        (folder / "lumen.pvd").write_text("<VTKFile/>")
        self.expect("lumen.pvd: is a series of an earlier version", folder)
        folder = self.copy()
        (folder / "faces.csv").write_text("step,time [s]\n1,abc\n")
        with self.assertRaises(tunica.InputError) as caught:
            tunica.open(folder).history("faces")
        self.assertIn("faces.csv", str(caught.exception))
        folder = self.copy()
        file = folder / "lumen_000004.hdf"
        file.write_bytes(file.read_bytes()[:2000])
        with self.assertRaises(tunica.InputError):
            tunica.open(folder).fields("lumen")

    def test_other_folders(self):
        with tempfile.TemporaryDirectory() as empty:
            self.expect("no results", empty)
            self.expect("is no folder", empty + "/none")

    def test_stages(self):
        with tempfile.TemporaryDirectory() as name:
            out = pathlib.Path(name)
            shutil.copytree(self.one, out / "run")
            (out / "post").mkdir()
            (out / "post" / "post.json").write_text(json.dumps({"tears": [1, 2]}))
            for stage in ("run", "post"):
                (out / stage / "stage.json").write_text(json.dumps({"stage": stage, "status": "done", "outputs": {}}))
            opened = tunica.open(out)
            self.assertEqual(opened.report["post"]["tears"], [1, 2])
            self.assertEqual(opened.run.regions, ["lumen"])
            (out / "post" / "stage.json").write_text(json.dumps({"stage": "post", "status": "failed", "outputs": {}}))
            self.expect("not finished: failed", out)
            (out / "post" / "stage.json").write_text(
                json.dumps({"stage": "post", "status": "done", "outputs": {"post.csv": 3}}))
            self.expect("post.csv", out)


if __name__ == "__main__":
    unittest.main()
