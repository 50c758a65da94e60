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
    # Lengths: the inverse kinematics follow them.
    "base_radius": 0.25,
    "arm_length": 0.30,
    "rod_length": 0.60,
    "rod_spacing": 0.12,
}


def delta() -> hs.Mechanism:
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
    )
    loads = [hs.Load(on=("platform", "P"), force=(10, 20, -100), moment=(1, 2, 3))]
    return m.with_loads(loads, cases={"push": [hs.Load(on=("platform", "P"), force=(0, 0, 40))]})


@pytest.mark.parametrize("measure", ["pure_force_stiffness_min", "deflection", "k15", "dz"])
def test_gradients_are_differences(measure: str) -> None:
    m = delta()
    v, g = m.value_and_gradient(measure, list(PATHS), POSES)
    assert v.shape == (4,) and g.shape == (4, len(PATHS))
    expected = m.sweep(POSES).measure(measure)
    assert np.isnan(v[2]) and np.isnan(g[2]).all()
    known = [0, 1, 3]
    assert np.allclose(v[known], expected[known], rtol=1e-10, atol=0)
    for k, (path, value) in enumerate(PATHS.items()):
        wanted = differences(m, measure, path, value)[known]
        # Beside the value over the parameter, where the derivative nearly vanishes.
        scale = np.abs(wanted) + np.abs(v[known]) / value * 1e-3
        assert np.max(np.abs(g[known, k] - wanted) / scale) < EXACT, path


def test_gradients_of_a_case() -> None:
    m = delta()
    v, g = m.value_and_gradient("deflection", ["arm_length", "drive_stiffness"], POSES[:1], case="push")
    assert np.isclose(v[0], m.sweep(POSES[:1]).measure("deflection", case="push")[0], rtol=1e-10)
    for k, (path, value) in enumerate({"arm_length": 0.30, "drive_stiffness": 1e5}.items()):

        def of(h: float, path: str = path, value: float = value) -> float:
            own = m.with_values({path: value * (1 + h)}).sweep(POSES[:1])
            return float(own.measure("deflection", case="push")[0])

        wanted = (8 * (of(1e-3) - of(-1e-3)) - of(2e-3) + of(-2e-3)) / (12e-3 * value)
        assert abs(g[0, k] - wanted) < EXACT * abs(wanted), path


def test_a_cantilever_answers_to_its_length_as_its_formula() -> None:
    """k22 = 12 E I / L³ of a bar along x, its end held from turning; by the coordinate of its end."""
    young, diameter, length = 2e11, 0.02, 0.5
    text = f"""(
        name: "cantilever",
        points: {{ "A": (0.0, 0.0, 0.0), "B": ({length}, 0.0, 0.0) }},
        materials: {{ "steel": (young: {young}, poisson: 0.3) }},
        sections: {{ "rod": Circle(diameter: {diameter}) }},
        bodies: {{ "bar": Beam(through: ["A", "B"], section: "rod", material: "steel") }},
        joints: {{ "wall": (at: "A", between: ("ground", "bar"), kind: Fixed) }},
        loads: [(on: ("bar", "B"), force: (0.0, 0.0, -1.0))],
        output: ("bar", "B"),
    )"""
    inertia = np.pi * diameter**4 / 64
    v, g = hs.Mechanism(text).value_and_gradient("k22", ["points.B.0", "points.A.1"])
    assert np.isclose(v[0], 12 * young * inertia / length**3, rtol=1e-12)
    assert np.isclose(g[0, 0], -36 * young * inertia / length**4, rtol=1e-9)
    # Moved across, the bar only turns: its length changes in the second order.
    assert abs(g[0, 1]) < 1e-8 * abs(g[0, 0])


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
