"""Plots hold what they are asked for."""

from __future__ import annotations

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import hyperstat as hs

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")


def test_a_map_has_the_values(examples: Path) -> None:
    m = hs.load(examples / "paper.ron", "delta-elastic-trajectory")
    x, y = np.linspace(-0.1, 0.1, 7), np.linspace(-0.05, 0.05, 5)
    poses = np.stack([own.ravel() for own in np.meshgrid(x, y, [0.5, 0.52])], axis=1)
    t = m.sweep(poses)
    ax = t.plot_map("pure_force_stiffness_min", plane={"z": 0.5})
    assert ax.get_xlabel() == "x [m]" and ax.get_ylabel() == "y [m]"
    assert np.allclose(ax.get_xlim(), (-0.1, 0.1)) and np.allclose(ax.get_ylim(), (-0.05, 0.05))
    values = t.measure("pure_force_stiffness_min")[t["z"] == 0.5]
    drawn = ax.collections[0]
    assert drawn.zmin == values.min() and drawn.zmax == values.max()
    with pytest.raises(hs.ArgumentError, match="x, y, z vary"):
        t.plot_map()
    assert t.plot_map("k11", plane={"z": 0.52}, log=True) is not None


def test_a_map_is_of_one_design(examples: Path) -> None:
    m = hs.load(examples / "paper.ron", "delta-elastic-trajectory")
    x, y = np.linspace(-0.1, 0.1, 5), np.linspace(-0.05, 0.05, 4)
    poses = np.stack([own.ravel() for own in np.meshgrid(x, y, [0.5])], axis=1)
    t = m.evaluate({"rod.section.diameter": [0.012, 0.014]}, poses)
    with pytest.raises(hs.ArgumentError, match="2 designs") as caught:
        t.plot_map("k33")
    assert "by_design" in (caught.value.help or "")
    for design in range(2):
        values = t.by_design(t["k33"])[design]
        drawn = t.plot_map("k33", design=design).collections[0]
        assert drawn.zmin == values.min() and drawn.zmax == values.max()
    with pytest.raises(hs.SelectionError):
        t.plot_map("k33", design=2)


def test_what_is_wrong_with_a_map_is_told(examples: Path) -> None:
    t = hs.load(examples / "paper.ron", "delta-elastic-trajectory").sweep()
    for plane in ({"q": 1.0}, {"status": 1.0}):
        with pytest.raises((hs.ArgumentError, hs.SelectionError)):
            t.plot_map("k33", plane=plane)
    with pytest.raises(hs.SelectionError):
        t.plot_map("deflection", case="storm")


def test_a_map_of_a_case_is_of_the_case(examples: Path) -> None:
    m = hs.load(examples / "paper.ron", "delta-elastic-trajectory")
    x, y = np.linspace(-0.1, 0.1, 5), np.linspace(-0.05, 0.05, 4)
    poses = np.stack([own.ravel() for own in np.meshgrid(x, y, [0.5])], axis=1)
    load = hs.Load(on=("platform", "P"), force=(300.0, -400.0, 5000.0))
    t = m.sweep(poses, cases={"push": [load]}, columns=["Measures"])
    length = np.linalg.norm(t.cases["push"].displacement[:, :3], axis=1)
    drawn = t.plot_map("deflection", case="push").collections[0]
    assert np.isclose(drawn.zmax, length.max(), rtol=1e-12)


def test_a_grid_of_pyvista_has_the_solution(
    examples: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What pyvista is handed, here in its place: a file that it reads, with points and displacements."""
    s = hs.load(examples / "portal.ron").solve()
    seen: list[str] = []

    def read(path: Path) -> str:
        assert path.suffix == ".vtu"
        seen.append(path.read_text(encoding="utf-8"))
        return "grid"

    monkeypatch.setitem(sys.modules, "pyvista", SimpleNamespace(read=read))
    assert s.to_pyvista() == "grid"
    data = ElementTree.fromstring(seen[0])
    assert data.tag == "VTKFile" and data.get("type") == "UnstructuredGrid"
    arrays = {own.get("Name"): (own.text or "").split() for own in data.iter("DataArray")}
    moved = np.array(arrays["displacement"], dtype=float).reshape(-1, 3)
    assert np.isclose(moved, s.displacement[:3], rtol=1e-6, atol=1e-15).all(axis=1).any()


def test_pyvista_reads_it(examples: Path) -> None:
    pytest.importorskip("pyvista")
    s = hs.load(examples / "portal.ron").solve()
    grid = s.to_pyvista()
    assert grid.n_cells > 0
    assert np.isclose(grid.point_data["displacement"], s.displacement[:3], rtol=1e-6).all(axis=1).any()


def test_a_solution_is_drawn(examples: Path) -> None:
    s = hs.load(examples / "portal.ron").solve()
    ax = s.plot()
    drawn = np.concatenate([np.array(line.get_data_3d()).T for line in ax.lines])
    assert np.isclose(drawn, (0.1, 0.5, 0.2), atol=1e-12).all(axis=1).any()
    moved = np.array([0.1, 0.5, 0.2]) + 3.0 * s.displacement[:3]
    drawn = np.concatenate([np.array(line.get_data_3d()).T for line in s.plot(scale=3.0).lines])
    assert np.isclose(drawn, moved, rtol=0, atol=1e-9).all(axis=1).any()
