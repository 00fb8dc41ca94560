#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Includes go one way: from a room to those before it, through the folders that are its doors, and
within a room from a folder to those above it in the table of the room's README.md."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
# The folders in the order in which data pass through, each with those of its folders that later
# ones may include, except for pipeline/, which knows every stage.
DOORS = {
    "geometry": {"foundation"},
    "mesher": {"mesh", "partition", "exchange"},
    "fe_modal": {"body"},
    "multibody": set(),
    "pipeline": set(),
}


def folders_of(room):
    """The folders of sources in the order of the table."""
    rows = re.findall(r"^\| `([a-z_/]+)/`", (ROOT / room / "README.md").read_text(), re.MULTILINE)
    return [name for name in rows if sources_in(ROOT / room / name)]


def folder_of(header, folders):
    """The longest of the folders that the header of a room is in, or "" for the room itself."""
    path = header.split("/", 1)[1]
    return max((name for name in folders if path.startswith(name + "/")), key=len, default="")


def sources_in(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in (".h", ".cpp"))


def problems_of(room, earlier):
    folders = folders_of(room)
    tops = {name.split("/")[0] for name in folders}
    for missing in {path.name for path in (ROOT / room).iterdir() if sources_in(path)} - tops:
        yield f"{room}/README.md: the table of folders lacks {missing}/"
    for source in sources_in(ROOT / room):
        path = source.relative_to(ROOT).as_posix()
        mine = folder_of(path, folders)
        later = folders[folders.index(mine) + 1:] if mine else []
        for name in re.findall(r'^ *#include "([^"]+)"', source.read_text(), re.MULTILINE):
            to, folder = name.split("/")[0], name.split("/")[1]
            if to not in DOORS or not list(ROOT.glob(name + "*")):
                yield f"{path}: includes {name}, which is no header of a room"
            elif to != room and to not in earlier:
                yield f"{path}: includes {name} of a later room"
            elif to != room and room != "pipeline" and folder not in DOORS[to]:
                yield f"{path}: includes {name}, which is no door of {to}/"
            elif to == room and folder_of(name, folders) in later:
                yield f"{path}: includes {name} of a folder below {mine}/"


def main():
    problems, earlier = [], []
    for room in DOORS:
        problems += list(problems_of(room, earlier))
        earlier.append(room)
    print("\n".join(problems))
    sys.exit(bool(problems))


if __name__ == "__main__":
    main()
