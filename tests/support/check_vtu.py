# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads each .vtu of a folder with VTK and with meshio: python3 check_vtu.py FOLDER VOLUME

Fails unless they find the same points, the volume, and in the vectors "place", which are the points' own, the
gradient that is the identity in every cell: nodes in another order have another. Exit code 77 without either.
"""
import sys
from pathlib import Path

try:
    import meshio
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkFiltersGeneral import vtkGradientFilter
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError as error:
    print(error)
    sys.exit(77)

# Element kinds that meshio 7 has no cell type for.
UNKNOWN_TO_MESHIO = {"prism15", "pyramid13", "pyramid14"}
# Corners of tetrahedra that fill a cell with flat sides, by its type.
HEXAHEDRON = [(0, 1, 3, 4), (1, 2, 3, 6), (1, 4, 5, 6), (3, 4, 6, 7), (1, 3, 4, 6)]
WEDGE = [(0, 1, 2, 3), (1, 2, 3, 4), (2, 3, 4, 5)]
PYRAMID = [(0, 1, 2, 4), (0, 2, 3, 4)]
TETRAHEDRA = {12: HEXAHEDRON, 25: HEXAHEDRON, 29: HEXAHEDRON, 13: WEDGE, 26: WEDGE, 32: WEDGE,
              14: PYRAMID, 27: PYRAMID, 10: [(0, 1, 2, 3)], 24: [(0, 1, 2, 3)]}


def volume_of(cell):
    at = vtk_to_numpy(cell.GetPoints().GetData())
    return sum(abs(np.linalg.det(at[list(corners[1:])] - at[corners[0]])) / 6
               for corners in TETRAHEDRA[cell.GetCellType()])


folder, volume = Path(sys.argv[1]), float(sys.argv[2])
files = sorted(folder.glob("*.vtu"))
assert files
for path in files:
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    assert reader.GetErrorCode() == 0 and grid.GetNumberOfCells() > 0, path
    found = sum(volume_of(grid.GetCell(k)) for k in range(grid.GetNumberOfCells()))
    assert abs(found / volume - 1) < 1e-9, (path, found, volume)

    gradients = vtkGradientFilter()
    gradients.SetInputData(grid)
    gradients.SetInputArrayToProcess(0, 0, 0, 0, "place")
    gradients.SetResultArrayName("gradient")
    gradients.Update()
    used = np.unique(vtk_to_numpy(grid.GetCells().GetConnectivityArray()))
    gradient = vtk_to_numpy(gradients.GetOutput().GetPointData().GetArray("gradient"))[used]
    gradient = gradient.reshape(-1, 3, 3)
    found = ~np.isnan(gradient).any(axis=(1, 2))  # a pyramid's functions have none at the apex
    assert found.all() or (path.stem.startswith("pyramid") and found.mean() > 0.7), path
    assert abs(gradient[found] - np.eye(3)).max() < 1e-6, (path, gradient)

    if path.stem in UNKNOWN_TO_MESHIO:
        continue
    other = meshio.read(path)
    points = vtk_to_numpy(grid.GetPoints().GetData())
    assert (other.points == points).all() and (other.point_data["place"] == points).all(), path
    assert sum(len(block.data) for block in other.cells) == grid.GetNumberOfCells(), path
    materials = np.concatenate(other.cell_data["material"])
    assert (materials == vtk_to_numpy(grid.GetCellData().GetArray("material"))).all(), path
