# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of numbers as text, a row a line, and their comparison."""

import csv
import math
from dataclasses import dataclass

# Fraction of the largest channel of a unit in a file that is the scale of smaller channels: values
# that symmetry makes zero are rounding.
FLOOR = 1e-3
TIME_TOLERANCE_S = 1e-9
VALUES = ["name", "unit", "numbers"]
TEXTS = ["name", "unit", "cells"]  # compared as they are
PEAKS = ["name", "unit", "least", "time [s]", "largest", "time [s]", "last"]


@dataclass
class Table:
    name: str
    columns: list  # VALUES, PEAKS or TEXTS
    tolerance: float  # relative to the scale that rows share
    rows: list  # (name, unit, numbers), or texts in place of numbers


def written(cell):
    return cell if isinstance(cell, str) else f"{cell:.11e}"


def write(path, table):
    with open(path, "w", newline="", encoding="utf-8") as file:
        lines = csv.writer(file, lineterminator="\n")
        lines.writerow(table.columns)
        for name, unit, numbers in table.rows:
            lines.writerow([name, unit, *map(written, numbers)])


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        columns, *rows = csv.reader(file)
    cell_of = str if columns == TEXTS else float
    return [(name, unit, [cell_of(cell) for cell in cells]) for name, unit, *cells in rows]


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

    if table.columns == TEXTS:
        return lambda row: 1
    if table.columns == VALUES:
        return largest(dataset_of)
    own, of_unit = largest(channel_of), largest(unit_of)
    return lambda row: max(own(row), FLOOR * of_unit(row))


def differ(stored, found, scale, tolerance):
    """A text if two numbers or texts are not the same."""
    if isinstance(stored, str):
        return f"stored '{stored}', found '{found}'" if stored != found else ""
    if math.isnan(stored) and math.isnan(found):
        return ""
    difference = abs(found - stored) / scale
    if difference <= tolerance:
        return ""
    return (f"stored {written(stored)}, found {written(found)}, "
            f"relative difference {difference:.1e}")


def difference_of(row, other, table, scale):
    """What is different in a row, as text; nothing if all is the same within the tolerance."""
    if other is None:
        return "stored, but not found"
    if row[1] != other[1] or len(row[2]) != len(other[2]):
        return f"stored {len(row[2])} in '{row[1]}', found {len(other[2])} in '{other[1]}'"
    texts = []
    for k, (stored, found) in enumerate(zip(row[2], other[2])):
        column = table.columns[2 + k] if table.columns == PEAKS else f"{k + 1}"
        limits = (1, TIME_TOLERANCE_S) if column == "time [s]" else (scale, table.tolerance)
        if text := differ(stored, found, *limits):
            texts.append(f"{column}: {text}")
    return "; ".join(texts)


def differences(stored, table):
    """By the names of the rows that differ, what is different."""
    found = {row[0]: row for row in table.rows}
    scale_of = scales_of(table, stored)
    texts = {row[0]: difference_of(row, found.get(row[0]), table, scale_of(row) or 1)
             for row in stored}
    texts |= {name: "found, but not stored" for name in found if name not in texts}
    return {name: text for name, text in texts.items() if text}
