# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads the numbers that are stored from the files of a run: rows (name, unit, numbers). The only code
here that knows the names of datasets: who renames one changes this file, and the tables stay."""

import json

import h5py
import numpy as np

# Datasets of modes.h5 that do not depend on the shapes of modes, and the scale of their numbers.
# "own": each has its own; "all": that of the largest; "blocks": that of the largest in a 3 x 3
# block (translations, rotations and their coupling).
VALUES = {"frequencies": "own", "invariants/mass": "own", "invariants/S1": "all",
          "invariants/J0": "all", "invariants/Maa": "all", "basis/energy_fractions": "all"}
INTERFACE_VALUES = {"position": "all", "compliance": "blocks"}
ATTACHED_VALUES = {"frequencies": "own", "mass_matrix": "blocks"}
# Datasets that depend on the shapes, and their axes that run over the modes.
SHAPES = {"invariants/S2": [1], "invariants/N0": [1], "invariants/G0": [0],
          "invariants/G": [0, 1], "invariants/N": [0, 1]}
INTERFACE_SHAPES = {"translation": [1], "rotation": [1]}
STATIC_SHAPES = {"response_mass": "blocks"}
LINEARISATION = ("frequency", "damped_frequency", "damping_ratio")
CLOSE = 1.05  # ratio of neighbouring frequencies up to which rounding mixes their modes


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def unit_of(dataset):
    return text(dataset.attrs.get("units", "1"))


def rows_of(name, values, unit, scale="all"):
    """The numbers of a row are those along the last axis. Rows that differ in [indices] only share a
    scale (tables.py)."""
    values = np.asarray(values, dtype=float)
    if scale == "own":
        return [(f"{name} {k + 1}", unit, [value]) for k, value in enumerate(values.flat)]
    if scale == "blocks":
        return [(f"{name} {block}[{i}]", unit, values[3 * row + i, 3 * column:3 * column + 3])
                for row, column, block in ((0, 0, "tt"), (0, 1, "tr"), (1, 0, "rt"), (1, 1, "rr"))
                for i in range(3)]
    if values.ndim == 1:
        return [(name, unit, values)]
    return [(f"{name}[{','.join(map(str, index))}]", unit, values[index])
            for index in np.ndindex(values.shape[:-1])]


def datasets(parent, group):
    """All below a group, none if there is no such group, with their names from the parent on."""
    found = []
    if group in parent:
        parent[group].visititems(lambda name, item: found.append((f"{group}/{name}", item))
                                 if isinstance(item, h5py.Dataset) else None)
    return found


def mesh_rows(path):
    with h5py.File(path) as file:
        nodes = file["nodes"][:]
        box = [nodes.min(axis=0), nodes.mean(axis=0), nodes.max(axis=0)]
        return [("nodes", "1", [len(nodes)]), *rows_of("nodes: least, mean, largest", box, "m"),
                *((f"elements of {name}", "1", [len(item)]) for name, item in datasets(file, "blocks"))]


def selected(group, wanted, prefix=""):
    return [row for name, scale in wanted.items() if name in group
            for row in rows_of(prefix + name, group[name][:], unit_of(group[name]), scale)]


def close_modes(frequencies):
    """Runs of modes whose frequencies are close, as slices."""
    ends = [k for k in range(1, len(frequencies)) if frequencies[k] > CLOSE * frequencies[k - 1]]
    return [slice(*ends) for ends in zip([0, *ends], [*ends, len(frequencies)])]


def frequencies(path):
    with h5py.File(path) as file:
        return file["frequencies"][:]


def shape_datasets(file):
    """Name, dataset and its axes that run over the modes."""
    for name, axes in SHAPES.items():
        yield name, file[name], axes
    for interface, group in file["interfaces"].items():
        for name, axes in INTERFACE_SHAPES.items():
            yield f"interfaces/{interface}/{name}", group[name], axes


def norm_rows(file):
    """Roots of the sums of squares over close modes: they depend neither on a mode's sign nor on how
    close modes are mixed, so that they are as exact as frequencies."""
    groups = close_modes(file["frequencies"][:])
    label = lambda group: f"{group.start + 1}-{group.stop}"
    rows = [(f"shapes, norm[{label(group)}]", "kg^-0.5",
             np.sqrt((file["shapes"][group]**2).sum(axis=(0, 1)))) for group in groups]
    for name, dataset, axes in shape_datasets(file):
        squares = np.moveaxis(dataset[:], axes, range(len(axes)))**2
        for first in groups:
            for second in groups if len(axes) == 2 else [None]:
                block = squares[first] if second is None else squares[first, second]
                size = np.sqrt(block.sum(axis=tuple(range(len(axes))))).ravel()
                index = label(first) if second is None else f"{label(first)},{label(second)}"
                rows.append((f"{name}, norm[{index}]", unit_of(dataset), size))
    return rows


def modes_rows(path):
    with h5py.File(path) as file:
        rows = selected(file, VALUES) + norm_rows(file)
        for name, interface in file["interfaces"].items():
            rows += selected(interface, INTERFACE_VALUES, f"interfaces/{name}/")
        for name, body in file.get("attached", {}).items():
            rows += selected(body, ATTACHED_VALUES, f"attached/{name}/")
            for basis, found in datasets(body, "mode_counts"):
                rows += rows_of(f"attached/{name}/{basis}", found[:], "Hz", "own")
        return rows


def invariant_rows(path):
    """What depends on the shapes, number by number, with signs."""
    with h5py.File(path) as file:
        return [row for name, dataset, _ in shape_datasets(file)
                for row in rows_of(name, dataset[:], unit_of(dataset))]


def shapes_rows(path):
    """With signs: of geometric stiffness matrices the trace and the norm."""
    rows = invariant_rows(path)
    with h5py.File(path) as file:
        for name, interface in file["interfaces"].items():
            rows += selected(interface, STATIC_SHAPES, f"interfaces/{name}/")
        for name, matrices in datasets(file, "geometric_stiffness"):
            numbers = [[np.trace(each), np.linalg.norm(each)] for each in matrices[:]]
            rows += rows_of(name, numbers, unit_of(matrices))
        return rows


def system_rows(path):
    with h5py.File(path) as file:
        return selected(file["linearisation"], dict.fromkeys(LINEARISATION, "own"))


def peak_rows(path):
    """Of each column of each channel: least value and its time, largest and its time, last value."""
    rows = []
    with h5py.File(path) as file:
        times = file["time"][:]
        for name, channel in file["channels"].items():
            values = channel["values"][:]
            size = np.abs(values).max()
            for column, curve in zip(channel["columns"][:], values.T):
                numbers = []
                for peak in (curve.min(), curve.max()):
                    numbers += [peak, time_of(peak, curve, times, size)]
                rows.append((f"{name}: {text(column)}", unit_of(channel["values"]),
                             [*numbers, curve[-1]]))
    return rows


def time_of(peak, curve, times, size):
    """NaN where rounding decides it, since several times come as near to the peak."""
    near = np.flatnonzero(np.abs(curve - peak) <= 1e-6 * size)
    return times[near[0]] if len(near) == 1 else np.nan


def text_rows(path):
    """The cells of the tables in a file as they are printed, or of a verification."""
    content = json.loads(path.read_text(encoding="utf-8"))
    if "rows" in content:
        return [(f"{row['quantity']}, {row['detail']}", row["unit"],
                 [row["value"], row["reference"], row["status"]]) for row in content["rows"]]
    return [(f"{table['name']}/{k + 1}", "", cells)
            for table in content["tables"] for k, cells in enumerate(table["rows"])]
