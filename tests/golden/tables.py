# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of numbers as text, a row a line, and their comparison."""

import csv
import math
from dataclasses import dataclass

# A channel that is smaller than this share of the largest one of its unit in its file is compared on
# the scale of that share: what symmetry makes zero is rounding.
FLOOR = 1e-3
TIME_TOLERANCE_S = 1e-9
VALUES = ["name", "unit", "numbers"]
PEAKS = ["name", "unit", "least", "time [s]", "largest", "time [s]", "last"]


@dataclass
class Table:
    name: str
    columns: list  # VALUES or PEAKS
    tolerance: float  # relative to the scale that rows share
    rows: list  # (name, unit, numbers)


def written(number):
    return f"{number:.11e}"


def write(path, table):
    with open(path, "w", newline="", encoding="utf-8") as file:
        lines = csv.writer(file, lineterminator="\n")
        lines.writerow(table.columns)
        for name, unit, numbers in table.rows:
            lines.writerow([name, unit, *map(written, numbers)])


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))[1:]
    return [(name, unit, [float(number) for number in numbers]) for name, unit, *numbers in rows]


def dataset_of(row):
    """Rows whose names differ in [indices] only share a scale."""
    return row[0].partition("[")[0]


def channel_of(row):
    """The columns of a channel share a scale."""
    return row[0].rpartition(": ")[0]


def unit_of(row):
    """The channels of a file that have the same unit."""
    return row[0].rpartition("/")[0], row[1]


def quantities(table, numbers):
    return numbers[0::2] if table.columns == PEAKS else numbers


def scales_of(table, rows):
    """One for each row, from the largest of the stored numbers."""
    def largest(key):
        sizes = {}
        for row in rows:
            size = max(map(abs, quantities(table, row[2])))
            sizes[key(row)] = max(size, sizes.get(key(row), 0))
        return lambda row: sizes[key(row)]

    if table.columns == VALUES:
        return largest(dataset_of)
    own, of_unit = largest(channel_of), largest(unit_of)
    return lambda row: max(own(row), FLOOR * of_unit(row))


def difference_of(row, other, table, scale):
    """What is different in a row, as text; nothing if all is the same within the tolerance."""
    if other is None:
        return "stored, but not found"
    if row[1] != other[1] or len(row[2]) != len(other[2]):
        return f"stored {len(row[2])} numbers in {row[1]}, found {len(other[2])} in {other[1]}"
    for k, (stored, found) in enumerate(zip(row[2], other[2])):
        column = table.columns[2 + k] if table.columns == PEAKS else ""
        is_time = column == "time [s]"
        difference = abs(found - stored) / (1 if is_time else scale)
        if math.isnan(stored) and math.isnan(found):
            continue
        if not difference <= (TIME_TOLERANCE_S if is_time else table.tolerance):  # NaN differs
            return (f"{column or f'number {k + 1}'}: stored {written(stored)}, "
                    f"found {written(found)}, relative difference {difference:.1e}")
    return ""


def differences(stored, table):
    """By the names of the rows that differ, what is different."""
    found = {row[0]: row for row in table.rows}
    scale_of = scales_of(table, stored)
    texts = {row[0]: difference_of(row, found.get(row[0]), table, scale_of(row) or 1)
             for row in stored}
    texts |= {name: "found, but not stored" for name in found if name not in texts}
    return {name: text for name, text in texts.items() if text}
