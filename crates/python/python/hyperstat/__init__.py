"""How stiff a parallel robot is: the core of hyperstat in Python.

A mechanism is read from a file (`load`), from a text or a dict (`Mechanism`), or is one of the prebuilt
ones (`Delta`, `Hexapod`, ...). It answers questions (`Mechanism.solve`), goes through arrays of poses
(`Mechanism.sweep`), takes other values (`Mechanism.with_values`) and single poses (`Mechanism.at`).

SI units throughout: m, N, rad, kg, s. Vectors are in the global frame. A wrench or displacement lists the
linear part first. An orientation is a rotation vector from the mechanism's home orientation.

Whatever is wrong is an `Error` with `.message`, `.place`, `.help` and `.code`.

>>> import hyperstat as hs
>>> m = hs.load("examples/portal.ron")
>>> m.solve().stiffness.shape
(6, 6)
"""

import os as _os

from . import dask, parts
from ._choose import Choice, choose_poses
from ._errors import (
    ArgumentError,
    Error,
    InputError,
    InternalError,
    MissingError,
    Place,
    PoseError,
    RunError,
    SelectionError,
    UnsolvableError,
)
from ._hyperstat import Pose, __version__, after_fork, before_fork
from ._identify import Identification, identify
from ._information import Indistinct, Information, information
from ._joints import JointKind
from ._mechanism import Mechanism, load, measures, schema
from ._solution import CaseResult, JointResult, Solution
from ._table import CaseTable, Table
from ._view import View, view
from .parts import *  # noqa: F403

# A process that is forked while other threads compute finds nothing half made.
if hasattr(_os, "register_at_fork"):
    _os.register_at_fork(before=before_fork, after_in_parent=after_fork, after_in_child=after_fork)
del after_fork, before_fork

__all__ = [
    "ArgumentError",
    "CaseResult",
    "CaseTable",
    "Choice",
    "Error",
    "Identification",
    "Indistinct",
    "Information",
    "InputError",
    "InternalError",
    "JointKind",
    "JointResult",
    "Mechanism",
    "MissingError",
    "Place",
    "Pose",
    "PoseError",
    "RunError",
    "SelectionError",
    "Solution",
    "Table",
    "UnsolvableError",
    "View",
    "__version__",
    "choose_poses",
    "dask",
    "identify",
    "information",
    "load",
    "measures",
    "parts",
    "schema",
    "view",
    *parts.__all__,
]
