"""Kinds of joints of one's own."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any, Literal, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _hyperstat
from ._data import data
from ._errors import ArgumentError

_DIRECTIONS = ("x", "y", "z", "u", "v", "w")
# Entries of a compliance that differ by less count as equal, and its least eigenvalue as zero, beside the
# square root of the two entries on the diagonal.
_ROUNDING = 1e-9

Matrix = Union[npt.ArrayLike, Callable[..., npt.ArrayLike]]
"""A 6×6, or a function of a kind's arguments, by their names, that gives it."""


class JointKind:
    """A kind of joint that files may name beside the built-in ones.

    It is handed to `load` or `Mechanism` as `joints=[kind]`. A joint of the kind has a frame at its point, and
    moves in its free directions; functions are called when a file is read, or a design of it made, and never
    in a solve.

    Parameters
    ----------
    name : str
        What files call it.
    free : str or iterable of str
        Free directions: `x`, `y`, `z` translations along, `u`, `v`, `w` rotations about the axes x, y, z of
        the joint's frame; `"xv"` or `["x", "v"]`.
    frame : {"global", "axis", "axes"}
        How a joint's frame is turned: as the global one; y is the file's `axis: (…)`, x its `x_axis`; x is
        the first and y the second, made normal to it, of the file's `axes: ((…), (…))`.
    arguments : sequence of str
        Names of numbers that a file gives of each joint of the kind, SI or with a unit.
    basis : (6, 6) array_like or function of the arguments, optional
        Column d is the displacement of the first body relative to the second [m, rad], at the joint's point
        and in its frame, where direction d alone has moved by 1; left out, the identity.
    compliance : (6, 6) array_like or function of the arguments, optional
        From forces to displacements along the directions of the basis [m/N, rad/(N·m)], symmetric positive
        semidefinite; left out, the joint is rigid.

    Raises
    ------
    ArgumentError
        No such direction or frame; a matrix that is none.

    Examples
    --------
    >>> pin = hs.JointKind("Pin", "w", compliance=1e-8 * np.eye(6))
    >>> m = hs.load("lever.ron", joints=[pin])  # with `kind: Pin`
    """

    def __init__(
        self,
        name: str,
        free: Union[str, Iterable[str]] = "",
        *,
        frame: Literal["global", "axis", "axes"] = "global",
        arguments: Sequence[str] = (),
        basis: Optional[Matrix] = None,
        compliance: Optional[Matrix] = None,
    ) -> None:
        if not isinstance(name, str) or not name.isidentifier():
            raise ArgumentError(f"`{name!r}` is no name of a kind", help="give a word such as `CrossSpring`")
        if frame not in ("global", "axis", "axes"):
            raise ArgumentError(f"unknown frame `{frame!r}`", help="give `global`, `axis` or `axes`")
        directions = [own for own in free if own not in ", "]
        for own in directions:
            if own not in _DIRECTIONS:
                raise ArgumentError(
                    f"unknown direction `{own}`", help="x, y, z are translations, u, v, w rotations"
                )
        if isinstance(arguments, str):
            raise ArgumentError(f"`{arguments}` is one name", help=f'give a list, `["{arguments}"]`')
        names = list(arguments)
        for own in names:
            if not isinstance(own, str) or not own.isidentifier() or own in ("axis", "axes", "x_axis"):
                raise ArgumentError(f"`{own!r}` is no name of a number", help="give a word such as `length`")
        self.name = name
        self.free = tuple(own for own in _DIRECTIONS if own in directions)
        self.frame = frame
        self.arguments = tuple(names)
        self.basis = basis
        self.compliance = compliance
        # What does not depend on a file is known to be right at once.
        for given, check in ((basis, _basis), (compliance, _compliance)):
            if given is not None and not callable(given):
                check(given)
        self._core = _hyperstat.JointKind(name, list(self.free), frame, names, self._make)

    def _make(self, numbers: list[float]) -> tuple[Optional[list[float]], Optional[list[float]]]:
        """Basis and compliance of a joint by rows, for the core."""
        by_name = dict(zip(self.arguments, numbers))

        def made(given: Optional[Matrix], check: Callable[[Any], npt.NDArray[np.float64]]) -> Any:
            if given is None:
                return None
            return check(given(**by_name) if callable(given) else given).ravel().tolist()

        return made(self.basis, _basis), made(self.compliance, _compliance)

    def __call__(self, **arguments: Any) -> Any:
        """A joint of this kind for `hyperstat.Joint(kind=…)`: arguments as a file has them.

        Returns
        -------
        dict or str
        """
        return {self.name: data(arguments)} if arguments else self.name

    def __reduce__(self) -> tuple[object, ...]:
        given = (self.name, self.free, self.frame, self.arguments, self.basis, self.compliance)
        return _again, (type(self), given)

    def __repr__(self) -> str:
        free = "".join(self.free)
        return f"<hyperstat.JointKind {self.name!r} free={free!r} arguments={list(self.arguments)}>"


def _again(kind: type[JointKind], given: tuple[Any, ...]) -> JointKind:
    name, free, frame, arguments, basis, compliance = given
    return kind(name, free, frame=frame, arguments=arguments, basis=basis, compliance=compliance)


def _matrix(given: Any, what: str) -> npt.NDArray[np.float64]:
    try:
        own = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError):
        raise ArgumentError(f"the {what} is no matrix of numbers", help="give 6×6 numbers") from None
    if own.shape != (6, 6) or not np.isfinite(own).all():
        raise ArgumentError(
            f"the {what} has the shape {own.shape}" if own.shape != (6, 6) else f"the {what} is not finite",
            help="give 6×6 finite numbers",
        )
    return own


def _basis(given: Any) -> npt.NDArray[np.float64]:
    own = _matrix(given, "basis")
    if np.linalg.matrix_rank(own) < 6:
        raise ArgumentError(
            "the columns of the basis are not independent", help="state all six, those that are not free too"
        )
    return own


def _compliance(given: Any) -> npt.NDArray[np.float64]:
    own = _matrix(given, "compliance")
    scale = np.sqrt(np.abs(np.diag(own)))
    scale[scale == 0.0] = np.inf
    beside = own / np.outer(scale, scale)
    still = np.isinf(scale)
    if own[still].any() or own[:, still].any():
        raise ArgumentError(
            "the compliance has no number on its diagonal where it has others",
            help="it is symmetric positive semidefinite",
        )
    if np.abs(beside - beside.T).max() > _ROUNDING:
        raise ArgumentError("the compliance is not symmetric", help="give C with C = Cᵀ")
    own = (own + own.T) / 2.0
    if (np.diag(own) < 0.0).any() or np.linalg.eigvalsh((beside + beside.T) / 2.0)[0] < -_ROUNDING:
        raise ArgumentError(
            "the compliance is not positive semidefinite", help="no force may gain by what gives way"
        )
    return own
