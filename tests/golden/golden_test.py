#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares what the program computes with the tables that are stored here, or stores them anew.

Usage: golden_test.py compare|store FLEXNECK      (77: skipped, for want of h5py)
"""

import sys
import tempfile
from pathlib import Path

try:
    from runs import Runs
except ImportError as error:
    print(f"SKIPPED: {error}; install python3-h5py")
    sys.exit(77)
import tables

FOLDER = Path(__file__).resolve().parent / "tables"


def changes_of(table, action):
    """The rows that differ. When stored anew, the others keep their digits, so that what the files'
    history shows is the changes."""
    path = FOLDER / f"{table.name}.csv"
    stored = tables.read(path) if path.exists() else []
    changes = tables.differences(stored, table)
    print(f"{table.name}: {len(table.rows)} rows, {len(changes)} changes", flush=True)
    if action == "store" and changes:
        kept = {row[0]: row for row in stored if row[0] not in changes}
        table.rows = [kept.get(row[0], row) for row in table.rows]
        tables.write(path, table)
    return [f"{table.name}: {name}: {change}" for name, change in changes.items()]


def main(action, flexneck):
    with tempfile.TemporaryDirectory() as folder:
        changes = [line for table in Runs(flexneck, folder).tables()
                   for line in changes_of(table, action)]
    print("\n".join(changes))
    return 1 if changes and action == "compare" else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
