"""Solutions against the 60-digit files in `tests/reference`."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import hyperstat as hs

REFERENCE = Path(__file__).resolve().parents[3] / "tests" / "reference"
NAMES = sorted(path.stem for path in REFERENCE.glob("*.json"))
# Displacements of idle bodies are defined up to their motions.
IDLE = {"delta_ball_jointed_rods"}


def test_there_are_references() -> None:
    assert len(NAMES) >= 10


@pytest.mark.parametrize("name", NAMES)
def test_what_solve_finds_is_the_reference(name: str) -> None:
    expected = json.loads((REFERENCE / f"{name}.json").read_text())
    s = hs.load(REFERENCE / f"{name}.ron").solve(allow_free=True)
    assert s.mobility == expected["mobility"]
    assert s.overconstraint == expected["overconstraint"]
    assert s.idle_modes == expected["idle_modes"]
    stiffness = expected["output_stiffness"]
    if stiffness is None:
        assert np.isnan(s.stiffness).all()
    else:
        k = np.array(stiffness, dtype=float)
        scale = np.sqrt(np.outer(np.diag(k), np.diag(k)))
        assert np.max(np.abs(s.stiffness - k) / scale) < 1e-12
    if name in IDLE:
        return
    found = np.array([s.displacements[node] for node in expected["displacements"]])
    wanted = np.array(list(expected["displacements"].values()), dtype=float)
    for part in (slice(0, 3), slice(3, 6)):
        largest = np.max(np.abs(wanted[:, part]))
        # As the contract has it; translations and rotations each by their largest.
        assert np.max(np.abs(found[:, part] - wanted[:, part])) <= 1e-8 * largest
    wrenches = expected.get("joint_wrenches") or {}
    pairs = [
        (s.joints[joint].wrench, np.array(own, dtype=float))
        for joint, own in wrenches.items()
        if own is not None
    ]
    if pairs:
        largest = max(float(np.max(np.abs(own))) for _, own in pairs)
        for wrench, own in pairs:
            assert np.max(np.abs(wrench - own)) <= 1e-8 * largest


@pytest.mark.parametrize("kind", ["rigid", "elastic"])
def test_the_papers_trajectory(kind: str) -> None:
    rows = np.genfromtxt(REFERENCE / f"delta_trajectory_{kind}.csv", delimiter=",", names=True)
    m = hs.load(REFERENCE.parents[1] / "examples" / "paper.ron", f"delta-{kind}-trajectory")
    t = m.sweep(np.stack([rows["x"], rows["y"], rows["z"]], axis=1))
    assert t.ok.all()
    for r in range(6):
        for c in range(r, 6):
            scale = np.sqrt(t.stiffness[:, r, r] * t.stiffness[:, c, c])
            difference = t.stiffness[:, r, c] - rows[f"k{r + 1}{c + 1}"]
            assert np.max(np.abs(difference) / scale) < 1e-10
    for part in (("dx", "dy", "dz"), ("drx", "dry", "drz")):
        wanted = np.stack([rows[name] for name in part])
        found = np.stack([t[name] for name in part])
        assert np.max(np.abs(found - wanted)) < 1e-8 * np.max(np.abs(wanted))
