"""What deflections tell of values of a mechanism: how well these are known, and what cannot be told apart."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from ._errors import ArgumentError, Error, PoseError, unknown
from ._mechanism import Mechanism, threads_of
from ._poses import Poses, columns_of
from ._table import _DISPLACEMENT

Array = npt.NDArray[np.float64]

# A combination of values shows in nothing where it shows so little beside that which shows most: derivatives
# are good to 1e-8.
NULL = 1e-7
# Part of a combination that is named, beside the largest.
_NAMED = 0.05


@dataclass(frozen=True, eq=False)
class Indistinct:
    """A combination of values that what is measured tells too little of.

    Attributes
    ----------
    weights : dict of float
        Relative changes by path, the largest 1, that together hardly show.
    error : float
        Relative standard error of the combination; infinite where it shows in nothing.
    """

    weights: dict[str, float]
    error: float

    def __str__(self) -> str:
        named = {path: own for path, own in self.weights.items() if abs(own) >= _NAMED}
        if len(named) == 1:
            (path,) = named
            if np.isinf(self.error):
                return f"`{path}` shows in nothing that is measured"
            return f"`{path}` hardly shows: it is known to {self.error:.0%}"
        parts = ", ".join(f"{own:+.3g} % of `{path}`" for path, own in named.items())
        if np.isinf(self.error):
            return f"{parts}: together this changes nothing that is measured"
        return f"{parts}: together this hardly shows, it is known to {self.error:.0%}"


@dataclass(frozen=True, eq=False)
class Information:
    """What deflections in some poses tell of some values.

    Attributes
    ----------
    paths : tuple of str
    values : (p,) ndarray
        SI.
    sensitivity : (N, p) ndarray
        Of each deflection, over its standard deviation, by the relative change of each value.
    standard_errors : (p,) ndarray
        Of the values, SI; infinite of those that belong to a combination that shows in nothing.
    covariance : (p, p) ndarray
        Of the values, SI.
    indistinct : list of Indistinct
        What cannot be told apart, the worst first.
    """

    paths: tuple[str, ...]
    values: Array
    sensitivity: Array
    standard_errors: Array
    covariance: Array
    indistinct: list[Indistinct]

    @property
    def relative_errors(self) -> Array:
        """Standard errors over the values; shape (p,)."""
        own: Array = self.standard_errors / np.abs(self.values)
        return own

    @property
    def correlation(self) -> Array:
        """Covariance over the standard errors; shape (p, p)."""
        own: Array = self.covariance / np.outer(self.standard_errors, self.standard_errors)
        return own

    @property
    def singular_values(self) -> Array:
        """Of the sensitivity, descending: inverse of the relative standard errors of its combinations."""
        return np.asarray(np.linalg.svd(self.sensitivity, compute_uv=False), dtype=np.float64)

    @property
    def log_determinant(self) -> float:
        """Natural logarithm of the determinant of the information of the relative changes."""
        own = self.singular_values
        if len(own) < len(self.paths):
            return float("-inf")
        with np.errstate(divide="ignore"):
            return float(2.0 * np.log(own).sum())

    def _lines(self) -> Iterator[str]:
        wide = max(map(len, self.paths), default=0)
        for path, value, error in zip(self.paths, self.values, self.standard_errors):
            share = 100.0 * error / abs(value)
            known = f"± {error:.2g} ({share:.2g} %)" if np.isfinite(error) else "cannot be told"
            yield f"  {path:{wide}}  {value:.6g} {known}"
        for own in self.indistinct:
            yield f"  {own}"

    def __repr__(self) -> str:
        head = f"<hyperstat.Information: {len(self.sensitivity)} deflections, {len(self.paths)} values>"
        return "\n".join((head, *self._lines()))


def information(
    mechanism: Mechanism,
    paths: Sequence[str],
    poses: Optional[Poses] = None,
    *,
    loads: Optional[Sequence[Any]] = None,
    cases: Optional[Mapping[str, Sequence[Any]]] = None,
    columns: Sequence[str] = _DISPLACEMENT[:3],
    sigma: Optional[npt.ArrayLike] = None,
    clear: float = 0.5,
    threads: int = 0,
) -> Information:
    """What deflections in some poses would tell of some values, before anything is measured.

    Parameters
    ----------
    mechanism : Mechanism
        With the values as they are supposed to be.
    paths, poses, loads, sigma, clear, threads
        As of `identify`; without `sigma` errors are for deflections of standard deviation 1 (m or rad).
    cases : mapping, optional
        As of `Mechanism.sweep`; where the mechanism has cases, deflections in all of them are measured, else
        those under the loads.
    columns : sequence of str
        Which displacements are measured, of dx, dy, dz, drx, dry, drz.

    Returns
    -------
    Information
    """
    problem, blocks = planned(mechanism, paths, poses, loads, cases, columns, sigma, threads)
    if np.isnan(blocks).any():
        row = int(np.flatnonzero(np.isnan(blocks).any(axis=(1, 2)))[0])
        raise _unreached(row)
    s = blocks.reshape(-1, len(problem.paths))
    return known(problem.paths, problem.start, s, 1.0, clear)


class Problem:
    """Displacements of some poses and cases, and how they follow values."""

    def __init__(
        self,
        mechanism: Mechanism,
        paths: Sequence[str],
        poses: Optional[Poses],
        cases: list[Optional[str]],
        columns: list[str],
        start: Optional[Mapping[str, float]],
        threads: int,
    ) -> None:
        if isinstance(paths, str):
            raise ArgumentError(f"`{paths}` is one path", help=f'give a list of paths, `["{paths}"]`')
        self.paths = tuple(paths)
        if not self.paths or not all(isinstance(path, str) for path in self.paths):
            raise ArgumentError("no paths", help="name values as `vary` does, such as `drive_stiffness`")
        if len(set(self.paths)) < len(self.paths):
            raise ArgumentError("a path that is named twice", help="name every value once")
        known = set(mechanism.cases)
        for case in cases:
            if case is not None and case not in known:
                raise unknown("case", case, known, "unknown-case")
        self.mechanism = mechanism
        given = None if poses is None else columns_of(poses)
        self.rows_known = mechanism.poses if given is None else len(given[1])
        self.poses: Optional[dict[str, Array]] = None
        if given is not None:
            self.poses = {name: given[1][:, place] for place, name in enumerate(given[0])}
        self.cases = cases
        self.columns = columns
        self.threads = threads_of(threads)
        own = dict(zip(self.paths, mechanism._core.numbers(list(self.paths))))
        for path, value in (start or {}).items():
            if path not in own:
                raise ArgumentError(f"`{path}` is not among the paths", help="start values that are sought")
            own[path] = float(value)
        self.start: Array = np.array(list(own.values()))
        for path, value in own.items():
            if value == 0.0 or not np.isfinite(value):
                raise ArgumentError(
                    f"`{path}` starts from {value}",
                    help="give what it may be, by `start`: values are sought over their size",
                )
        self.positive = self.start > 0.0

    # What is sought: logarithms over the start, or differences from it over its size.

    def values(self, x: Array) -> Array:
        own: Array = np.where(
            self.positive, self.start * np.exp(x * self.positive), self.start + np.abs(self.start) * x
        )
        return own

    def by_x(self, values: Array) -> Array:
        own: Array = np.where(self.positive, values, np.abs(self.start))
        return own

    def limits(self, bounds: Optional[Mapping[str, tuple[float, float]]]) -> tuple[Array, Array]:
        low, high = np.full(len(self.paths), -np.inf), np.full(len(self.paths), np.inf)
        for path, pair in (bounds or {}).items():
            if path not in self.paths:
                raise ArgumentError(f"`{path}` is not among the paths", help="bound values that are sought")
            place = self.paths.index(path)
            least, most = map(float, pair)
            if not least < most:
                raise ArgumentError(f"bounds {pair} of `{path}`", help="give the lower one first")
            begin = self.start[place]
            with np.errstate(divide="ignore"):
                ends = np.array([least, most])
                if self.positive[place]:
                    low[place], high[place] = np.log(np.maximum(ends, 0.0) / begin)
                else:
                    low[place], high[place] = (ends - begin) / abs(begin)
        return low, high

    def displacements(self, values: Array) -> Array:
        """In every case, pose and column."""
        own = self.mechanism.with_values(dict(zip(self.paths, values.tolist())))
        t = own.sweep(self.poses, threads=self.threads)
        places = [_DISPLACEMENT.index(name) for name in self.columns]
        each = [t.displacement if case is None else t.cases[case].displacement for case in self.cases]
        found = np.stack(each)[:, :, places]
        lost = np.flatnonzero(np.isnan(found).any(axis=(0, 2)))
        if len(lost):
            raise _unreached(int(lost[0]), t.why.get(str(t.status[lost[0]])))
        return found

    def sensitivity(self, values: Array) -> Array:
        """The same by every value; NaN of poses without a result."""
        own = self.mechanism.with_values(dict(zip(self.paths, values.tolist())))

        def of(case: Optional[str], name: str) -> Array:
            return own.value_and_gradient(
                name, self.paths, self.poses, case=case, threads=self.threads
            )[1]

        return np.stack([np.stack([of(case, name) for name in self.columns], axis=1) for case in self.cases])


def loaded(
    mechanism: Mechanism,
    loads: Optional[Sequence[Any]],
    cases: Optional[Mapping[str, Sequence[Any]]],
) -> Mechanism:
    if not isinstance(mechanism, Mechanism):
        raise ArgumentError(f"`{mechanism!r}` is no mechanism", help="give one, such as `hyperstat.load(path)`")
    if loads is None and cases is None:
        return mechanism
    return mechanism.with_loads(loads, cases=cases)


def planned(
    mechanism: Mechanism,
    paths: Sequence[str],
    poses: Optional[Poses],
    loads: Optional[Sequence[Any]],
    cases: Optional[Mapping[str, Sequence[Any]]],
    columns: Sequence[str],
    sigma: Optional[npt.ArrayLike],
    threads: int,
) -> tuple[Problem, Array]:
    """The sensitivity over the standard deviations, by relative changes, pose by pose: (n, cases·k, p)."""
    mechanism = loaded(mechanism, loads, cases)
    chosen = named(columns)
    cases_of: list[Optional[str]] = list(mechanism.cases) or [None]
    problem = Problem(mechanism, paths, poses, cases_of, chosen, None, threads)
    s = problem.sensitivity(problem.start)
    spread = spread_of(sigma, chosen, s.shape[1])
    s = s / spread[..., None] * np.abs(problem.start)
    return problem, s.transpose(1, 0, 2, 3).reshape(s.shape[1], -1, s.shape[3])


def named(columns: Sequence[str]) -> list[str]:
    own = [columns] if isinstance(columns, str) else list(columns)
    for name in own:
        if name not in _DISPLACEMENT:
            raise ArgumentError(f"`{name!r}` is no displacement", help="give dx, dy, dz, drx, dry or drz")
    if not own or len(set(own)) < len(own):
        raise ArgumentError("no columns, or one twice", help="give some of dx, dy, dz, drx, dry, drz")
    return own


def spread_of(sigma: Optional[npt.ArrayLike], columns: list[str], n: int) -> Array:
    """Standard deviations that stand beside (cases, n, k)."""
    if sigma is None:
        if len({name.startswith("dr") for name in columns}) > 1:
            raise ArgumentError(
                "translations and rotations without their standard deviations",
                help="give `sigma`, one for each column [m, rad]",
            )
        return np.ones((n, len(columns)))
    try:
        own = np.broadcast_to(np.asarray(sigma, dtype=np.float64), (n, len(columns)))
    except (TypeError, ValueError):
        raise ArgumentError(
            f"standard deviations of the shape {np.shape(sigma)}",
            help=f"give one, {len(columns)} for the columns, or ({n}, {len(columns)})",
        ) from None
    if not (np.isfinite(own).all() and (own > 0.0).all()):
        raise ArgumentError("a standard deviation that is not above zero", help="give those of the measurement")
    return own


def _unreached(row: int, why: Optional[str] = None) -> Error:
    return PoseError(
        f"pose {row} has no result{'' if why is None else f': {why}'}",
        code="pose",
        help="leave it out: `sweep` tells by `status` which poses have one",
    )


def known(paths: tuple[str, ...], values: Array, s: Array, spread: float, clear: float) -> Information:
    """What sensitivities tell; `spread` is the standard deviation of what they are of."""
    p = len(paths)
    _, singular, turned = np.linalg.svd(s, full_matrices=True)
    singular = np.concatenate([singular, np.zeros(p - len(singular))])
    shown = singular > NULL * singular[0] if singular[0] > 0.0 else np.zeros(p, dtype=bool)
    inverse = np.zeros(p)
    inverse[shown] = spread / singular[shown]
    half = turned.T * inverse
    covariance = half @ half.T
    null = turned[~shown]
    # A value belongs to what shows in nothing where it has a part in it above what rounding gives.
    lost = np.abs(null).max(axis=0, initial=0.0) > np.sqrt(NULL)
    covariance[lost] = np.nan
    covariance[:, lost] = np.nan
    covariance[lost, lost] = np.inf
    indistinct = [Indistinct(_weights(paths, own), float("inf")) for own in _sparse(null)]
    for own, error in zip(turned[shown][::-1], inverse[shown][::-1]):
        if error > clear:
            indistinct.append(Indistinct(_weights(paths, own), float(error)))
    size = np.abs(values)
    errors = np.sqrt(np.diag(covariance)) * size
    return Information(paths, values, s, errors, covariance * np.outer(size, size), indistinct)


def _weights(paths: tuple[str, ...], own: Array) -> dict[str, float]:
    """By path, the largest first and 1."""
    largest = own[np.argmax(np.abs(own))]
    order = np.argsort(-np.abs(own), kind="stable")
    return {paths[k]: float(own[k] / largest) for k in order if abs(own[k]) > 1e-3 * abs(largest)}


def _sparse(null: Array) -> Array:
    """A basis of the same space whose vectors name few values each: by elimination."""
    own = null.copy()
    free = list(range(own.shape[1]))
    for row in range(len(own)):
        pivot = max(free, key=lambda k: abs(own[row:, k]).max())
        best = row + int(np.argmax(np.abs(own[row:, pivot])))
        own[[row, best]] = own[[best, row]]
        own[row] /= own[row, pivot]
        for other in range(len(own)):
            if other != row:
                own[other] -= own[other, pivot] * own[row]
        free.remove(pivot)
    return own
