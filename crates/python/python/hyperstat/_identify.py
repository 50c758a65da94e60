"""Values of a mechanism from measured deflections: what they are, how well they are known, what cannot be told
apart, and in which poses to measure.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from ._errors import ArgumentError, Error, MissingError, PoseError, unknown
from ._mechanism import Mechanism, Poses, _columns, _threads
from ._mechanism import _named as _by_name
from ._table import _DISPLACEMENT

Array = npt.NDArray[np.float64]
Measured = Union[npt.ArrayLike, Mapping[str, npt.ArrayLike]]
"""Deflections (n, k) [m, rad], NaN where nothing was measured; or those of load cases by name."""

# A combination of values shows in nothing where it shows so little beside that which shows most: derivatives
# are good to 1e-8.
_NULL = 1e-7
# Part of a combination that is named, beside the largest.
_NAMED = 0.05
# Where the least squares end: beside the sum of squares, the values, the slope.
_ENDS = 1e-12
# The best weights of poses are sought until they are known so well, at most in so many steps.
_BOUND, _STEPS = 1e-2, 300


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
            known = f"± {error:.2g} ({error / abs(value):.1%})" if np.isfinite(error) else "cannot be told"
            yield f"  {path:{wide}}  {value:.6g} {known}"
        for own in self.indistinct:
            yield f"  {own}"

    def __repr__(self) -> str:
        head = f"<hyperstat.Information: {len(self.sensitivity)} deflections, {len(self.paths)} values>"
        return "\n".join((head, *self._lines()))


@dataclass(frozen=True, eq=False, repr=False)
class Identification(Information):
    """Values that fit measured deflections best.

    Attributes
    ----------
    mechanism : Mechanism
        With these values.
    residuals : (N,) ndarray
        Deflections that are found less those that are measured, over their standard deviations; in m or rad
        where these were not given.
    sigma : float or None
        Standard deviation of the deflections by the residuals [m or rad], where it was not given.
    success : bool
    message : str
        How the search ended.
    evaluations : int
        Times that all poses were solved.
    """

    mechanism: Mechanism
    residuals: Array
    sigma: Optional[float]
    success: bool
    message: str
    evaluations: int

    @property
    def reduced_chi_square(self) -> float:
        """Sum of the squares of the residuals over their number less that of the values: near 1 where the
        model and the standard deviations are right. NaN where these were not given.
        """
        free = len(self.residuals) - len(self.paths)
        if free <= 0 or self.sigma is not None:
            return float("nan")
        return float(self.residuals @ self.residuals) / free

    def __getitem__(self, path: str) -> float:
        """The value at a path, SI."""
        if path not in self.paths:
            raise KeyError(path)
        return float(self.values[self.paths.index(path)])

    def __repr__(self) -> str:
        count = f"{len(self.residuals)} deflections, {len(self.paths)} values"
        spread = f"reduced chi-square {self.reduced_chi_square:.3g}"
        if self.sigma is not None:
            spread = f"standard deviation {self.sigma:.3g}"
        end = "" if self.success else f", not done: {self.message}"
        return "\n".join((f"<hyperstat.Identification: {count}, {spread}{end}>", *self._lines()))


@dataclass(frozen=True, eq=False)
class Choice:
    """Poses that tell much.

    Attributes
    ----------
    indices : (count,) ndarray of int
        Of the candidates, ascending; one that is measured twice is there twice.
    poses
        These, as the candidates are given.
    information : Information
        What deflections in them tell.
    efficiency : float
        At least so much of what the best measurements over the candidates could tell, of as many: ratio of the
        p-th roots of the determinants.
    """

    indices: npt.NDArray[np.intp]
    poses: Any
    information: Information
    efficiency: float

    def __repr__(self) -> str:
        head = f"<hyperstat.Choice of {len(self.indices)} poses, efficiency {self.efficiency:.0%} or more>"
        return "\n".join((head, *self.information._lines()))


def identify(
    mechanism: Mechanism,
    paths: Sequence[str],
    poses: Optional[Poses],
    measured: Measured,
    *,
    loads: Optional[Sequence[Any]] = None,
    cases: Optional[Mapping[str, Sequence[Any]]] = None,
    columns: Optional[Sequence[str]] = None,
    sigma: Optional[npt.ArrayLike] = None,
    start: Optional[Mapping[str, float]] = None,
    bounds: Optional[Mapping[str, tuple[float, float]]] = None,
    clear: float = 0.5,
    threads: int = 0,
) -> Identification:
    """Values of a mechanism from measured deflections, by least squares.

    Joint, drive and link stiffnesses, or any other numbers: those whose deflections come nearest to the measured
    ones, each over its standard deviation. Values above zero are sought by their logarithms, others over their
    size, with the exact derivatives of `Mechanism.value_and_gradient`.

    Parameters
    ----------
    mechanism : Mechanism
        With the values to start from, under the loads of the measurement.
    paths : sequence of str
        Of the values, as `vary` names them: `drive_stiffness`, `joints.{A1|A2}.stiffness.u` for several
        that are alike.
    poses : (n, 3) or (n, 6) array_like, or mapping
        As of `Mechanism.sweep`; `None`: its own.
    measured : (n, k) array_like, or mapping of them
        Displacements of the output under the loads [m, rad], global: what the sweep's `displacement` is. NaN
        where nothing was measured. By names of load cases: those of each.
    loads, cases
        In place of the mechanism's own, as of `Mechanism.sweep`.
    columns : sequence of str, optional
        Which displacements `measured` holds, of dx, dy, dz, drx, dry, drz; left out, the first k.
    sigma : float, (k,) or (n, k) array_like, optional
        Standard deviations of the measurement [m, rad]. Left out, all are taken as equal, and as what the
        residuals show; translations and rotations together need it.
    start : mapping, optional
        Other values to start from.
    bounds : mapping of (low, high), optional
        Of values by path, SI.
    clear : float
        Combinations of values that are known worse than this, as a relative standard error, are named.
    threads : int
        0 is one a core.

    Returns
    -------
    Identification
        `values`, `standard_errors`, `covariance`, `indistinct`, `residuals`, `mechanism` with the values. The
        errors are those of the linearized model, (SᵀS)⁻¹ [1]_; in a direction that shows in nothing the values
        stay near where they started.

    Raises
    ------
    ArgumentError
        A path to no number, measurements of another shape, fewer than there are values.
    PoseError
        A measured pose that the mechanism cannot take.
    MissingError
        scipy is not installed.

    References
    ----------
    .. [1] G. A. F. Seber, C. J. Wild, Nonlinear Regression, Wiley, 1989, chapters 2.1 and 3.3.
    """
    try:
        from scipy.optimize import least_squares
    except ImportError:
        raise MissingError("identification needs scipy", help="pip install scipy") from None
    mechanism = _loaded(mechanism, loads, cases)
    by_case: dict[Optional[str], Array] = {}
    if isinstance(measured, Mapping):
        by_case.update((str(name), _table(own)) for name, own in measured.items())
    else:
        by_case[None] = _table(measured)
    if not by_case:
        raise ArgumentError("nothing was measured", help="give deflections (n, k)")
    shapes = {own.shape for own in by_case.values()}
    if len(shapes) > 1:
        raise ArgumentError(
            f"deflections of the shapes {sorted(shapes)}", help="every case has a row a pose; NaN for none"
        )
    ((n, k),) = shapes
    chosen = list(_DISPLACEMENT[:k]) if columns is None else _named(columns)
    if len(chosen) != k:
        raise ArgumentError(
            f"deflections of {k} columns, and {len(chosen)} names", help="give `columns` one for each"
        )
    problem = _Problem(mechanism, paths, poses, list(by_case), chosen, start, threads)
    found = np.stack(list(by_case.values()))
    there = np.isfinite(found)
    # Where the search ends is a matter of residuals of about one.
    scale = float(np.sqrt(np.mean(found[there] ** 2))) if sigma is None and found[there].any() else 1.0
    spread = _spread(sigma, chosen, n) * scale
    count = int(there.sum())
    if count < len(problem.paths):
        raise ArgumentError(
            f"{count} deflections for {len(problem.paths)} values", help="measure more, or ask for fewer"
        )
    weights = np.broadcast_to(1.0 / spread, found.shape)[there]
    target = found[there]
    if problem.rows_known not in (None, n):
        raise ArgumentError(
            f"{problem.rows_known} poses, and deflections of {n}", help="give a row for every pose"
        )

    def residuals(x: Array) -> Array:
        own: Array = (problem.displacements(problem.values(x))[there] - target) * weights
        return own

    def slopes(x: Array) -> Array:
        values = problem.values(x)
        own: Array = problem.sensitivity(values)[there] * weights[:, None] * problem.by_x(values)
        return own

    low, high = problem.limits(bounds)
    ended = least_squares(
        residuals,
        np.clip(np.zeros(len(problem.paths)), low, high),
        slopes,
        bounds=(low, high),
        ftol=_ENDS,
        xtol=_ENDS,
        gtol=_ENDS,
        max_nfev=50 * (1 + len(problem.paths)),
    )
    values = problem.values(ended.x)
    rest: Array = ended.fun
    free = count - len(problem.paths)
    spread_found = float(np.sqrt(rest @ rest / free)) if free > 0 else float("nan")
    s = problem.sensitivity(values)[there] * weights[:, None] * np.abs(values)
    known = _known(problem.paths, values, s, 1.0 if sigma is not None else spread_found, clear)
    return Identification(
        **vars(known),
        mechanism=mechanism.with_values(dict(zip(problem.paths, values.tolist()))),
        residuals=rest * scale,
        sigma=None if sigma is not None else spread_found * scale,
        success=bool(ended.success),
        message=str(ended.message),
        evaluations=int(ended.nfev),
    )


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
    problem, blocks = _planned(mechanism, paths, poses, loads, cases, columns, sigma, threads)
    if np.isnan(blocks).any():
        row = int(np.flatnonzero(np.isnan(blocks).any(axis=(1, 2)))[0])
        raise _unreached(row)
    s = blocks.reshape(-1, len(problem.paths))
    return _known(problem.paths, problem.start, s, 1.0, clear)


def choose_poses(
    mechanism: Mechanism,
    paths: Sequence[str],
    candidates: Poses,
    count: int,
    *,
    loads: Optional[Sequence[Any]] = None,
    cases: Optional[Mapping[str, Sequence[Any]]] = None,
    columns: Sequence[str] = _DISPLACEMENT[:3],
    sigma: Optional[npt.ArrayLike] = None,
    repeats: bool = False,
    restarts: int = 3,
    seed: int = 0,
    clear: float = 0.5,
    threads: int = 0,
) -> Choice:
    """Poses in which deflections tell most of some values: D-optimal.

    The determinant of the information SᵀS is made large: that of the covariance, the volume of the region
    where the values may be, small. Poses are added one after the other, then exchanged while that helps [1]_,
    from several beginnings.

    Parameters
    ----------
    mechanism : Mechanism
        With the values as they are supposed to be.
    paths, loads, sigma, clear, threads
        As of `identify`.
    candidates : (n, 3) or (n, 6) array_like, or mapping
        Poses that can be measured, as of `Mechanism.sweep`; those without a result are left out.
    count : int
        So many of them are chosen.
    cases, columns
        As of `information`.
    repeats : bool
        Whether a pose may be measured more than once.
    restarts : int
        Further beginnings, at random.
    seed : int
        Of these.

    Returns
    -------
    Choice
        `indices`, `poses`, what they tell, and an `efficiency` beside the best weights of the candidates [2]_.
        What shows in no candidate is left out of the determinant, and named.

    Raises
    ------
    ArgumentError
        Fewer deflections than values; more poses than candidates.
    PoseError
        No candidate has a result.

    References
    ----------
    .. [1] V. V. Fedorov, Theory of Optimal Experiments, Academic Press, 1972, chapter 3.
    .. [2] J. Kiefer, J. Wolfowitz, The equivalence of two extremum problems, Canadian Journal of Mathematics
       12, 1960.
    """
    problem, blocks = _planned(mechanism, paths, candidates, loads, cases, columns, sigma, threads)
    reached = np.flatnonzero(~np.isnan(blocks).any(axis=(1, 2)))
    if len(reached) == 0:
        raise PoseError("no candidate has a result", code="pose", help="give poses within the workspace")
    if not isinstance(count, (int, np.integer)) or count < 1:
        raise ArgumentError(f"`{count!r}` poses", help="give a whole number above zero")
    if count > len(reached) and not repeats:
        raise ArgumentError(
            f"{count} poses of {len(reached)} candidates with a result",
            help="give more candidates, or allow `repeats`",
        )
    blocks = blocks[reached]
    p = blocks.shape[2]
    if count * blocks.shape[1] < p:
        raise ArgumentError(
            f"{count} poses have {count * blocks.shape[1]} deflections, fewer than the {p} values",
            help="choose more poses",
        )
    # Directions that show in some candidate, as of one scale.
    _, singular, turned = np.linalg.svd(blocks.reshape(-1, p), full_matrices=False)
    shown = singular > _NULL * singular[0]
    inner = blocks @ (turned[shown].T / singular[shown])
    rng = np.random.default_rng(seed)
    begins = [_greedy(inner, int(count), repeats)]
    begins += [rng.choice(len(inner), int(count), replace=repeats).tolist() for _ in range(restarts)]
    best = max((_exchanged(inner, own, repeats) for own in begins), key=lambda own: own[1])
    chosen = np.sort(np.array(best[0], dtype=np.intp))
    most = _most(inner)
    per = best[1] - inner.shape[2] * np.log(count)
    efficiency = float(np.exp(min(per - most, 0.0) / inner.shape[2]))
    names, rows = _columns(candidates)
    indices = reached[chosen]
    taken: Any = rows[indices]
    if _by_name(candidates) is not None:
        taken = {name: rows[indices, place] for place, name in enumerate(names)}
    told = _known(problem.paths, problem.start, blocks[chosen].reshape(-1, p), 1.0, clear)
    return Choice(indices, taken, told, efficiency)


class _Problem:
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
        given = None if poses is None else _columns(poses)
        self.rows_known = mechanism.poses if given is None else len(given[1])
        self.poses: Optional[dict[str, Array]] = None
        if given is not None:
            self.poses = {name: given[1][:, place] for place, name in enumerate(given[0])}
        self.cases = cases
        self.columns = columns
        self.threads = _threads(threads)
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


def _loaded(
    mechanism: Mechanism,
    loads: Optional[Sequence[Any]],
    cases: Optional[Mapping[str, Sequence[Any]]],
) -> Mechanism:
    if not isinstance(mechanism, Mechanism):
        raise ArgumentError(f"`{mechanism!r}` is no mechanism", help="give one, such as `hyperstat.load(path)`")
    if loads is None and cases is None:
        return mechanism
    return mechanism.with_loads(loads, cases=cases)


def _planned(
    mechanism: Mechanism,
    paths: Sequence[str],
    poses: Optional[Poses],
    loads: Optional[Sequence[Any]],
    cases: Optional[Mapping[str, Sequence[Any]]],
    columns: Sequence[str],
    sigma: Optional[npt.ArrayLike],
    threads: int,
) -> tuple[_Problem, Array]:
    """The sensitivity over the standard deviations, by relative changes, pose by pose: (n, cases·k, p)."""
    mechanism = _loaded(mechanism, loads, cases)
    chosen = _named(columns)
    named: list[Optional[str]] = list(mechanism.cases) or [None]
    problem = _Problem(mechanism, paths, poses, named, chosen, None, threads)
    s = problem.sensitivity(problem.start)
    spread = _spread(sigma, chosen, s.shape[1])
    s = s / spread[..., None] * np.abs(problem.start)
    return problem, s.transpose(1, 0, 2, 3).reshape(s.shape[1], -1, s.shape[3])


def _table(measured: Any) -> Array:
    try:
        own = np.asarray(measured, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise ArgumentError(f"deflections that are no numbers: {error}") from None
    if own.ndim != 2 or not 1 <= own.shape[1] <= 6:
        raise ArgumentError(
            f"deflections of the shape {own.shape}", help="give (n, k): a row a pose, dx, dy, dz, ..."
        )
    return own


def _named(columns: Sequence[str]) -> list[str]:
    own = [columns] if isinstance(columns, str) else list(columns)
    for name in own:
        if name not in _DISPLACEMENT:
            raise ArgumentError(f"`{name!r}` is no displacement", help="give dx, dy, dz, drx, dry or drz")
    if not own or len(set(own)) < len(own):
        raise ArgumentError("no columns, or one twice", help="give some of dx, dy, dz, drx, dry, drz")
    return own


def _spread(sigma: Optional[npt.ArrayLike], columns: list[str], n: int) -> Array:
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


def _known(paths: tuple[str, ...], values: Array, s: Array, spread: float, clear: float) -> Information:
    """What sensitivities tell; `spread` is the standard deviation of what they are of."""
    p = len(paths)
    _, singular, turned = np.linalg.svd(s, full_matrices=True)
    singular = np.concatenate([singular, np.zeros(p - len(singular))])
    shown = singular > _NULL * singular[0] if singular[0] > 0.0 else np.zeros(p, dtype=bool)
    inverse = np.zeros(p)
    inverse[shown] = spread / singular[shown]
    half = turned.T * inverse
    covariance = half @ half.T
    null = turned[~shown]
    # A value belongs to what shows in nothing where it has a part in it above what rounding gives.
    lost = np.abs(null).max(axis=0, initial=0.0) > np.sqrt(_NULL)
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


def _log_det(m: Array) -> float:
    sign, own = np.linalg.slogdet(m)
    return float(own) if sign > 0.0 else float("-inf")


def _gains(blocks: Array, m: Array) -> Array:
    """By how much each pose raises the logarithm of the determinant."""
    ridge = 1e-12 * np.trace(m) / len(m) + 1e-15
    y = np.linalg.solve(m + ridge * np.eye(len(m)), blocks.transpose(0, 2, 1))
    inner = np.eye(blocks.shape[1]) + blocks @ y
    own: Array = np.linalg.slogdet(inner)[1]
    return own


def _greedy(blocks: Array, count: int, repeats: bool) -> list[int]:
    """Poses, each the best beside those before it."""
    # As if all candidates together had been measured a little.
    m = 1e-6 * np.eye(blocks.shape[2])
    chosen: list[int] = []
    for _ in range(count):
        gains = _gains(blocks, m)
        if not repeats:
            gains[chosen] = -np.inf
        best = int(np.argmax(gains))
        chosen.append(best)
        m = m + blocks[best].T @ blocks[best]
    return chosen


def _exchanged(blocks: Array, chosen: list[int], repeats: bool) -> tuple[list[int], float]:
    """Poses exchanged one for one while that helps, and the logarithm of their determinant."""
    chosen = list(chosen)
    m = np.einsum("jqa,jqb->ab", blocks[chosen], blocks[chosen])
    better = True
    while better:
        better = False
        for place, own in enumerate(chosen):
            without = m - blocks[own].T @ blocks[own]
            gains = _gains(blocks, without)
            if not repeats:
                gains[[other for k, other in enumerate(chosen) if k != place]] = -np.inf
            best = int(np.argmax(gains))
            if gains[best] > gains[own] + 1e-9:
                chosen[place] = best
                # Anew, so that rounding does not add up.
                m = np.einsum("jqa,jqb->ab", blocks[chosen], blocks[chosen])
                better = True
    return chosen, _log_det(m)


def _most(blocks: Array) -> float:
    """What the logarithm of the determinant of one measurement, shared out over the candidates, cannot exceed."""
    n, _, p = blocks.shape
    weights = np.full(n, 1.0 / n)
    most = np.inf
    for _ in range(_STEPS):
        m = np.einsum("j,jqa,jqb->ab", weights, blocks, blocks)
        d = np.einsum("jqa,jqa->j", blocks, np.linalg.solve(m, blocks.transpose(0, 2, 1)).transpose(0, 2, 1))
        most = min(most, _log_det(m) + float(d.max()) - p)
        if d.max() < p * (1.0 + _BOUND):
            break
        weights = weights * d / p
    return most
