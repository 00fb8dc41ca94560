#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Modes and motion as VTK and meshio read them, beside the numbers in the files of the run and beside where a
rigid body would be; the motion as a table beside the same numbers.

Usage: motion_test.py FLEXNECK      (77: skipped, for want of h5py, meshio or VTK)
"""

import csv
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path

try:
    import h5py
    import meshio
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError as error:
    print(f"SKIPPED: {error}; install python3-h5py, python3-meshio and python3-vtk9")
    sys.exit(77)

COARSE = ["mesh.quadrant=2", "mesh.inner_ring=2", "mesh.outer_ring=1", "mesh.rubber_layers=1",
          "geometry.bolt_patch_radius=0.4 in", "cases=['flexion-60']", "test=[]", "pendulum.duration=0.08 s"]


def rotation(q):
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


class Motion(unittest.TestCase):
    @classmethod
    def flexneck(cls, *words, fine=(0,)):
        outcome = subprocess.run([sys.argv[1], *map(str, words)], cwd=cls.folder, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        assert outcome.returncode in fine, outcome.stdout
        return outcome.stdout

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="flexneck-motion-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        settings = [word for each in COARSE for word in ("--set", each)]
        for command in ("mesh", "modes", "pendulum"):
            cls.flexneck(command, "-q", "-o", "out", *(settings if command == "mesh" else []))
        cls.history = h5py.File(cls.folder / "out/pendulum-flexion-60.h5")
        cls.modes = h5py.File(cls.folder / "out/modes.h5")

    def test_modes(self):
        self.flexneck("export", "-o", "out", "--to", "modes.vtu")
        path = self.folder / "modes.vtu"
        read = meshio.read(path)
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        arrays = reader.GetOutput().GetPointData()
        names = list(self.modes["mode_names"].asstr()[:])
        self.assertEqual([arrays.GetArrayName(k) for k in range(arrays.GetNumberOfArrays())], names)
        np.testing.assert_array_equal(read.points, self.modes["nodes"][:])
        for k, name in enumerate(names):
            np.testing.assert_array_equal(read.point_data[name], self.modes["shapes"][k])
            np.testing.assert_array_equal(vtk_to_numpy(arrays.GetArray(name)), self.modes["shapes"][k])
        self.assertEqual(len(np.unique(np.concatenate(read.cell_data["part"]))), 9)

    def test_motion(self):
        self.flexneck("export", "out/pendulum-flexion-60.h5", "--to", "motion.pvd")
        frames = [(float(each.get("timestep")), each.get("file"))
                  for each in ElementTree.parse(self.folder / "motion.pvd").getroot().iter("DataSet")]
        times = list(self.history["time"][:])
        self.assertLessEqual(len(frames), 200)
        nodes = self.modes["nodes"][:]
        height = nodes[:, 2].max()
        fixed, top = nodes[:, 2] < 1e-9, nodes[:, 2] > height - 1e-9
        base, head = self.history["markers/neck.base"], self.history["markers/neck.top"]
        largest = 0
        for time, name in frames[:: len(frames) // 8]:
            read = meshio.read(self.folder / name)
            at = times.index(time)
            rigid = base["position"][at] + nodes @ rotation(base["rotation"][at]).T
            bent = read.point_data["deformation [m]"]
            np.testing.assert_allclose(read.points, rigid + bent, atol=1e-12)
            # The thick base plate hardly bends; the top plate moves with the body to which the head
            # is connected, except for its rotation, which shapes have as a tangent.
            self.assertLess(abs(bent[fixed]).max(), 1e-3)
            middle = nodes[top].mean(axis=0) - [0, 0, height]
            carried = head["position"][at] + rotation(head["rotation"][at]) @ middle
            np.testing.assert_allclose(read.points[top].mean(axis=0), carried, atol=5e-4)
            largest = max(largest, abs(bent).max())
        self.assertGreater(largest, 0.01)

    def test_table(self):
        self.flexneck("export", "out/pendulum-flexion-60.h5", "--to", "motion.csv")
        with open(self.folder / "motion.csv", newline="") as file:
            names, *rows = csv.reader(file)
        values = np.array(rows, dtype=float)
        self.assertEqual(names[0], "time [s]")
        self.assertTrue(all(name.endswith("]") for name in names))
        self.assertEqual(len(set(names)), len(names))
        np.testing.assert_array_equal(values[:, 0], self.history["time"][:])
        for k, axis in enumerate("xyz"):
            np.testing.assert_array_equal(values[:, names.index(f"neck.top position {axis} [m]")],
                                          self.history["markers/neck.top/position"][:, k])
        for joint in self.history["joints"]:
            np.testing.assert_array_equal(values[:, names.index(f"{joint} force z [N]")],
                                          self.history[f"joints/{joint}/force"][:, 2])

    def test_a_run_of_another_body_is_refused(self):
        self.flexneck("simulate", "four_bar", "-o", "out", "--set", "solver.end_time=1 ms")
        text = self.flexneck("export", "out/four_bar.h5", "--to", "bars.pvd", fine=(2,))
        self.assertIn("expected a run with a deformable body", text)
        self.assertFalse((self.folder / "bars").exists())
        text = self.flexneck("export", "out/four_bar.h5", "--to", "bars.vtu", fine=(2,))
        self.assertIn("expected the extension .mme, .pvd or .csv", text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
