# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs: time histories, in memory or of a file."""

from __future__ import annotations

import pathlib
import shutil
import typing

import numpy as np

from . import _core
from .errors import warn
from .folders import Folder, Path, execute
from .values import Value, describe

if typing.TYPE_CHECKING:
    import numpy.typing as npt

    Array = npt.NDArray[np.float64]


class Channel:
    """A curve or a few of them at the times of a run. It is an array to NumPy: its values."""

    def __init__(self, name: str, unit: str, columns: list[str], filter: str,
                 values: Array) -> None:
        self._name, self._unit, self._columns = name, unit, columns
        self._filter, self._values = filter, values

    @property
    def name(self) -> str:
        """Such as "head rotation"."""
        return self._name

    @property
    def unit(self) -> str:
        """Of `values`, SI."""
        return self._unit

    @property
    def columns(self) -> list[str]:
        """Names of the curves, such as x, y, z."""
        return list(self._columns)

    @property
    def filter(self) -> str:
        """Such as "CFC 600"; empty for none."""
        return self._filter

    @property
    def values(self) -> Array:
        """(n,) of one curve, (n, columns) of several, in `unit`; a view."""
        return self._values[:, 0] if self._values.shape[1] == 1 else self._values

    def to(self, unit: str) -> Array:
        """The values in another unit of the same dimension, such as "deg", "lbf*ft", "gn": a new
        array of the shape of `values`."""
        return typing.cast("Array", self.values * _core.factor_from_si(self._unit, unit))

    def __array__(self, dtype: typing.Any = None, copy: bool | None = None) -> Array:
        return np.array(self.values, dtype=dtype) if copy else np.asarray(self.values, dtype=dtype)

    def __len__(self) -> int:
        return len(self._values)

    def __repr__(self) -> str:
        return f"<Channel {self._name!r} [{self._unit}], {len(self._values)} times>"


class MarkerMotion(typing.NamedTuple):
    """Motion of a marker, a row for each time; views."""

    position: Array
    velocity: Array
    acceleration: Array
    rotation: Array
    angular_velocity: Array
    angular_acceleration: Array


describe(
    MarkerMotion,
    position="(n, 3), m, of its origin in the world.",
    velocity="(n, 3), m/s, world.",
    acceleration="(n, 3), m/s^2, world; kinematic: gravity is not subtracted.",
    rotation="(n, 4), 1, unit quaternion marker to world: w, x, y, z.",
    angular_velocity="(n, 3), rad/s, world.",
    angular_acceleration="(n, 3), rad/s^2, world.",
)


class JointLoads(typing.NamedTuple):
    """What the lower body exerts on the upper one through a joint, in the axes of the lower marker,
    about the joint point; views."""

    force: Array
    moment: Array
    undetermined: str


describe(
    JointLoads,
    force="(n, 3), N.",
    moment="(n, 3), N m.",
    undetermined="Components that redundant joints leave open; empty as a rule.",
)


class SmallMotion(typing.NamedTuple):
    """A mode of the linearised model."""

    frequency: float
    damped_frequency: float
    damping_ratio: float
    growth_rate: float
    kink: str
    translation: npt.NDArray[np.complex128]
    rotation: npt.NDArray[np.complex128]


describe(
    SmallMotion,
    frequency="|lambda| / 2 pi, Hz.",
    damped_frequency="Hz; 0 of an overdamped one.",
    damping_ratio="1.",
    growth_rate="1/s; not 0 of an unstable one alone.",
    kink="Which load has a kink there, if any.",
    translation="(markers, 3), m, world; the largest is 1.",
    rotation="(markers, 3), rad, likewise.",
)


