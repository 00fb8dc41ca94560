#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Modal bodies as MBDyn, SID_FEM and Exudyn have them, read by readers that know nothing of ours: first a file that
another program made, then ours. What is read makes a pendulum swing, in an integrator of its own, as ours does.

Usage: exchange_test.py FLEXNECK MODES      (77: skipped, for want of h5py)
The environment variable FLEXNECK_SAMPLES names the folder of samples of other programs.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import h5py
    import numpy
except ImportError as error:
    print(f"SKIPPED: {error}; install python3-h5py")
    sys.exit(77)

import foreign_bodies
from pendulum import Pendulum

FLEXNECK, MODES = sys.argv[1], Path(sys.argv[2]).resolve()
SAMPLES = Path(os.environ.get("FLEXNECK_SAMPLES", "/nonexistent"))
AXIS, SPEED, GRAVITY, DAMPING, END = [1, 2, 2], 20.0, [0, 0, -9.81], 0.02, 0.1
USED = ["mode 1", "mode 2", "mode 3", "residual 1"]  # to 928 Hz
MODEL = f"""[solver]
end_time = "{END} s"
relative_tolerance = 1e-11
absolute_tolerance = 1e-14
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[output]
interval = "{END} s"
[[body]]
name = "ground"
kind = "ground"
[[body]]
name = "bar"
kind = "deformable"
modes_file = "FILE"
modes = {USED}
damping_ratio = {DAMPING}
correction_damping_ratio = {DAMPING}
[[marker]]
body = "ground"
name = "pivot"
position = ["0 m", "0 m", "0 m"]
[[joint]]
name = "pivot"
kind = "revolute"
lower = "ground.pivot"
upper = "bar.clamp"
axis = {AXIS}
rate = "{SPEED} rad/s"
[[channel]]
name = "angle"
quantity = "angle"
marker = "bar.clamp"
axis = {AXIS}
"""


