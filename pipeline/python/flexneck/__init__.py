# SPDX-License-Identifier: GPL-3.0-or-later
"""flexneck: from the geometry of a crash-test dummy's neck to its motion.

    import flexneck as fn
    study = fn.Study("hybrid3").set("geometry.plate_thickness", "0.4 in")
    body = study.mesh().modes(count=10)
    run = body.pendulum("flexion-120")
    plt.plot(run.time, run["head rotation"].to("deg"))

All numbers are in SI units unless a name says otherwise. Arrays are read-only views on the
program's own memory; n is the number of output times, m of modes, k of nodes. What the command
`flexneck` does with a study or a model is done here by the same code: files have the same bytes.

Importing starts neither MPI nor PETSc. They start with the first mesh or modes and end with the
interpreter. Computations let other Python threads run, and Ctrl-C stops them.
"""

from ._core import __version__, git_hash
from .body import Interface, ModalBody
from .errors import (ComputationError, Error, IncompleteRunError, InputError, ResultWarning,
                     VerificationWarning)
from .mesh import ElementBlock, Material, Mesh, Part
from .model import Model
from .rating import cora, factor, iso18571, nij, quantity
from .results import Results, Table, VerificationRow
from .run import Channel, JointLoads, MarkerMotion, Run, SmallMotion
from .study import Study, shipped_names
from .values import Value

__all__ = [
    "Channel", "ComputationError", "ElementBlock", "Error", "IncompleteRunError", "InputError",
    "Interface", "JointLoads", "MarkerMotion", "Material", "Mesh", "ModalBody", "Model", "Part",
    "ResultWarning", "Results", "Run", "SmallMotion", "Study", "Table", "Value",
    "VerificationRow", "VerificationWarning", "__version__", "cora", "factor", "git_hash",
    "iso18571", "nij", "quantity", "shipped_names",
]
