# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes."""

from __future__ import annotations

import pathlib
import shutil
import typing

import numpy as np

from . import _core
from .body import ModalBody
from .errors import InputError
from .folders import Folder, Path, execute
from .toml_text import setting
from .values import describe

if typing.TYPE_CHECKING:
    import numpy.typing as npt

    from .study import Study


class Material(typing.NamedTuple):
    """A linear elastic, isotropic material."""

    name: str
    youngs_modulus: float
    poissons_ratio: float
    density: float


describe(
    Material,
    name="Name, such as \"aluminium\".",
    youngs_modulus="Young's modulus, Pa.",
    poissons_ratio="Poisson's ratio, 1.",
    density="Density, kg/m^3.",
)


class ElementBlock(typing.NamedTuple):
    """Elements of one part and of one kind."""

    part: str
    kind: str
    material: int
    nodes: npt.NDArray[np.int32]


describe(
    ElementBlock,
    part="Name of the part, such as \"plate_2\".",
    kind="Element kind, such as \"hex27\".",
    material="Index into Mesh.materials.",
    nodes="(elements, nodes of each) rows of Mesh.nodes, in the node order of gmsh; a view.",
)


class Part(typing.NamedTuple):
    """Measures of the elements of one part and one kind."""

    part: str
    kind: str
    material: str
    elements: int
    volume: float
    mass: float
    smallest_scaled_jacobian: float
    largest_aspect_ratio: float


describe(
    Part,
    part="Name of the part.",
    kind="Kind of its elements.",
    material="Name of its material.",
    elements="Number of elements.",
    volume="Volume, m^3.",
    mass="Mass, kg.",
    smallest_scaled_jacobian="Smallest scaled Jacobian of its elements, 1.",
    largest_aspect_ratio="Largest aspect ratio of its elements, 1.",
)


class Mesh:
    """A mesh with its materials and sets, from Study.mesh() or Mesh.read()."""

    def __init__(self, data: typing.Any, study: Study | None, folder: Folder | None) -> None:
        self._data = data
        self._study = None if study is None else study.copy()
        self._folder = folder

    @staticmethod
    def read(path: Path) -> Mesh:
        """Reads a mesh from a file mesh.h5. Its modes cannot be computed; use Study.mesh() for
        that."""
        return Mesh(_core.read_mesh(str(path)), None, None)

    @property
    def nodes(self) -> npt.NDArray[np.float64]:
        """Positions of the nodes, (k, 3), m, in the frame of the geometry; a view."""
        return typing.cast("npt.NDArray[np.float64]", self._data.nodes)

    @property
    def blocks(self) -> list[ElementBlock]:
        """Elements, one block per part and kind."""
        return [ElementBlock(*each) for each in self._data.blocks]

    @property
    def node_sets(self) -> dict[str, npt.NDArray[np.int32]]:
        """Node sets by name: (nodes,) rows of `nodes`, ascending; views."""
        return dict(self._data.node_sets)

    @property
    def materials(self) -> list[Material]:
        """Materials, in the order to which blocks refer."""
        return [Material(*each) for each in self._data.materials]

    @property
    def parts(self) -> list[Part]:
        """Volume, mass and quality of each block."""
        return [Part(*each) for each in self._data.parts]

    @property
    def mass(self) -> float:
        """Mass of the mesh, kg."""
        return float(sum(part.mass for part in self.parts))

    def modes(self, count: int | None = None, sensitivity: bool = False,
              settings: typing.Mapping[str, typing.Any] | None = None) -> ModalBody:
        """Vibration modes of the mesh, as `flexneck modes` does.

        count: number of elastic modes; default: that of the study.
        sensitivity: also compute sensitivities to all dimensions and material constants, in the
            file sensitivities.json of the folder.
        settings: further values of [modes] of the study, such as {"modes.check": True}.
        """
        study, folder = self._require("modes")
        more = dict(settings or {})
        if count is not None:
            more["modes.count"] = count
        for key, value in more.items():
            study.set(key, value)
        execute("modes", folder, [study.file], study.settings, sensitivity=sensitivity)
        return ModalBody(_core.read_body(folder.file("modes.h5")), study, folder,
                         folder.file("modes.h5"))

    def export(self, path: Path) -> None:
        """Writes the mesh in the format given by the extension of the file, as `flexneck export`
        does: .msh, .inp, .mtx, .petsc."""
        study, folder = self._require("exports")
        execute("export", folder, [study.file], study.settings, target=str(path))

    def write(self, path: Path) -> None:
        """Writes the file that read() reads, identical to mesh.h5 of the folder."""
        _, folder = self._require("files")
        shutil.copyfile(folder.file("mesh.h5"), path)

    @property
    def folder(self) -> pathlib.Path | None:
        """The folder of results; None for a mesh that was read from a file."""
        return None if self._folder is None else self._folder.path

    def _require(self, what: str) -> tuple[Study, Folder]:
        if self._study is None or self._folder is None:
            raise InputError(f"this mesh was read from a file and has no {what}; make it with "
                             "Study.mesh()")
        return self._study.copy(), self._folder

    def __repr__(self) -> str:
        return f"<Mesh: {len(self.nodes)} nodes, {sum(part.elements for part in self.parts)} elements>"
