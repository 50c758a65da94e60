"""What a sweep found, as arrays."""

from __future__ import annotations

import html
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _hyperstat
from ._errors import ArgumentError, unknown
from ._hyperstat import Found

Array = npt.NDArray[np.float64]

_COORDINATES = ("x", "y", "z", "rx", "ry", "rz")
_DISPLACEMENT = ("dx", "dy", "dz", "drx", "dry", "drz")
# The columns that hold words, of the cases too.
_WORDS = ("stress_at", "utilisation_at")


class Cases(dict[str, "CaseTable"]):
    """Load cases by name."""

    def __missing__(self, name: str) -> CaseTable:
        raise unknown("case", name, self, "unknown-case")


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
    varied : dict
        Of `Mechanism.evaluate` and of a job that varies: `design`, the number of the design from 0, and its
        values by path.
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
            (name, _column(name, own)) for name, own in found.further
        ]
        names, values = found.drives
        self.drives: dict[str, Array] = {name: values[:, k] for k, name in enumerate(names)}
        known = 6 * len(found.cases)
        self.cases: dict[str, CaseTable] = Cases(
            (name, CaseTable(name, np.stack([own for _, own in columns[6 * k : 6 * k + 6]], axis=1)))
            for k, name in enumerate(found.cases)
        )
        self.further: dict[str, Any] = dict(columns[known:])
        self._all = dict(columns)
        each = len(self) // max(self.designs, 1)
        self.varied: dict[str, Any] = {}
        first, varied = found.varied
        if varied:
            self.varied["design"] = np.repeat(np.arange(first, first + self.designs), each)
        for path, given in varied:
            texts = any(isinstance(value, str) for value in given)
            own = np.array(given, dtype=object if texts else np.float64)
            self.varied[path] = np.repeat(own, each)

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
            The case whose displacement it is of; of a column the case's, `push.stress`.

        Returns
        -------
        (n,) ndarray
            SI; NaN without a result.

        Raises
        ------
        ArgumentError
            Neither a measure nor a column of numbers, or not one of a case.
        SelectionError
            There is no such case.
        """
        if not isinstance(name, str):
            raise ArgumentError(f"`{name!r}` is no measure", help="give its name")
        if case is None:
            if self._has(name):
                return self._numbers(name)
            return _hyperstat.measure(name, self.stiffness, self.displacement)
        displacement = self.cases[case].displacement
        if name in _DISPLACEMENT:
            return displacement[:, _DISPLACEMENT.index(name)]
        if f"{case}.{name}" in self._all:
            return self._numbers(f"{case}.{name}")
        if name in _measures():
            return _hyperstat.measure(name, self.stiffness, displacement)
        # These are of the mechanism, whatever loads it.
        if name in _COORDINATES or name in self.drives or name in self.varied or _entry(name):
            return self._numbers(name)
        if self._has(name):
            raise ArgumentError(
                f"the column `{name}` is not of a case", help="leave `case` out, or give a measure"
            )
        return _hyperstat.measure(name, self.stiffness, displacement)

    def _has(self, name: str) -> bool:
        return name in self or _entry(name) is not None

    def _numbers(self, name: str) -> Array:
        """A column that holds numbers."""
        own = np.asarray(self[name])
        if own.dtype.kind not in "fiu":
            raise ArgumentError(f"the column `{name}` holds words", help="give one of numbers, or a measure")
        return own.astype(np.float64)

    def by_design(self, rows: npt.NDArray[Any]) -> npt.NDArray[Any]:
        """Rows as designs and poses: of (d·n, ...) an array (d, n, ...)."""
        return rows.reshape(self.designs, -1, *rows.shape[1:])

    # Columns by name.

    @property
    def columns(self) -> list[str]:
        """Names of the columns, as in the command line's table after `pose`."""
        stiffness = [f"k{r}{c}" for r in range(1, 7) for c in range(r, 7)]
        own = [*_COORDINATES, "status", *_DISPLACEMENT, *stiffness, *self._all, *self.drives]
        return own + list(self.varied)

    def __getitem__(self, name: str) -> Any:
        if name == "status":
            return self.status
        if name in _COORDINATES:
            return self.pose[:, _COORDINATES.index(name)]
        if name in _DISPLACEMENT:
            return self.displacement[:, _DISPLACEMENT.index(name)]
        entry = _entry(name)
        if entry is not None:
            return self.stiffness[:, entry[0], entry[1]]
        for columns in (self._all, self.drives, self.varied):
            if name in columns:
                return columns[name]
        raise unknown("column", name, self.columns, "unknown-column")

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
        for name, own in {**self.further, **self.drives, **self.varied}.items():
            found[name] = ("row", own, {"unit": _hyperstat.column(name)[0]})
        return xarray.Dataset(found, coords=axes)

    def plot_map(
        self,
        quantity: str = "deflection",
        *,
        case: Optional[str] = None,
        design: Optional[int] = None,
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
            The case whose displacement it is of, as of `measure`.
        design : int, optional
            Of several designs the one that is drawn, from 0.
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

        return over_plane(self, quantity, case, design, plane or {}, log, ax)

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


def joined(tables: Sequence[Table]) -> Table:
    """Tables of the rows of one sweep, in their order."""
    first = tables[0]
    whole = Table.__new__(Table)
    for name in ("pose", "stiffness", "displacement"):
        setattr(whole, name, np.concatenate([getattr(own, name) for own in tables]))
    whole.designs = first.designs
    # Words are numbered as their first rows come.
    words = dict.fromkeys(word for own in tables for word in own._words)
    whole._words = list(words)
    numbers = {word: number for number, word in enumerate(words)}
    codes = [np.array([numbers[word] for word in own._words], dtype=np.uint8)[own._codes] for own in tables]
    whole._codes = np.concatenate(codes)
    whole.why = {word: why for own in reversed(tables) for word, why in own.why.items()}
    whole.why = {word: whole.why[word] for word in words if word in whole.why}
    for name in ("_all", "drives", "varied"):
        columns = {key: np.concatenate([getattr(own, name)[key] for own in tables]) for key in getattr(first, name)}
        setattr(whole, name, columns)
    whole.further = {name: whole._all[name] for name in first.further}
    whole.cases = Cases(
        (name, CaseTable(name, np.concatenate([own.cases[name].displacement for own in tables])))
        for name in first.cases
    )
    return whole


def _column(name: str, own: Any) -> Any:
    """A further column; words even where no row has one."""
    if not isinstance(own, np.ndarray):
        return np.array(own, dtype=object)
    if name.rsplit(".", 1)[-1] in _WORDS and np.isnan(own).all():
        return np.full(len(own), None, dtype=object)
    return own


def _entry(name: str) -> Optional[tuple[int, int]]:
    """Row and column, from 0, of an entry of the stiffness, `k11` to `k66`."""
    if isinstance(name, str) and len(name) == 3 and name[0] == "k" and set(name[1:]) <= set("123456"):
        return int(name[1]) - 1, int(name[2]) - 1
    return None


def _measures() -> set[str]:
    return {name for name, _, _ in _hyperstat.measures()}
