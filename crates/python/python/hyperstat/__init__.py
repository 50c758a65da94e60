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

from . import parts
from ._errors import (
    ArgumentError,
    Error,
    InputError,
    InternalError,
    Place,
    PoseError,
    SelectionError,
    UnsolvableError,
)
from ._hyperstat import Pose, __version__
from ._mechanism import Mechanism, load, measures, schema
from ._solution import CaseResult, JointResult, Solution
from ._table import CaseTable, Table
from .parts import *  # noqa: F403

__all__ = [
    "ArgumentError",
    "CaseResult",
    "CaseTable",
    "Error",
    "InputError",
    "InternalError",
    "JointResult",
    "Mechanism",
    "Place",
    "Pose",
    "PoseError",
    "SelectionError",
    "Solution",
    "Table",
    "UnsolvableError",
    "__version__",
    "load",
    "measures",
    "parts",
    "schema",
    *parts.__all__,
]
