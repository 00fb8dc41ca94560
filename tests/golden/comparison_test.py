#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The comparison of tables sees what it is there to see."""

import copy
import math
import unittest
from pathlib import Path

import tables

FOLDER = Path(__file__).resolve().parent / "tables"


def stored(name, tolerance):
    path = FOLDER / f"{name}.csv"
    columns = path.read_text(encoding="utf-8").partition("\n")[0].split(",")
    return tables.Table(name, columns, tolerance, tables.read(path))


class Comparison(unittest.TestCase):
    def changed(self, table, row, number, change):
        """The names of the rows that differ once a number is changed."""
        other = copy.deepcopy(table)
        numbers = next(numbers for name, _, numbers in other.rows if name == row)
        numbers[number] = change(numbers[number])
        return list(tables.differences(table.rows, other))

    def test_a_table_is_like_itself(self):
        for path in [*FOLDER.glob("hybrid3*.csv"), FOLDER / "printed.csv"]:
            table = stored(path.stem, 0)
            self.assertEqual(tables.differences(table.rows, table), {})

    def test_a_number_may_differ_by_the_tolerance_of_its_scale(self):
        table = stored("hybrid3", 1e-9)
        frequency = "modes/frequencies 10"  # has its own scale
        self.assertEqual(self.changed(table, frequency, 0, lambda f: f * (1 + 2e-9)), [frequency])
        self.assertEqual(self.changed(table, frequency, 0, lambda f: f * (1 + 5e-10)), [])
        inertia = "modes/invariants/J0[2]"  # the largest of J0 is 7.8e-3
        self.assertEqual(self.changed(table, inertia, 2, lambda J: J + 1.6e-11), [inertia])
        self.assertEqual(self.changed(table, inertia, 2, lambda J: J + 6e-12), [])

    def test_of_a_peak_its_value_and_its_time_count(self):
        table = stored("hybrid3_pendulum", 1e-7)
        row = "hybrid3/pendulum-flexion-60/head rotation: head rotation"
        for number in (0, 2, 4):
            self.assertEqual(self.changed(table, row, number, lambda phi: phi + 2e-7), [row])
            self.assertEqual(self.changed(table, row, number, lambda phi: phi + 2e-8), [])
        for number in (1, 3):
            self.assertEqual(self.changed(table, row, number, lambda time: time + 5e-4), [row])

    def test_texts_are_the_same_or_not(self):
        table = stored("printed", 0)
        row = "hybrid3/verification/bending 1, fore-aft bending 1"
        self.assertEqual(self.changed(table, row, 0, lambda _: "35.916"), [row])

    def test_missing_and_strange_numbers_differ(self):
        table = stored("hybrid3", 1e-9)
        name, unit, numbers = table.rows[20]
        self.assertEqual(self.changed(table, name, 0, lambda _: math.nan), [name])
        for row in ((name, "furlong", numbers), (name, unit, numbers[1:]), ("new", unit, numbers)):
            other = copy.deepcopy(table)
            other.rows[20] = row
            self.assertEqual(set(tables.differences(table.rows, other)), {name, row[0]})
        other = copy.deepcopy(table)
        del other.rows[20]
        self.assertEqual(list(tables.differences(table.rows, other)), [name])


if __name__ == "__main__":
    unittest.main(verbosity=2)
