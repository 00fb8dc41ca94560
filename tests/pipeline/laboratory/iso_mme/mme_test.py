#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What another program's reader of ISO-MME finds in an exported run, against the table that the run wrote: codes,
times and every number. The reader takes what readers of the format take in common, such as pyisomme's: the index by
"Name of channel NNN", keys up to the first colon, the samples behind the last line that has one.

Usage: mme_test.py FLEXNECK
"""

import csv
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

# Andrews' squeezing mechanism: seven angles.
MODEL = Path(__file__).resolve().parents[4] / "pipeline/data/models/andrews.toml"


def descriptors(path):
    pairs, samples = [], []
    for line in path.read_text("utf-8").splitlines():
        if ":" in line and not samples:
            pairs.append(tuple(part.strip() for part in line.split(":", 1)))
        elif line.strip():
            samples.append(float(line))
    return pairs, samples


def read(folder):
    """Channels by code: name, times, samples."""
    test = next(folder.glob("*.mme"))
    found = {}
    index, _ = descriptors(folder / "Channel" / (test.stem + ".chn"))
    for key, value in index:
        number = re.fullmatch(r"Name of channel (\d+)", key)
        if not number:
            continue
        pairs, samples = descriptors(folder / "Channel" / f"{test.stem}.{number[1]}")
        header = dict(pairs)
        code = value.split("/")[0].strip()
        assert header["Channel code"] == code and int(header["Number of samples"]) == len(samples)
        first, step = float(header["Time of first sample"]), float(header["Sampling interval"])
        found[code] = (header["Name of the channel"], header["Unit"],
                       [first + k * step for k in range(len(samples))], samples)
    assert int(dict(index)["Number of channels"]) == len(found)
    return found


class ExportedRun(unittest.TestCase):
    def test_every_number_of_the_table_is_there(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for line in (["simulate", "-q", MODEL, "-o", folder / "out"],
                         ["export", "-q", folder / "out" / (MODEL.stem + ".h5"), "--to", folder / "lab/lab.mme"]):
                subprocess.run([FLEXNECK, *map(str, line)], check=True)
            with open(folder / "out" / (MODEL.stem + ".csv"), encoding="utf-8", newline="") as file:
                rows = list(csv.reader(file))
            channels = read(folder / "lab")
        self.assertEqual(len(channels), len(rows[0]) - 1)
        times = [float(row[0]) for row in rows[1:]]
        for column, (code, (name, unit, own_times, samples)) in enumerate(channels.items(), 1):
            self.assertRegex(code, r"^[A-Za-z0-9]{16}$")
            self.assertEqual(rows[0][column].split(" [")[0], name)
            self.assertNotEqual(unit, "")
            self.assertEqual([float(row[column]) for row in rows[1:]][:len(samples)], samples)
            self.assertGreaterEqual(len(samples), len(times) - 1)
            self.assertEqual(times[:len(own_times) - 1], own_times[:-1])


if __name__ == "__main__":
    FLEXNECK = sys.argv.pop()
    unittest.main()
