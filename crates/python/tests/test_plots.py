"""Plots hold what they are asked for."""

from __future__ import annotations

from pathlib import Path

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


def test_a_solution_is_drawn(examples: Path) -> None:
    s = hs.load(examples / "portal.ron").solve()
    ax = s.plot()
    drawn = np.concatenate([np.array(line.get_data_3d()).T for line in ax.lines])
    assert np.isclose(drawn, (0.1, 0.5, 0.2), atol=1e-12).all(axis=1).any()
    moved = np.array([0.1, 0.5, 0.2]) + 3.0 * s.displacement[:3]
    drawn = np.concatenate([np.array(line.get_data_3d()).T for line in s.plot(scale=3.0).lines])
    assert np.isclose(drawn, moved, rtol=0, atol=1e-9).all(axis=1).any()
