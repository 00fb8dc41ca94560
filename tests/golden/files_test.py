#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that the program once wrote stay readable: each is described, and what follows from it is what
followed then.

Usage: files_test.py FLEXNECK      (77: skipped, for want of h5py)
"""

import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

try:
    import quantities
except ImportError as error:
    print(f"SKIPPED: {error}; install python3-h5py")
    sys.exit(77)

FILES = Path(__file__).resolve().parent / "files"
FREQUENCIES_HZ = [70.46518917, 104.54391721, 661.63974471, 927.80758671, 1604.93026515,
                  2829.87020761, 2895.6879284, 5469.16524833, 33019.06842357]
SYSTEM_HZ = [35.57746266, 52.98686161]
TIP_M = 0.0005216140161572053  # the largest y of the tip
FOOT_NM = -22.357996798798375  # the least moment about z of the foot
# Exported files, and the rounding in m, N/m, kg below which their numbers are zero.
EXPORTS = {"bar.inp": 1e-12, "bar.msh": 1e-12, "bar.dat": 1e-12,
           "bar_K.mtx": 1e-6, "bar_M.mtx": 1e-12, "bar_nodes.mtx": 1e-12}

DESCRIPTIONS = {
    "mesh.h5": ["flexneck mesh", "32", "Node set clamp: 8 nodes", "Face set tip: 1 faces"],
    "modes.h5": ["flexneck modal body", "mode 1", "70.465", "residual 6", "mass 0.81 kg",
                 "no mode is missing below 798.98 Hz"],
    "swing.h5": ["flexneck history", "11 output times from 0 to 0.01 s", "35.577", "52.987", "0.00052161"],
    "static.json": ["Static neck tester", "flexion", "71.416", "2463.4"],
    "verification.json": ["bending 1", "35.915", "36.1", "effective damping"],
}
MATRICES = """
[matrices]
stiffness = "bar_K.{0}"
mass = "bar_M.{0}"
nodes = "bar_nodes.{0}"
[modes]
count = 3
"""
DECK = """
[geometry]
file = "{}"
[geometry.materials.aluminium]
youngs_modulus = "70 GPa"
poissons_ratio = 0.33
density = "2700 kg/m^3"
parts = ["bar"]
[modes]
count = 3
fixed = ["clamp"]
[[interface]]
name = "tip"
position = ["0.5 m", "0 m", "0 m"]
"""


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        # Paths that the files contain stay valid: the folder lies as deep as before.
        self.root = Path(folder.name)
        self.files = self.root / "tests/golden/files"
        shutil.copytree(FILES, self.files)
        shutil.copytree(FILES.parents[2] / "geometry/examples", self.root / "geometry/examples")
        self.stored = self.files / "stored"

    def flexneck(self, *words):
        done = subprocess.run([FLEXNECK, *words], check=False, capture_output=True, text=True,
                              cwd=self.files)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def assert_close(self, found, expected, tolerance=1e-9):
        self.assertEqual(len(found), len(expected))
        for one, other in zip(found, expected):
            self.assertLessEqual(abs(one - other), tolerance * abs(other))

    def test_each_is_described(self):
        for name, words in DESCRIPTIONS.items():
            with self.subTest(name):
                found = self.flexneck("info", self.stored / name)
                for word in words:
                    self.assertIn(word, found)

    def test_a_mesh_has_its_modes(self):
        (self.stored / "modes.h5").unlink()
        self.flexneck("modes", "bar.toml", "-q", "-o", self.stored)
        self.assert_close(quantities.frequencies(self.stored / "modes.h5"), FREQUENCIES_HZ)

    def test_modes_move(self):
        self.flexneck("simulate", "swing.toml", "-q", "-o", "out")
        history = self.files / "out/swing.h5"
        peaks = {name: numbers for name, _, numbers in quantities.peak_rows(history)}
        self.assert_close([peaks["tip: y"][2], peaks["load of the foot: z"][0]], [TIP_M, FOOT_NM],
                          1e-7)
        system = [numbers[0] for name, _, numbers in quantities.system_rows(history)]
        self.assert_close(system[:2], SYSTEM_HZ, 1e-7)

    def test_a_folder_is_gone_on_with(self):
        self.flexneck("run", "bar.toml", "-q", "-o", self.stored)
        self.assert_close(quantities.frequencies(self.stored / "modes.h5"), FREQUENCIES_HZ)

    def test_decks_and_matrices_have_the_same_modes(self):
        studies = {name: DECK.format(name) for name in ("bar.inp", "bar.msh", "bar_binary.msh")}
        studies |= {f"bar_K.{ending}": MATRICES.format(ending) for ending in ("mtx", "petsc")}
        for name, text in studies.items():
            with self.subTest(name):
                (self.stored / "study.toml").write_text(text)
                self.flexneck("run", self.stored / "study.toml", "-q", "-o", f"out/{name}")
                self.assert_close(quantities.frequencies(self.files / "out" / name / "modes.h5"),
                                  FREQUENCIES_HZ[:3])

    def assert_same_words(self, name, zero):
        words = lambda file: re.split(r"[\s,]+", file.read_text())
        for found, expected in zip(words(self.root / name), words(self.stored / name), strict=True):
            if found != expected:
                one, other = (float(word.replace("D", "e")) for word in (found, expected))
                self.assertAlmostEqual(one, other, delta=max(zero, 1e-9 * abs(other)))

    def test_a_mesh_and_modes_are_exported_as_they_were(self):
        for target in ("bar.inp", "bar.msh", "bar.dat", "bar.mtx"):
            self.flexneck("export", "bar.toml", "-q", "-o", self.stored, "--to", self.root / target)
        for name, zero in EXPORTS.items():
            with self.subTest(name):
                self.assert_same_words(name, zero)

    def test_bodies_for_other_programs_are_written_and_read_as_they_were(self):
        kept = [row[2] for row in quantities.invariant_rows(self.stored / "modes.h5")]
        for name in ("bar.fem", "bar.SID_FEM"):
            with self.subTest(name):
                self.flexneck("export", self.stored / "modes.h5", "-q", "--to", self.root / name)
                self.assert_same_words(name, 1e-15)
                self.flexneck("export", self.stored / name, "-q", "--to", self.root / "back.h5")
                self.assert_close(quantities.frequencies(self.root / "back.h5"), FREQUENCIES_HZ)
                again = [row[2] for row in quantities.invariant_rows(self.root / "back.h5")]
                for found, expected in zip(again, kept, strict=True):
                    for one, other in zip(found, expected, strict=True):
                        self.assertAlmostEqual(one, other, delta=1e-13)


if __name__ == "__main__":
    FLEXNECK = str(Path(sys.argv.pop(1)).resolve())
    unittest.main(verbosity=2)
