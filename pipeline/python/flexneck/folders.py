# SPDX-License-Identifier: GPL-3.0-or-later
"""Folders of results, and the commands that work in them."""

from __future__ import annotations

import os
import pathlib
import shutil
import tempfile
import typing
import weakref

from . import _core
from .errors import warn

Path = typing.Union[str, "os.PathLike[str]"]


class Folder:
    """A folder of results: a given one, or a temporary one that is removed with this object."""

    def __init__(self, path: Path | None) -> None:
        self.path = pathlib.Path(tempfile.mkdtemp(prefix="flexneck-") if path is None else path).absolute()
        if path is None:
            weakref.finalize(self, shutil.rmtree, self.path, ignore_errors=True)

    def file(self, name: str) -> str:
        return str(self.path / name)


def execute(command: str, folder: Folder, files: list[str], settings: list[str],
            **options: typing.Any) -> bool:
    """Runs a command of `flexneck` and issues its warnings. Returns False if a verification failed."""
    passed, warnings = _core.execute(command, files, settings, str(folder.path), **options)
    warn(warnings)
    return bool(passed)
