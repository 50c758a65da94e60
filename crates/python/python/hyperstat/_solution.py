"""What one solve found."""

from __future__ import annotations

import html
import json
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, Optional, TypeVar

import numpy as np
import numpy.typing as npt

from ._errors import unknown

if TYPE_CHECKING:
    from ._mechanism import Mechanism

Array = npt.NDArray[np.float64]
T = TypeVar("T")


class Named(Mapping[str, T], Generic[T]):
    """Results by name, each made when it is asked for."""

    def __init__(self, found: Mapping[str, Any], make: Callable[[str, Any], T], what: str) -> None:
        self._found = found
        self._make = make
        self._what = what

    def __getitem__(self, name: str) -> T:
        if name not in self._found:
            raise unknown(self._what, name, self._found, f"unknown-{self._what}")
        return self._make(name, self._found[name])

    def __iter__(self) -> Iterator[str]:
        return iter(self._found)

    def __len__(self) -> int:
        return len(self._found)

    def __repr__(self) -> str:
        return f"<{len(self)} by name: {', '.join(self._found)}>"


class JointResult:
    """What a joint carries.

    Attributes
    ----------
    name : str
    wrench : (6,) ndarray
        On the second body of `between`, at the joint, in the joint frame [N, N·m]; NaN where redundant
        rigid constraints leave it undetermined.
    data : dict
        All that the JSON has of it.
    """

    def __init__(self, name: str, found: Mapping[str, Any]) -> None:
        self.name = name
        self.data = dict(found)
        wrench = found.get("wrench")
        self.wrench: Array = np.full(6, np.nan) if wrench is None else np.array(wrench, dtype=np.float64)

    def __repr__(self) -> str:
        return f"<hyperstat.JointResult {self.name!r} wrench={self.wrench}>"


class State:
    """What the loads do, or those of a case.

    Attributes
    ----------
    displacement : (6,) ndarray
        Of the output: x, y, z [m], rx, ry, rz [rad], global.
    displacements : mapping of (6,) ndarray
        Of the nodes, by `body.point`.
    joints : mapping of JointResult
    bodies, segments
        As the JSON has them.
    """

    def __init__(self, found: Mapping[str, Any]) -> None:
        self._found = found

    @cached_property
    def displacement(self) -> Array:
        """Displacement of the output: x, y, z [m], rx, ry, rz [rad], global; shape (6,)."""
        return np.array(self._found["output"]["displacement"], dtype=np.float64)

    @cached_property
    def displacements(self) -> Mapping[str, Array]:
        """Displacements of the nodes [m, rad], global, by `body.point`; shape (6,) each."""
        return Named(self._found["displacements"], _vector, "node")

    @cached_property
    def joints(self) -> Mapping[str, JointResult]:
        """Joints by name."""
        return Named(self._found["joints"], JointResult, "joint")

    @property
    def bodies(self) -> dict[str, Any]:
        """Bodies by name, with their worst points, as the JSON has them."""
        bodies: dict[str, Any] = self._found["bodies"]
        return bodies

    @property
    def segments(self) -> list[dict[str, Any]]:
        """Beam segments with their forces [N, N·m] and stresses [Pa], as the JSON has them."""
        segments: list[dict[str, Any]] = self._found["segments"]
        return segments


class CaseResult(State):
    """A load case."""

    def __init__(self, name: str, found: Mapping[str, Any]) -> None:
        super().__init__(found)
        self.name = name

    def __repr__(self) -> str:
        return f"<hyperstat.CaseResult {self.name!r} displacement={self.displacement}>"


