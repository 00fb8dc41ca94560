# SPDX-License-Identifier: GPL-3.0-or-later
"""A fit: the modulus of a clamped bar from one measured frequency, and the bar that has it.

    python3 fit_modulus.py [FOLDER]
"""

import pathlib
import sys

import flexneck as fn

out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out")
out.mkdir(parents=True, exist_ok=True)

MEASURED_HZ = 60.0

(out / "bar.toml").write_text(f"""
include = ["cantilever"]

[modes]
count = 2

[fit]
starts = 1
history_samples = 10
profiles = false

[[fit.parameter]]
name = "modulus"
key = "geometry.materials.aluminium.youngs_modulus"
unit = "GPa"
from = 40
to = 80

[[fit.target]]
name = "first bending"
output = "modes.frequency.mode 1"
value = {{ value = "{MEASURED_HZ} Hz", origin = "synthetic", note = "stands for a measurement" }}
standard_deviation = "0.1 Hz"
""")
results = fn.Study(out / "bar.toml").fit(out / "fit")
for row in results.tables["fit parameters"].rows():
    print(row)

# The study written by the fit, with a modulus of origin "calibrated".
fitted = fn.Study(results.folder / "fitted.toml")
key = "geometry.materials.aluminium.youngs_modulus"
print(fitted.values[key])
frequency = fitted.mesh().modes().frequencies[0]
print(f"first frequency {frequency:.4f} Hz, measured {MEASURED_HZ} Hz")
assert abs(frequency - MEASURED_HZ) < 0.01
