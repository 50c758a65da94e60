"""Values of a mechanism from measured deflections, by least squares."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from ._errors import ArgumentError, MissingError, unknown
from ._information import Information, Problem, known, loaded, named, spread_of
from ._mechanism import Mechanism
from ._poses import Poses
from ._table import _DISPLACEMENT

Array = npt.NDArray[np.float64]
Measured = Union[npt.ArrayLike, Mapping[str, npt.ArrayLike]]
"""Deflections (n, k) [m, rad], NaN where nothing was measured; or those of load cases by name."""

# Where the least squares end: beside the sum of squares, the values, the slope.
_ENDS = 1e-12


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
            raise unknown("path", path, self.paths, "unknown-path")
        return float(self.values[self.paths.index(path)])

    def __repr__(self) -> str:
        count = f"{len(self.residuals)} deflections, {len(self.paths)} values"
        spread = f"reduced chi-square {self.reduced_chi_square:.3g}"
        if self.sigma is not None:
            spread = f"standard deviation {self.sigma:.3g}"
        end = "" if self.success else f", not done: {self.message}"
        return "\n".join((f"<hyperstat.Identification: {count}, {spread}{end}>", *self._lines()))


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
    mechanism = loaded(mechanism, loads, cases)
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
    chosen = list(_DISPLACEMENT[:k]) if columns is None else named(columns)
    if len(chosen) != k:
        raise ArgumentError(
            f"deflections of {k} columns, and {len(chosen)} names", help="give `columns` one for each"
        )
    problem = Problem(mechanism, paths, poses, list(by_case), chosen, start, threads)
    found = np.stack(list(by_case.values()))
    there = np.isfinite(found)
    # Where the search ends is a matter of residuals of about one.
    scale = float(np.sqrt(np.mean(found[there] ** 2))) if sigma is None and found[there].any() else 1.0
    spread = spread_of(sigma, chosen, n) * scale
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
    told = known(problem.paths, values, s, 1.0 if sigma is not None else spread_found, clear)
    return Identification(
        **vars(told),
        mechanism=mechanism.with_values(dict(zip(problem.paths, values.tolist()))),
        residuals=rest * scale,
        sigma=None if sigma is not None else spread_found * scale,
        success=bool(ended.success),
        message=str(ended.message),
        evaluations=int(ended.nfev),
    )


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
