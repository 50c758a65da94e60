"""Derivatives against differences of sweeps."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import hyperstat as hs

POSES = [[0.0, 0.0, 0.5], [0.1, -0.05, 0.52], [3.0, 0.0, 0.5], [-0.15, 0.1, 0.47]]
# What the differences are exact to: rounding of the values over the step.
EXACT = 1e-8


def differences(m: hs.Mechanism, measure: str, path: str, value: float) -> np.ndarray:
    """Central, with one extrapolation."""

    def of(h: float) -> np.ndarray:
        more, less = (
            m.with_values({path: value * (1.0 + own)}).sweep(POSES).measure(measure)
            for own in (h, -h)
        )
        return (more - less) / (2.0 * h * value)

    return (4.0 * of(1e-3) - of(2e-3)) / 3.0


PATHS = {
    "rod.section.diameter": 0.014,
    "arm.section.diameter": 0.030,
    "drive_stiffness": 1e5,
}


@pytest.mark.parametrize("measure", ["pure_force_stiffness_min", "deflection", "k15", "dz"])
def test_gradients_are_differences(measure: str) -> None:
    steel = hs.Material(young=2.1e11, poisson=0.3)
    arm, bar, rod = (hs.Link(section=hs.Circle(diameter=d), material=steel) for d in (0.03, 0.02, 0.014))
    m = hs.Delta(
        base_radius=0.25,
        platform_radius=0.06,
        arm_length=0.30,
        rod_length=0.60,
        rod_spacing=0.12,
        arm=arm,
        bar=bar,
        rod=rod,
        joint_stiffness=hs.Stiffness(x=1e8, y=1e8, z=1e8, u=1e5, w=1e5),
        drive_stiffness=1e5,
    ).with_loads([hs.Load(on=("platform", "P"), force=(10, 20, -100), moment=(1, 2, 3))])
    v, g = m.value_and_gradient(measure, list(PATHS), POSES)
    assert v.shape == (4,) and g.shape == (4, 3)
    expected = m.sweep(POSES).measure(measure)
    assert np.isnan(v[2]) and np.isnan(g[2]).all()
    known = [0, 1, 3]
    assert np.allclose(v[known], expected[known], rtol=1e-10, atol=0)
    for k, (path, value) in enumerate(PATHS.items()):
        wanted = differences(m, measure, path, value)[known]
        # Beside the value over the parameter, where the derivative nearly vanishes.
        scale = np.abs(wanted) + np.abs(v[known]) / value * 1e-3
        assert np.max(np.abs(g[known, k] - wanted) / scale) < EXACT, path


def test_what_is_not_there_is_told(examples: Path) -> None:
    m = hs.load(examples / "portal.ron")
    v, g = m.value_and_gradient("deflection", ["sections.rod.diameter"])
    assert v.shape == (1,) and g[0, 0] < 0 < v[0]
    with pytest.raises(hs.ArgumentError, match="no derivative") as caught:
        m.value_and_gradient("deflection", ["sections.rod.diametre"])
    assert caught.value.help == "did you mean `sections.rod.diameter`?"
    assert caught.value.code == "no-derivative"
    with pytest.raises(hs.ArgumentError, match="unknown measure"):
        m.value_and_gradient("stiffness", [])