class Run:
    """A run, from ModalBody.pendulum(), ModalBody.static(), Model.simulate(), Results.run() or
    Run.read(). `run["head rotation"]` is a channel."""

    def __init__(self, data: typing.Any, folder: Folder | None, name: str) -> None:
        self._data, self._folder, self._name = data, folder, name

    @staticmethod
    def read(path: Path) -> Run:
        """The run of a history file: pendulum-<case>.h5, static-<case>.h5 or what `flexneck
        simulate` writes."""
        file = pathlib.Path(path)
        run = Run(_core.read_run(str(path)), Folder(file.parent), file.stem)
        warn(run.warnings)
        return run

    @property
    def name(self) -> str:
        """Of its files, such as "pendulum-flexion-120"."""
        return self._name

    @property
    def time(self) -> Array:
        """Output times, (n,), s, strictly increasing; a view."""
        return typing.cast("Array", self._data.time)

    @property
    def channels(self) -> dict[str, Channel]:
        """All channels by name."""
        return {name: Channel(name, *rest) for name, rest in self._data.channels.items()}

    def __getitem__(self, channel: str) -> Channel:
        """A channel by its name. Raises KeyError, which lists them all."""
        found = self._data.channels.get(channel)
        if found is None:
            raise KeyError(f"there is no channel {channel!r}; there are: "
                           + ", ".join(self._data.channels))
        return Channel(channel, *found)

    @property
    def markers(self) -> dict[str, MarkerMotion]:
        """Motions of the markers by name."""
        return {name: MarkerMotion(**each) for name, each in self._data.markers.items()}

    @property
    def joints(self) -> dict[str, JointLoads]:
        """Loads of the joints by name."""
        return {name: JointLoads(**each) for name, each in self._data.joints.items()}

    @property
    def modal(self) -> dict[str, Array]:
        """Modal coordinates of the deformable bodies by name, (n, m), kg^(1/2) m; views."""
        return {name: each[1] for name, each in self._data.modal.items()}

    @property
    def modes(self) -> dict[str, list[str]]:
        """Names of the modes of `modal`, in the order of its columns."""
        return {name: list(each[0]) for name, each in self._data.modal.items()}

    @property
    def energy(self) -> dict[str, Array]:
        """Energies, (n,), J: kinetic, gravitational, strain, and since the start dissipated and
        work. kinetic + gravitational + strain + dissipated - work stays the same; views."""
        return dict(self._data.energy)

    @property
    def peaks(self) -> dict[str, list[typing.Any]]:
        """The smallest and largest value of every curve with their times, as columns: channel,
        column, unit (SI), smallest, smallest at (s), largest, largest at (s)."""
        table: dict[str, list[typing.Any]] = {
            key: [] for key in ("channel", "column", "unit", "smallest", "smallest at", "largest",
                                "largest at")}
        for name, (unit, columns, _, values) in self._data.channels.items():
            for index, column in enumerate(columns or [""]):
                low, high = int(values[:, index].argmin()), int(values[:, index].argmax())
                row = (name, column, unit, float(values[low, index]), float(self.time[low]),
                       float(values[high, index]), float(self.time[high]))
                for key, cell in zip(table, row):
                    table[key].append(cell)
        return table

    @property
    def statistics(self) -> dict[str, typing.Any]:
        """What the run took: accepted and rejected steps, evaluations of the equations of motion,
        largest_position_residual (m or rad) and largest_velocity_residual (per s), and limits: what
        set the length of how many steps."""
        return dict(self._data.statistics)

    @property
    def linearisation(self) -> tuple[str, list[str], list[SmallMotion]] | None:
        """About what the model was linearised, the names of its markers and the modes of small
        motions; None if the model does not ask for them."""
        found = self._data.linearisation
        if found is None:
            return None
        about, markers, modes = found
        return about, list(markers), [SmallMotion(*each) for each in modes]

    @property
    def values(self) -> dict[str, Value]:
        """Every value that the run was made from, by its dotted key."""
        return {key: Value(*rest) for key, *rest in self._data.parameters}

    @property
    def incomplete(self) -> str:
        """Why the run ended early; empty as a rule."""
        return str(self._data.incomplete)

    @property
    def warnings(self) -> list[str]:
        """What of the results is not to be trusted."""
        return list(self._data.warnings)

    def write(self, path: Path) -> None:
        """Writes the history file that read() reads, the bytes of the command's."""
        if self._folder is not None:
            shutil.copyfile(self._folder.file(self._name + ".h5"), path)
        else:
            self._data.write(str(path))

    def write_table(self, path: Path) -> None:
        """Writes the channels as comma-separated values in SI units, a line for each time."""
        self._data.write_table(str(path))

    def export(self, path: Path) -> None:
        """Writes the run in the format of the file's ending, as `flexneck export` does: .mme
        (ISO-MME), .pvd (ParaView) or .csv."""
        folder = self._folder
        if folder is None:
            folder = Folder(None)
            self._data.write(folder.file(self._name + ".h5"))
        execute("export", folder, [folder.file(self._name + ".h5")], [], target=str(path))

    def __repr__(self) -> str:
        return f"<Run {self._name!r}: {len(self.time)} times up to {self.time[-1]:.4g} s>"

