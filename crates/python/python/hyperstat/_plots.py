"""Plots with matplotlib and grids of pyvista, where these are installed."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import numpy.typing as npt

from . import _hyperstat
from ._errors import ArgumentError, unknown

if TYPE_CHECKING:
    from ._table import Table

_COORDINATES = ("x", "y", "z", "rx", "ry", "rz")
# Grid lines whose coordinates differ by less are one, relative to the span.
_SAME = 1e-9


def over_plane(
    table: Table,
    quantity: str,
    case: Optional[str],
    design: Optional[int],
    plane: Mapping[str, float],
    log: bool,
    ax: Any,
) -> Any:
    """A map over the two coordinates that vary."""
    import matplotlib.pyplot as plt

    values = table.measure(quantity, case)
    rows = np.ones(len(table), dtype=bool)
    if design is not None:
        if not 0 <= design < table.designs:
            raise unknown("design", design, map(str, range(table.designs)), "unknown-design")
        rows = np.arange(len(table)) // (len(table) // table.designs) == design
    elif table.designs > 1:
        raise ArgumentError(
            f"{table.designs} designs in one map",
            help="give `design=`, or draw rows of `table.by_design(...)`",
        )
    for name, value in plane.items():
        own = table.measure(name)
        rows &= np.abs(own - value) <= _SAME * max(1.0, float(np.nanmax(np.abs(own))))
    if not rows.any():
        raise ArgumentError("no pose lies in this plane", help="give values that poses have")
    varying = [
        name for name in (*table.drives, *_COORDINATES) if np.nanmax(table[name][rows]) - np.nanmin(table[name][rows]) > _SAME
    ]
    if table.drives:
        varying = [name for name in varying if name in table.drives]
    if len(varying) < 2:
        raise ArgumentError("a map needs two coordinates that vary", help="sweep over a grid")
    if len(varying) > 2:
        raise ArgumentError(
            f"{', '.join(varying)} vary", help=f"hold all but two by `plane={{\"{varying[2]}\": ...}}`"
        )
    across, up = (table[name][rows] for name in varying)
    shown = np.log10(values[rows]) if log else values[rows]
    known = np.isfinite(shown)
    if ax is None:
        _, ax = plt.subplots(layout="constrained")
    grid = _on_grid(across, up, shown)
    if grid is None:
        drawn = ax.tricontourf(across[known], up[known], shown[known], levels=12)
    else:
        drawn = ax.contourf(*grid, levels=12)
        ax.contour(*grid, levels=12, colors="k", linewidths=0.4)
    unit = dict((name, unit) for name, unit, _ in _hyperstat.measures()).get(
        quantity, _hyperstat.column(quantity)[0]
    )
    label = quantity + (f" [{unit}]" if unit else "")
    ax.figure.colorbar(drawn, ax=ax, label=f"log10 {label}" if log else label)
    units = [_hyperstat.column(name)[0] for name in varying]
    ax.set_xlabel(f"{varying[0]} [{units[0]}]")
    ax.set_ylabel(f"{varying[1]} [{units[1]}]")
    if units[0] == units[1]:
        ax.set_aspect("equal")
    return ax


def _on_grid(
    across: npt.NDArray[Any], up: npt.NDArray[Any], shown: npt.NDArray[Any]
) -> Optional[tuple[npt.NDArray[Any], npt.NDArray[Any], npt.NDArray[Any]]]:
    """The values over lines of a grid, where the poses stand on one."""
    x, y = np.unique(across), np.unique(up)
    if len(x) * len(y) != len(shown) or len(x) < 2 or len(y) < 2:
        return None
    z = np.full((len(y), len(x)), np.nan)
    z[np.searchsorted(y, up), np.searchsorted(x, across)] = shown
    return x, y, z


def _arrays(vtu: str) -> tuple[npt.NDArray[Any], list[npt.NDArray[Any]], npt.NDArray[Any]]:
    """Points, cells and displacements of a VTU file."""
    piece = ElementTree.fromstring(vtu).find(".//Piece")
    if piece is None:
        raise ArgumentError("nothing to draw")

    def numbers(path: str) -> npt.NDArray[Any]:
        found = piece.find(path)
        text = "" if found is None else found.text or ""
        return np.array(text.split(), dtype=np.float64)

    points = numbers("./Points/DataArray").reshape(-1, 3)
    ends = numbers("./Cells/DataArray[@Name='offsets']").astype(int)
    cells = np.split(numbers("./Cells/DataArray[@Name='connectivity']").astype(int), ends[:-1])
    moved = numbers("./PointData/DataArray[@Name='displacement']").reshape(-1, 3)
    return points, cells, moved


def deformed(vtu: str, title: str, ax: Any, scale: Optional[float]) -> Any:
    """The mechanism, undeformed and deformed."""
    import matplotlib.pyplot as plt

    points, cells, moved = _arrays(vtu)
    size = float(np.max(np.ptp(points, axis=0)))
    largest = float(np.max(np.linalg.norm(moved, axis=1)))
    if scale is None:
        scale = 0.1 * size / largest if largest > 0 else 1.0
    if ax is None:
        _, ax = plt.subplots(subplot_kw={"projection": "3d"}, layout="constrained")
    after = points + scale * moved
    for cell in cells:
        if len(cell) > 1:
            ax.plot(*points[cell].T, color="0.7", linewidth=1.0)
            ax.plot(*after[cell].T, color="tab:red", linewidth=1.5)
    ax.set_title(f"{title}, displacements × {scale:.3g}")
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    ax.set_zlabel("z [m]")
    ax.set_aspect("equal")
    return ax


def pyvista_grid(vtu: str) -> Any:
    """An unstructured grid of pyvista."""
    import tempfile
    from pathlib import Path

    import pyvista

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "solution.vtu"
        path.write_text(vtu, encoding="utf-8")
        return pyvista.read(path)
