# SPDX-License-Identifier: GPL-3.0-or-later
"""Windowing toolkits set the user's locale. One with a decimal comma, or with other letters, changes
no number and no file, whether it is set before the package is first used or after.

Usage: locale_test.py     (PYTHONPATH has the package)
"""

import filecmp
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

RUN = """
import locale, pathlib, sys
import flexneck as fn
name, when, folder = sys.argv[1:]
if when == "before":
    locale.setlocale(locale.LC_ALL, name)
assert fn.quantity("1.5 m", "mm") == 1500
if when == "after":
    locale.setlocale(locale.LC_ALL, name)
assert abs(fn.quantity("0.7 in", "m") - 0.01778) < 1e-15
study = fn.Study("hybrid3", ["mesh.quadrant=2", "mesh.inner_ring=2", "mesh.outer_ring=1",
                             "mesh.rubber_layers=1", "geometry.bolt_patch_radius=0.4 in",
                             "modes.count=6", "pendulum.duration=20 ms"])
study.mesh(folder).modes().pendulum("flexion-20")
"""
LOCALES = {"de_DE": "UTF-8", "fr_FR": "ISO-8859-1", "tr_TR": "UTF-8"}


class Locale(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name, characters in LOCALES.items():
            subprocess.run(["localedef", "-i", name, "-f", characters, self.folder / name],
                           check=False, capture_output=True)  # 1 for a mere warning
            self.assertTrue((self.folder / name / "LC_NUMERIC").exists(), name)

    def files(self, name, when):
        out = self.folder / f"{name}-{when}"
        environment = dict(os.environ, LOCPATH=str(self.folder), OMP_NUM_THREADS="1")
        subprocess.run([sys.executable, "-c", RUN, name, when, out], check=True, env=environment)
        return out

    def test_no_file_depends_on_the_locale(self):
        plain = self.files("C", "after")
        names = ["mesh.h5", "modes.h5", "pendulum-flexion-20.h5", "pendulum-flexion-20.csv",
                 "pendulum.json"]
        for name in LOCALES:
            for when in ("before", "after"):
                with self.subTest(locale=name, set=when):
                    _, different, missing = filecmp.cmpfiles(plain, self.files(name, when), names,
                                                             shallow=False)
                    self.assertEqual((different, missing), ([], []))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
