"""Poses as Python gives them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from ._data import is_masked
from ._errors import ArgumentError

Array = npt.NDArray[np.float64]
Poses = Union[npt.ArrayLike, Mapping[str, npt.ArrayLike]]
"""Rows of x, y, z [m] or of x, y, z, rx, ry, rz [m, rad]; or columns by name."""
OnePose = Union[npt.ArrayLike, Mapping[str, float]]

_COORDINATES = ("x", "y", "z", "rx", "ry", "rz")


def one_pose(pose: Any) -> tuple[Optional[tuple[str, ...]], list[float]]:
    """Names, where it has them, and numbers."""
    names: Optional[tuple[str, ...]] = None
    given = pose
    if isinstance(pose, Mapping):
        names, given = tuple(map(str, pose)), list(pose.values())
    elif hasattr(pose, "to_dict") and all(isinstance(name, str) for name in getattr(pose, "index", (0,))):
        # A row of a DataFrame.
        names = tuple(pose.index)
    if isinstance(given, (list, tuple)) and all(type(own) in (float, int) for own in given):
        return names, [float(own) for own in given]
    try:
        numbers = _numbers(given)
    except ArgumentError:
        raise _no_pose(pose) from None
    if numbers.ndim != 1:
        raise _no_pose(pose)
    own: list[float] = numbers.tolist()
    return names, own


def columns_of(poses: Poses) -> tuple[list[str], Array]:
    """Names of columns, and rows."""
    named = named_columns(poses)
    if named is not None:
        if not named:
            raise ArgumentError("poses without columns", help="give coordinates or drives by name")
        each = [_numbers(own).reshape(-1) for _, own in named]
        try:
            return [name for name, _ in named], np.stack(np.broadcast_arrays(*each), axis=1)
        except ValueError:
            lengths = ", ".join(f"{name} {len(own)}" for (name, _), own in zip(named, each))
            raise ArgumentError(
                f"columns of different lengths: {lengths}", help="give every pose a number in each"
            ) from None
    rows = _numbers(poses)
    if rows.ndim != 2 or rows.shape[1] not in (3, 6):
        raise ArgumentError(
            f"poses of the shape {rows.shape}",
            code="argument",
            help="give (n, 3): x, y, z [m]; (n, 6): and rx, ry, rz [rad]; or a mapping of columns",
        )
    return list(_COORDINATES[: rows.shape[1]]), rows


def named_columns(poses: Any) -> Optional[list[tuple[str, Any]]]:
    """Columns of what has them by names: mappings, data frames, tables of Arrow."""
    if isinstance(poses, Mapping):
        return [(str(name), own) for name, own in poses.items()]
    names = getattr(poses, "column_names", None) or getattr(poses, "columns", None)
    if names is None or callable(names) or not any(isinstance(name, str) for name in names):
        return None
    return [(str(name), poses[name]) for name in names]


def _numbers(given: Any) -> Array:
    """An array of real numbers, all of them there."""
    rows = given if isinstance(given, (list, tuple)) else ()
    if any(is_masked(own) for own in (given, *rows)):
        raise ArgumentError("a pose with masked entries", help="leave masked rows out")
    try:
        own = np.asarray(given)
        if own.dtype.kind not in "fiubO":
            raise ArgumentError(
                f"poses of the type {own.dtype}", help="give real numbers: x, y, z [m], rx, ry, rz [rad]"
            )
        return np.asarray(own, dtype=np.float64)
    except (TypeError, ValueError) as error:
        if isinstance(error, ArgumentError):
            raise
        raise ArgumentError(f"poses that are no numbers: {error}") from None


def _no_pose(pose: object) -> ArgumentError:
    return ArgumentError(
        f"`{pose!r}` is no pose",
        help="give x, y, z [m], or x, y, z, rx, ry, rz [m, rad], or a mapping of names to numbers",
    )
