"""Poses in which deflections tell most of some values: D-optimal designs of experiments."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from ._errors import ArgumentError, PoseError
from ._information import NULL, Information, known, planned
from ._mechanism import Mechanism
from ._poses import Poses, columns_of, named_columns
from ._table import _DISPLACEMENT

Array = npt.NDArray[np.float64]

# The best weights of poses are sought until they are known so well, at most in so many steps.
_BOUND, _STEPS = 1e-2, 300


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
    problem, blocks = planned(mechanism, paths, candidates, loads, cases, columns, sigma, threads)
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
    shown = singular > NULL * singular[0]
    inner = blocks @ (turned[shown].T / singular[shown])
    rng = np.random.default_rng(seed)
    begins = [_greedy(inner, int(count), repeats)]
    begins += [rng.choice(len(inner), int(count), replace=repeats).tolist() for _ in range(restarts)]
    best = max((_exchanged(inner, own, repeats) for own in begins), key=lambda own: own[1])
    chosen = np.sort(np.array(best[0], dtype=np.intp))
    most = _most(inner)
    per = best[1] - inner.shape[2] * np.log(count)
    efficiency = float(np.exp(min(per - most, 0.0) / inner.shape[2]))
    names, rows = columns_of(candidates)
    indices = reached[chosen]
    taken: Any = rows[indices]
    if named_columns(candidates) is not None:
        taken = {name: rows[indices, place] for place, name in enumerate(names)}
    told = known(problem.paths, problem.start, blocks[chosen].reshape(-1, p), 1.0, clear)
    return Choice(indices, taken, told, efficiency)


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
