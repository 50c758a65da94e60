"""What a sweep found, as arrays."""

from __future__ import annotations

import html
from collections.abc import Mapping
from functools import cached_property
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _hyperstat
from ._hyperstat import Found

Array = npt.NDArray[np.float64]

_COORDINATES = ("x", "y", "z", "rx", "ry", "rz")
_DISPLACEMENT = ("dx", "dy", "dz", "drx", "dry", "drz")


class CaseTable:
    """What a load case does at every pose.

    Attributes
    ----------
    displacement : (n, 6) ndarray
        Of the output [m, rad], global.
    """

    def __init__(self, name: str, displacement: Array) -> None:
        self.name = name
        self.displacement = displacement

    def __repr__(self) -> str:
        return f"<hyperstat.CaseTable {self.name!r}: {len(self.displacement)} rows>"


class Table:
    """What a sweep found: a row a pose.

    `table["dz"]` is a column by its name in the command line's tables (`x`, `dz`, `k11`, ...).

    Attributes
    ----------
    pose : (n, 6) ndarray
        Of the output: x, y, z [m], rotation vector rx, ry, rz [rad].
    stiffness : (n, 6, 6) ndarray
        Of the output [N/m, N/rad; N, N·m/rad], global.
    displacement : (n, 6) ndarray
        Of the output under the loads [m, rad], global.
    status : (n,) ndarray of str
        `ok`, or why there is no result; the numbers are then NaN.
    cases : dict of CaseTable
        Load cases by name.
    drives : dict of (n,) ndarray
        Values of the drives that the poses are, by `joint.direction`.
    further : dict
        Columns that were asked for, by name.
    why : dict of str
        Of every status but `ok` why its first row has no result.
    """

    def __init__(self, found: Found) -> None:
        self.pose: Array = found.pose
        self.stiffness: Array = found.stiffness
        self.displacement: Array = found.displacement
        self.designs = found.designs
        self._codes = found.codes
        self._words = [word for word, _ in found.words]
        self.why: dict[str, str] = {word: why for word, why in found.words if why is not None}
        columns: list[tuple[str, Any]] = [
            (name, own if isinstance(own, np.ndarray) else np.array(own, dtype=object))
            for name, own in found.further
        ]
        names, values = found.drives
        self.drives: dict[str, Array] = {name: values[:, k] for k, name in enumerate(names)}
        known = 6 * len(found.cases)
        self.cases: dict[str, CaseTable] = {
            name: CaseTable(name, np.stack([own for _, own in columns[6 * k : 6 * k + 6]], axis=1))
            for k, name in enumerate(found.cases)
        }
        self.further: dict[str, Any] = dict(columns[known:])
        self._all = dict(columns)

    @cached_property
    def status(self) -> npt.NDArray[np.str_]:
        """`ok`, or a word that says why a row has no result; shape (n,)."""
        return np.array(self._words)[self._codes]

    @cached_property
    def ok(self) -> npt.NDArray[np.bool_]:
        """Which rows have a result; shape (n,)."""
        result: npt.NDArray[np.bool_] = self._codes == 0
        return result

    @cached_property
    def compliance(self) -> Array:
        """Inverse of the stiffness [m/N, 1/N; rad/N, rad/(N·m)]; shape (n, 6, 6), NaN where there is none."""
        c = np.full_like(self.stiffness, np.nan)
        for row in np.flatnonzero(self.ok):
            k = self.stiffness[row]
            scale = np.sqrt(np.abs(np.diag(k)))
            try:
                c[row] = np.linalg.inv(k / np.outer(scale, scale)) / np.outer(scale, scale)
            except np.linalg.LinAlgError:
                pass
        return c

    def measure(self, name: str, case: Optional[str] = None) -> Array:
        """A measure at every pose.

        Parameters
        ----------
        name : str
            Of `hyperstat.measures()`, such as `deflection` or `softest_force`, or a column.
        case : str, optional
            The case whose displacement it is of.

        Returns
        -------
        (n,) ndarray
            SI; NaN without a result.
        """
        if name in self:
            return np.asarray(self[name], dtype=np.float64)
        displacement = self.displacement if case is None else self.cases[case].displacement
        return _hyperstat.measure(name, self.stiffness, displacement)

    def by_design(self, rows: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Rows as designs and poses: of (d·n, ...) an array (d, n, ...)."""
        return rows.reshape(self.designs, -1, *rows.shape[1:])

    # Columns by name.

    @property
    def columns(self) -> list[str]:
        """Names of the columns, as in the command line's table after `pose`."""
        stiffness = [f"k{r}{c}" for r in range(1, 7) for c in range(r, 7)]
        return [*_COORDINATES, "status", *_DISPLACEMENT, *stiffness, *self._all, *self.drives]

    def __getitem__(self, name: str) -> Any:
        if name == "status":
            return self.status
        if name in _COORDINATES:
            return self.pose[:, _COORDINATES.index(name)]
        if name in _DISPLACEMENT:
            return self.displacement[:, _DISPLACEMENT.index(name)]
        if len(name) == 3 and name[0] == "k" and set(name[1:]) <= set("123456"):
            return self.stiffness[:, int(name[1]) - 1, int(name[2]) - 1]
        if name in self._all:
            return self._all[name]
        if name in self.drives:
            return self.drives[name]
        raise KeyError(name)

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def keys(self) -> list[str]:
        """Names of the columns."""
        return self.columns

    def __len__(self) -> int:
        """Number of rows."""
        return len(self._codes)

    # Tables of others.

    def to_pandas(self) -> Any:
        """A `pandas.DataFrame` with the columns of the command line's table."""
        import pandas

        return pandas.DataFrame({name: self[name] for name in self.columns})

    def to_arrow(self) -> Any:
        """A `pyarrow.Table` with the columns of the command line's table, units in their metadata."""
        import pyarrow

        columns = {name: pyarrow.array(self[name], from_pandas=True) for name in self.columns}
        fields = [
            pyarrow.field(name, own.type, metadata={"unit": _hyperstat.column(name)[0]})
            for name, own in columns.items()
        ]
        return pyarrow.table(list(columns.values()), schema=pyarrow.schema(fields))

    def to_xarray(self) -> Any:
        """An `xarray.Dataset`: dimension `row`, matrices over `i` and `j`, vectors over `i`."""
        import xarray

        axes = {"i": list(_COORDINATES), "j": list(_COORDINATES)}
        found: dict[str, Any] = {
            "pose": (("row", "i"), self.pose),
            "status": ("row", self.status),
            "displacement": (("row", "i"), self.displacement, {"unit": "m, rad"}),
            "stiffness": (
                ("row", "i", "j"),
                self.stiffness,
                {"unit": "N/m, N/rad; N, N·m/rad"},
            ),
        }
        for name, case in self.cases.items():
            found[f"{name}.displacement"] = (("row", "i"), case.displacement, {"unit": "m, rad"})
        for name, own in {**self.further, **self.drives}.items():
            found[name] = ("row", own, {"unit": _hyperstat.column(name)[0]})
        return xarray.Dataset(found, coords=axes)

    def plot_map(
        self,
        quantity: str = "deflection",
        *,
        case: Optional[str] = None,
        plane: Optional[Mapping[str, float]] = None,
        log: bool = False,
        ax: Any = None,
    ) -> Any:
        """A map of a quantity over the two coordinates that vary, with matplotlib.

        Parameters
        ----------
        quantity : str
            A measure or a column.
        case : str, optional
            The case whose displacement it is of.
        plane : mapping, optional
            Coordinates that are held, such as `{"z": 0.5}`: rows elsewhere are left out.
        log : bool
            Colours by the logarithm.
        ax : Axes, optional

        Returns
        -------
        Axes
        """
        from ._plots import over_plane

        return over_plane(self, quantity, case, plane or {}, log, ax)

    def _count(self) -> str:
        words, counts = np.unique(self.status, return_counts=True)
        return ", ".join(f"{count} {word}" for word, count in zip(words, counts))

    def __repr__(self) -> str:
        more = [*self.cases, *self.further, *self.drives]
        also = f"; also {', '.join(more[:8])}{', ...' if len(more) > 8 else ''}" if more else ""
        return f"<hyperstat.Table of {len(self)} poses: {self._count()}{also}>"

    def _repr_html_(self) -> str:
        shown = [*_COORDINATES, "status", *_DISPLACEMENT, "k11", "k22", "k33"]
        head = "".join(f"<th>{name}</th>" for name in shown)

        def cell(value: Any) -> str:
            return str(value) if isinstance(value, str) else f"{value:.6g}"

        rows = "".join(
            "<tr>" + "".join(f"<td>{cell(self[name][row])}</td>" for name in shown) + "</tr>"
            for row in range(min(len(self), 5))
        )
        title = html.escape(repr(self)[1:-1])
        return f"<table><caption>{title}</caption><tr>{head}</tr>{rows}</table>"
