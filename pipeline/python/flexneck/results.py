# SPDX-License-Identifier: GPL-3.0-or-later
"""Contents of a folder of results."""

from __future__ import annotations

import pathlib
import typing

from . import _core
from .errors import InputError
from .folders import Folder, Path
from .run import Run
from .values import describe


class Table(typing.Mapping[str, typing.List[typing.Any]]):
    """A table of results, as the report shows it: columns by name. Numeric cells are floats in the
    unit of their column; all others are texts."""

    def __init__(self, name: str, title: str, columns: list[tuple[str, str]],
                 rows: list[list[str]], notes: list[str]) -> None:
        self._name, self._title, self._notes = name, title, notes
        self._units = {column: unit for column, unit in columns if unit}
        self._columns = {column: [_cell(row[k]) for row in rows]
                         for k, (column, _) in enumerate(columns)}

    @property
    def name(self) -> str:
        """Identifier of the table, such as "peaks"."""
        return self._name

    @property
    def title(self) -> str:
        """Title of the table for readers."""
        return self._title

    @property
    def notes(self) -> list[str]:
        """Notes on the table: origins, contradictions, warnings."""
        return list(self._notes)

    @property
    def units(self) -> dict[str, str]:
        """Units of the columns that have one."""
        return dict(self._units)

    def __getitem__(self, column: str) -> list[typing.Any]:
        return self._columns[column]

    def __iter__(self) -> typing.Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def rows(self) -> list[dict[str, typing.Any]]:
        """One dictionary per row: column name to cell."""
        return [dict(zip(self._columns, row)) for row in zip(*self._columns.values())]

    def __repr__(self) -> str:
        return f"<Table {self._name!r}: {', '.join(self._columns)}>"


class VerificationRow(typing.NamedTuple):
    """A computed figure and its reference."""

    quantity: str
    detail: str
    computed: str
    reference: str
    unit: str
    error_percent: float | None
    status: str
    fitted: bool


describe(
    VerificationRow,
    quantity="Name of the figure, such as \"bending 1\".",
    detail="Mode or method.",
    computed="Computed value, as printed.",
    reference="Reference value, usually published.",
    unit="Unit of both values.",
    error_percent="Deviation of the computed value, per cent, if both are numbers.",
    status="passed, failed, compared (without tolerance) or unjudged (no verdict).",
    fitted="Whether the geometry was fitted to this figure.",
)


class Results:
    """A folder of results, from Study.run(), qualify(), sweep(), fit() or Results(folder)."""

    def __init__(self, folder: Path | Folder) -> None:
        self._folder = folder if isinstance(folder, Folder) else Folder(folder)
        if not self._folder.path.is_dir():
            raise InputError(f"{self._folder.path}: expected a folder of results, found none")

    @property
    def folder(self) -> pathlib.Path:
        """Folder of the files."""
        return self._folder.path

    @property
    def files(self) -> list[str]:
        """Names of the files."""
        return sorted(each.name for each in self._folder.path.iterdir() if each.is_file())

    @property
    def tables(self) -> dict[str, Table]:
        """All tables of the JSON files in the folder, by name."""
        found: dict[str, Table] = {}
        for file in sorted(self._folder.path.glob("*.json")):
            if _core.holds_tables(str(file)):
                for name, *rest in _core.tables(str(file)):
                    found[name] = Table(name, *rest)
        return found

    @property
    def verification(self) -> list[VerificationRow]:
        """Computed figures compared with published ones; empty if the study has no verification."""
        file = self._folder.path / "verification.json"
        if not file.exists():
            return []
        return [VerificationRow(*each) for each in _core.verification(str(file))]

    @property
    def runs(self) -> list[str]:
        """Names of the runs, such as "pendulum-flexion-120"."""
        return sorted(each.stem for pattern in ("pendulum-*.h5", "static-*.h5")
                      for each in self._folder.path.glob(pattern))

    def run(self, name: str) -> Run:
        """A run by its name or by its case: "pendulum-flexion-120", "flexion-120"."""
        for full in (name, f"pendulum-{name}", f"static-{name}"):
            if full in self.runs:
                return Run(_core.read_run(self._folder.file(full + ".h5")), self._folder, full)
        raise InputError(f"{self._folder.path}: there is no run '{name}'; there are: "
                         + (", ".join(self.runs) or "none"))

    def __repr__(self) -> str:
        return f"Results({str(self._folder.path)!r})"


def _cell(text: str) -> typing.Any:
    try:
        return float(text)
    except ValueError:
        return text
