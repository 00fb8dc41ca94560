# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs: time histories, in memory or from a file."""

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
    """One or several curves at the output times of a run. NumPy treats it as the array `values`."""

    def __init__(self, name: str, unit: str, columns: list[str], filter: str,
                 values: Array) -> None:
        self._name, self._unit, self._columns = name, unit, columns
        self._filter, self._values = filter, values

    @property
    def name(self) -> str:
        """Name of the channel, such as "head rotation"."""
        return self._name

    @property
    def unit(self) -> str:
        """SI unit of `values`."""
        return self._unit

    @property
    def columns(self) -> list[str]:
        """Names of the curves, such as x, y, z."""
        return list(self._columns)

    @property
    def filter(self) -> str:
        """Filter, such as "CFC 600"; empty for none."""
        return self._filter

    @property
    def values(self) -> Array:
        """Values: (n,) for one curve, (n, columns) for several, in `unit`; a view."""
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
    """Motion of a marker, one row per time; views."""

    position: Array
    velocity: Array
    acceleration: Array
    rotation: Array
    angular_velocity: Array
    angular_acceleration: Array


describe(
    MarkerMotion,
    position="Position of its origin, (n, 3), m, world.",
    velocity="Velocity, (n, 3), m/s, world.",
    acceleration="Acceleration, (n, 3), m/s^2, world; kinematic: gravity is not subtracted.",
    rotation="Rotation, (n, 4), 1, unit quaternion from marker to world: w, x, y, z.",
    angular_velocity="Angular velocity, (n, 3), rad/s, world.",
    angular_acceleration="Angular acceleration, (n, 3), rad/s^2, world.",
)


class JointLoads(typing.NamedTuple):
    """Load that the lower body exerts on the upper one through a joint, in the axes of the lower
    marker, about the joint point; views."""

    force: Array
    moment: Array
    undetermined: str


describe(
    JointLoads,
    force="Force, (n, 3), N.",
    moment="Moment, (n, 3), N m.",
    undetermined="Components that redundant joints leave undetermined; usually empty.",
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
    frequency="Undamped frequency |lambda| / 2 pi, Hz.",
    damped_frequency="Damped frequency, Hz; 0 for an overdamped mode.",
    damping_ratio="Damping ratio, 1.",
    growth_rate="Growth rate, 1/s; not 0 only for an unstable mode.",
    kink="Load that has a kink at this state, if any.",
    translation="Translations of the markers, (markers, 3), m, world; the largest is 1.",
    rotation="Rotations of the markers, (markers, 3), rad, world; same scale.",
)


class Run:
    """A run, from ModalBody.pendulum(), ModalBody.static(), Model.simulate(), Results.run() or
    Run.read(). `run["head rotation"]` is a channel."""

    def __init__(self, data: typing.Any, folder: Folder | None, name: str) -> None:
        self._data, self._folder, self._name = data, folder, name

    @staticmethod
    def read(path: Path) -> Run:
        """Reads a run from a history file: pendulum-<case>.h5, static-<case>.h5 or a file of
        `flexneck simulate`."""
        file = pathlib.Path(path)
        run = Run(_core.read_run(str(path)), Folder(file.parent), file.stem)
        warn(run.warnings)
        return run

    @property
    def name(self) -> str:
        """Name of its files, such as "pendulum-flexion-120"."""
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
        """A channel by its name. Raises KeyError, which lists all channels, for an unknown name."""
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
        """Energies, (n,), J: kinetic, gravitational and strain, and dissipated and work since the
        start. kinetic + gravitational + strain + dissipated - work is constant; views."""
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
        """Statistics of the run: accepted and rejected steps, evaluations of the equations of motion,
        largest_position_residual (m or rad) and largest_velocity_residual (per s), and limits: the
        numbers of steps by what limited their size."""
        return dict(self._data.statistics)

    @property
    def linearisation(self) -> tuple[str, list[str], list[SmallMotion]] | None:
        """State about which the model was linearised, the names of its markers and the modes of small
        motions; None if the model has no linearisation."""
        found = self._data.linearisation
        if found is None:
            return None
        about, markers, modes = found
        return about, list(markers), [SmallMotion(*each) for each in modes]

    @property
    def values(self) -> dict[str, Value]:
        """All input values of the run, by dotted key."""
        return {key: Value(*rest) for key, *rest in self._data.parameters}

    @property
    def incomplete(self) -> str:
        """Reason why the run ended early; usually empty."""
        return str(self._data.incomplete)

    @property
    def warnings(self) -> list[str]:
        """Warnings about results that may be unreliable."""
        return list(self._data.warnings)

    def write(self, path: Path) -> None:
        """Writes the history file that read() reads, identical to that of the command."""
        if self._folder is not None:
            shutil.copyfile(self._folder.file(self._name + ".h5"), path)
        else:
            self._data.write(str(path))

    def write_table(self, path: Path) -> None:
        """Writes the channels as comma-separated values in SI units, one line per time."""
        self._data.write_table(str(path))

    def export(self, path: Path) -> None:
        """Writes the run in the format given by the extension of the file, as `flexneck export` does:
        .mme (ISO-MME), .pvd (ParaView) or .csv."""
        folder = self._folder
        if folder is None:
            folder = Folder(None)
            self._data.write(folder.file(self._name + ".h5"))
        execute("export", folder, [folder.file(self._name + ".h5")], [], target=str(path))

    def __repr__(self) -> str:
        return f"<Run {self._name!r}: {len(self.time)} times up to {self.time[-1]:.4g} s>"