class Exchange(unittest.TestCase):
    @classmethod
    def flexneck(cls, *words, expected=0):
        outcome = subprocess.run([FLEXNECK, *map(str, words)], cwd=cls.folder, text=True,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        assert outcome.returncode == expected, outcome.stdout
        return outcome.stdout

    @classmethod
    def swing(cls, modes):
        """Angle and modal coordinates at the end, by flexneck."""
        (cls.folder / "swing.toml").write_text(MODEL.replace("FILE", str(modes)))
        cls.flexneck("simulate", "-q", "swing.toml", "-o", "out")
        with h5py.File(cls.folder / "out/swing.h5") as history:
            return numpy.append(history["channels/angle/values"][-1], history["modal/bar/coordinates"][-1])

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="flexneck-exchange-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        for ending in ("fem", "SID_FEM", "hdf5"):
            told = cls.flexneck("export", MODES, "--to", "bar." + ending)
            assert "not carried over" in told and "geometric stiffness" in told, told
        cls.truth = cls.swing(MODES)
        with h5py.File(MODES) as file:
            cls.expected = {name: file["invariants/" + name][()] for name in file["invariants"]}
            cls.nodes = {name: (group["position"][()], group["translation"][()], group["rotation"][()])
                         for name, group in file["interfaces"].items()}
            cls.squares = (2 * numpy.pi * file["frequencies"][()])**2

    def check_terms(self, body):
        self.assertLess(abs(body.mass - self.expected["mass"][0]), 1e-15)
        for name in ("S1", "S2", "J0", "G0", "G", "N0", "N"):
            error = abs(getattr(body, name) - self.expected[name]).max()
            self.assertLess(error, 1e-13, name)
        self.assertLess(abs(body.M - numpy.eye(len(body.M))).max(), 1e-6)
        self.assertLess(abs(body.K / numpy.diag(self.squares).max() -
                            numpy.diag(self.squares / self.squares.max())).max(), 1e-14)

    def check_swing(self, body):
        pendulum = Pendulum(body, len(USED), "clamp", AXIS, GRAVITY, DAMPING)
        found = pendulum.run(SPEED, END, 200)
        # In kg^(1/2) m and rad; the largest coordinate is about 2e-3.
        error = abs(found - self.truth).max()
        print(f"{self.id().split('.')[-1]}: largest difference {error:.1e}, angle {found[0]:.9f}, a {found[1:]}")
        self.assertLess(error, 1e-8)

    def check_nodes(self, nodes):
        for name, node in self.nodes.items():
            for found, expected in zip(nodes[name], node):
                self.assertLess(abs(found - expected).max(), 1e-11 * (1 + abs(expected).max()))

    def test_mbdyn(self):
        body = foreign_bodies.mbdyn(self.folder / "bar.fem")
        self.check_terms(body)
        self.check_nodes(body.nodes)
        self.check_swing(body)

    def test_sid(self):
        body = foreign_bodies.sid(self.folder / "bar.SID_FEM")
        self.check_terms(body)
        self.check_nodes(body.nodes)
        self.check_swing(body)

    def test_exudyn(self):
        body = foreign_bodies.exudyn(self.folder / "bar.hdf5")
        with h5py.File(MODES) as file:
            self.assertTrue(numpy.array_equal(body.places[:-8], file["nodes"][()]))
            self.assertTrue(numpy.array_equal(body.shapes[:-8], file["shapes"][()].transpose(1, 2, 0)))
        names = sorted(self.nodes)
        body.nodes = {name: body.interface_of(len(body.places) - 8 + 4 * k) for k, name in enumerate(names)}
        self.check_terms(body)
        self.check_nodes(body.nodes)
        self.check_swing(body)

    def test_round_trip(self):
        for ending in ("fem", "SID_FEM"):
            self.flexneck("export", "bar." + ending, "--to", "again.h5")
            again = self.swing(self.folder / "again.h5")
            print(f"back from {ending}: {abs(again - self.truth).max():.1e}")
            self.assertLess(abs(again - self.truth).max(), 1e-11)

    def test_foreign_samples(self):
        if not (SAMPLES / "sid_fem").is_dir():
            self.skipTest("not read: FLEXNECK_SAMPLES names no folder with sid_fem/")
        bar = foreign_bodies.sid(SAMPLES / "sid_fem/balken1m.SID_FEM")
        _, _, blocks, nodes = foreign_bodies.sid_blocks(SAMPLES / "sid_fem/balken1m.SID_FEM")
        self.assertEqual([name for name, _ in nodes], ["6022", "6023", "6024"])
        self.assertAlmostEqual(bar.mass, 7.85 * 0.1, 9)
        self.assertAlmostEqual(bar.K[0, 0]**0.5 / (2 * numpy.pi), 8.36, 3)
        self.assertLess(abs(blocks["mdCM"][1][:, :, 0] - bar.S2).max(), 1e-12)
        self.assertLess(abs(blocks["J"][1][:3, 0, 0] - 2 * numpy.diag(bar.G0[0])).max(), 1e-12)
        # Rotations of the nodes: to first order those of their axes, with linear axes of the far
        # node.
        for _, node in nodes:
            turned = foreign_bodies.skew(node["psi"][0][:, 0])
            self.assertLess(abs(node["AP"][1][:, 0, :] - turned).max(), 1e-11)
        # Its centrifugal terms are those of lumped masses, its generalised mass is not: no body has
        # both.
        self.assertAlmostEqual(numpy.trace(bar.G[0, 0]) / 2, 1.173, 3)
        for name in ("balken1m", "beam"):
            told = self.flexneck("export", SAMPLES / f"sid_fem/{name}.SID_FEM", "--to", "sample.h5", expected=2)
            self.assertIn("differ by", told)
            self.assertFalse((self.folder / "sample.h5").exists())

    def test_refusals(self):
        told = self.flexneck("export", MODES, "--to", "bar.msh", expected=2)
        self.assertIn("expected one of the extensions", told)
        self.assertIn(".fem (modal body for MBDyn)", told)
        told = self.flexneck("export", MODES, "--to", "x.h5", expected=2)
        self.assertIn("expected a body in a .fem (MBDyn) or .SID_FEM file", told)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