class Solution(State):
    """What one solve found: everything that `hyperstat solve` tells.

    Attributes
    ----------
    stiffness, compliance : (6, 6) ndarray
        Of the output [N/m, N/rad; N, N·m/rad] and [m/N, 1/N; rad/N, rad/(N·m)], global; NaN where it is
        held rigidly in some direction, or moves freely.
    displacement : (6,) ndarray
        Of the output under the loads [m, rad], global.
    displacements : mapping
        Of the nodes, by `body.point`.
    joints : mapping
        Joints by name, with their wrenches.
    cases : mapping
        Load cases by name, with the same.
    warnings : list of str
    """

    def __init__(self, text: str, mechanism: Mechanism) -> None:
        super().__init__(json.loads(text))
        self._mechanism = mechanism

    @cached_property
    def stiffness(self) -> Array:
        """Stiffness of the output [N/m, N/rad; N, N·m/rad], global; shape (6, 6)."""
        return _matrix(self._found["output"]["stiffness"])

    @cached_property
    def compliance(self) -> Array:
        """Compliance of the output [m/N, 1/N; rad/N, rad/(N·m)], global; shape (6, 6)."""
        return _matrix(self._found["output"]["compliance"])

    @cached_property
    def cases(self) -> Mapping[str, CaseResult]:
        """Load cases by name."""
        return Named(self._found.get("cases", {}), CaseResult, "case")

    @property
    def name(self) -> str:
        """Name of the mechanism."""
        return str(self._found["name"])

    @property
    def unknowns(self) -> int:
        """Independent displacement coordinates that were solved for."""
        return int(self._found["unknowns"])

    @property
    def mobility(self) -> int:
        """Instantaneous freedoms of the rigid mechanism."""
        return int(self._found["mobility"])

    @property
    def overconstraint(self) -> int:
        """Redundant constraints."""
        return int(self._found["overconstraint"])

    @property
    def idle_modes(self) -> int:
        """Motions without energy that leave the output where it is."""
        return int(self._found["idle_modes"])

    @property
    def warnings(self) -> list[str]:
        """Remarks on the numbers and on what can hardly be meant."""
        return list(self._found["warnings"])

    @cached_property
    def frequencies(self) -> Array:
        """Natural frequencies that were asked for [Hz], ascending; shape (k,)."""
        modes = self._found.get("modes") or []
        return np.array([mode["frequency"] for mode in modes], dtype=np.float64)

    def to_dict(self) -> dict[str, Any]:
        """The JSON of `hyperstat solve --format json`, as a dict of its own."""
        return dict(json.loads(json.dumps(self._found)))

    def __getitem__(self, field: str) -> Any:
        """A field of the JSON."""
        return self._found[field]

    def plot(self, ax: Any = None, *, scale: Optional[float] = None) -> Any:
        """Draws the mechanism, undeformed and deformed, with matplotlib.

        Parameters
        ----------
        ax : Axes3D, optional
        scale : float, optional
            Of displacements; left out, the largest is a tenth of the mechanism's size.

        Returns
        -------
        Axes3D
        """
        from ._plots import deformed

        return deformed(self._mechanism._core.vtu(), self.name, ax, scale)

    def to_pyvista(self) -> Any:
        """The mechanism and its results as an unstructured grid of pyvista."""
        from ._plots import pyvista_grid

        return pyvista_grid(self._mechanism._core.vtu())

    def __repr__(self) -> str:
        return (
            f"<hyperstat.Solution {self.name!r}: mobility {self.mobility}, over-constraint "
            f"{self.overconstraint}, displacement {self.displacement}>"
        )

    def _repr_html_(self) -> str:
        title = f"<b>{html.escape(self.name)}</b>"
        k = self.stiffness
        if not np.isfinite(k).all():
            return title + "<p>held rigidly in some direction</p>"
        head = "".join(f"<th>{own}</th>" for own in ("Δx", "Δy", "Δz", "φx", "φy", "φz"))
        names = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
        rows = "".join(
            f"<tr><th>{name}</th>{''.join(f'<td>{own:.6g}</td>' for own in row)}</tr>"
            for name, row in zip(names, k)
        )
        unit = "stiffness [N/m, N/rad; N, N·m/rad]"
        return f"{title}<table><caption>{unit}</caption><tr><th></th>{head}</tr>{rows}</table>"


def _matrix(rows: Any) -> Array:
    return np.full((6, 6), np.nan) if rows is None else np.array(rows, dtype=np.float64)


def _vector(_: str, own: Any) -> Array:
    return np.array(own, dtype=np.float64)
