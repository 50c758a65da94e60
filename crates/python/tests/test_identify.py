"""Values from measured deflections: recovered, their errors, what cannot be told apart, and where to measure."""

from __future__ import annotations

import sys
from collections.abc import Callable
from itertools import combinations
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import hyperstat as hs

pytest.importorskip("scipy")

Array = npt.NDArray[np.float64]
PATHS = ["drive_stiffness", "joint_stiffness.u", "rod.section.diameter"]
TRUE = {"drive_stiffness": 1.4e5, "joint_stiffness.u": 0.7e5, "rod.section.diameter": 0.0131}


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
    return m.with_loads([hs.Load(on=("platform", "P"), force=(100.0, 60.0, -80.0))])


def poses(count: int = 12) -> Array:
    rng = np.random.default_rng(1)
    return np.column_stack([rng.uniform(-0.2, 0.2, (count, 2)), rng.uniform(0.42, 0.58, count)])


def arm(**stiffness: float) -> hs.Mechanism:
    """A stiff bar on an elastic wall, under a force aside: quick to solve."""
    own = {"x": 1e7, "y": 1e7, "z": 2e6, "u": 3e3, "v": 5e3, "w": 4e3, **stiffness}
    return hs.Mechanism(
        {
            "name": "arm",
            "points": {"A": (0, 0, 0), "B": (0.3, 0.05, 0.02)},
            "bodies": {"arm": hs.Rigid(points=["A", "B"])},
            "joints": {
                "wall": hs.Joint(
                    at="A", between=("ground", "arm"), kind=hs.Fixed(), stiffness=hs.Stiffness(**own)
                )
            },
            "loads": [hs.Load(on=("arm", "B"), force=(40.0, -50.0, 60.0), moment=(3.0, 2.0, -4.0))],
            "output": ("arm", "B"),
        }
    )


WALL = [f"joints.wall.stiffness.{own}" for own in "uvw"]
SIX = ["dx", "dy", "dz", "drx", "dry", "drz"]


def test_stiffnesses_without_noise_are_recovered() -> None:
    m, at = delta(), poses()
    measured = m.with_values(TRUE).sweep(at).displacement[:, :3]
    r = hs.identify(m, PATHS, at, measured)
    assert r.success and r.paths == tuple(PATHS) and r.indistinct == []
    for path, value in TRUE.items():
        # The values of the sweep and the gradients are good to 1e-10, and all show by some percent.
        assert abs(r[path] / value - 1.0) < 1e-7, path
    assert np.allclose(r.mechanism.sweep(at).displacement[:, :3], measured, rtol=1e-7, atol=1e-12)
    assert r.sigma is not None and r.sigma < 1e-9 and np.isnan(r.reduced_chi_square)
    # The linear part alone, and with what was not measured, in a case of loads.
    push = {"push": [hs.Load(on=("platform", "P"), force=(100.0, 60.0, -80.0))]}
    some = measured[:, [2, 0]]
    some[3, 1] = some[5] = np.nan
    again = hs.identify(m, PATHS, at, {"push": some}, loads=[], cases=push, columns=["dz", "dx"], sigma=1e-6)
    assert np.allclose(again.values, r.values, rtol=1e-6) and len(again.residuals) == 2 * 12 - 3


def test_stiffnesses_with_noise_are_recovered_within_their_errors() -> None:
    m, at = delta(), poses()
    sigma = 2e-7
    noise = sigma * np.random.default_rng(5).normal(size=(len(at), 3))
    measured = m.with_values(TRUE).sweep(at).displacement[:, :3] + noise
    known = hs.identify(m, PATHS, at, measured, sigma=sigma)
    found = hs.identify(m, PATHS, at, measured)
    for r in (known, found):
        off = (r.values - np.array(list(TRUE.values()))) / r.standard_errors
        # Of three normal numbers none is beyond four, but once in five thousand seeds.
        assert np.abs(off).max() < 4.0 and (r.relative_errors < 0.05).all()
    # The same minimum, and errors as the residuals have it.
    assert np.allclose(found.values, known.values, rtol=1e-6)
    assert found.sigma is not None
    ratio = found.sigma / sigma
    assert np.isclose(ratio**2, known.reduced_chi_square, rtol=1e-6)
    assert np.allclose(found.standard_errors, ratio * known.standard_errors, rtol=1e-5)
    # Free are 33 of 36: four standard deviations of their chi-square.
    assert abs(known.reduced_chi_square - 1.0) < 4.0 * np.sqrt(2.0 / 33.0)
    assert "drive_stiffness" in repr(known) and "±" in repr(known)
    assert np.allclose(np.diag(known.correlation), 1.0)
    with pytest.raises(hs.SelectionError, match="drive_stifness") as caught:
        known["drive_stifness"]
    assert caught.value.help == "did you mean `drive_stiffness`?"


def test_standard_errors_are_those_of_repeated_measurements() -> None:
    """Monte Carlo: the spread of the values of many noisy measurements."""
    m = arm()
    exact = m.sweep().displacement
    sigma = np.array([1e-6, 1e-6, 1e-6, 3e-5, 3e-5, 3e-5])
    paths = WALL[:2]
    rng = np.random.default_rng(11)
    repeats = 60
    found, chi = [], []
    for _ in range(repeats):
        r = hs.identify(m, paths, None, exact + sigma * rng.normal(size=(1, 6)), sigma=sigma)
        found.append(r.values)
        chi.append(r.reduced_chi_square)
    expected = hs.information(m, paths, columns=SIX, sigma=sigma)
    spread = np.cov(np.array(found).T)
    assert expected.relative_errors.max() < 0.05
    # A standard deviation of so many is itself known to 1/√(2 n), a correlation to 1/√n: four of these.
    assert np.abs(np.sqrt(np.diag(spread)) / expected.standard_errors - 1.0).max() < 4.0 / np.sqrt(2 * repeats)
    correlation = spread[0, 1] / np.sqrt(spread[0, 0] * spread[1, 1])
    assert abs(correlation - expected.correlation[0, 1]) < 4.0 / np.sqrt(repeats)
    off = np.mean(found, axis=0) - expected.values
    assert (np.abs(off) < 4.0 * expected.standard_errors / np.sqrt(repeats)).all()
    # Four of the six deflections are free.
    assert abs(np.mean(chi) - 1.0) < 4.0 * np.sqrt(2.0 / 4.0 / repeats)


def series(first: float, second: float) -> hs.Mechanism:
    """Two springs about one axis, one behind the other."""
    def hinge(at: str, between: tuple[str, str], v: float) -> hs.Joint:
        own = hs.Stiffness(x=1e9, y=1e9, z=1e9, u=1e7, w=1e7, v=v)
        return hs.Joint(at=at, between=between, kind=hs.Revolute(axis=(0, 0, 1)), stiffness=own)

    return hs.Mechanism(
        {
            "name": "series",
            "points": {"A": (0, 0, 0), "B": (0, 0, 0.1), "C": (0.2, 0.1, 0.1)},
            "bodies": {"hub": hs.Rigid(points=["A", "B"]), "arm": hs.Rigid(points=["B", "C"])},
            "joints": {
                "lower": hinge("A", ("ground", "hub"), first),
                "upper": hinge("B", ("hub", "arm"), second),
            },
            "loads": [hs.Load(on=("arm", "C"), force=(10.0, 20.0, 5.0))],
            "output": ("arm", "C"),
        }
    )


LOWER, UPPER = "joints.lower.stiffness.v", "joints.upper.stiffness.v"


def test_springs_in_series_are_told_not_to_be_told_apart() -> None:
    """A turn of M (1/a + 1/b) does not change by +1 % of a with -b/a % of b."""
    a, b = 400.0, 900.0
    true = series(1.2 * a, b)
    measured = true.sweep().displacement[:, :3]
    r = hs.identify(series(a, b), [LOWER, UPPER], None, measured, sigma=1e-6)
    assert len(r.indistinct) == 1
    weights, error = r.indistinct[0].weights, r.indistinct[0].error
    assert np.isinf(error) and np.isinf(r.standard_errors).all()
    assert np.isclose(weights[LOWER] / weights[UPPER], -r[LOWER] / r[UPPER], rtol=1e-5)
    assert LOWER in str(r.indistinct[0]) and "nothing that is measured" in str(r.indistinct[0])
    assert "cannot be told" in repr(r)
    # What they have in common is found.
    assert np.isclose(1.0 / r[LOWER] + 1.0 / r[UPPER], 1.0 / (1.2 * a) + 1.0 / b, rtol=1e-6)
    # One alone is known, beside the other.
    one = hs.identify(series(a, b), [LOWER], None, measured, sigma=1e-6)
    assert one.indistinct == [] and np.isclose(one[LOWER], 1.2 * a, rtol=1e-6)


def test_each_of_several_is_named_by_itself() -> None:
    """A stiffness that bears nothing, and springs in series: two combinations, not a mixture of them."""
    m = series(400.0, 900.0).with_loads([hs.Load(on=("arm", "C"), force=(10.0, 20.0, 0.0))])
    idle = "joints.lower.stiffness.y"
    told = hs.information(m, [LOWER, idle, UPPER], sigma=1e-6)
    assert sorted(map(len, (own.weights for own in told.indistinct))) == [1, 2]
    (alone,) = (own for own in told.indistinct if len(own.weights) == 1)
    assert list(alone.weights) == [idle] and str(alone) == f"`{idle}` shows in nothing that is measured"
    assert told.log_determinant < -50.0 or np.isneginf(told.log_determinant)


def test_what_hardly_shows_is_named() -> None:
    told = hs.information(arm(u=1e9), WALL, columns=SIX, sigma=[1e-6] * 3 + [1e-5] * 3)
    assert [list(own.weights)[0] for own in told.indistinct] == [WALL[0]]
    error = told.indistinct[0].error
    assert np.isfinite(error) and np.isclose(told.relative_errors[0], error, rtol=0.1)
    assert "hardly shows" in str(told.indistinct[0])


def log_det(m: hs.Mechanism, at: Array) -> float:
    return hs.information(m, PATHS, at, sigma=1e-6).log_determinant


def test_chosen_poses_are_the_best_of_all() -> None:
    """Against every choice of three poses of eight, and in what is told of the efficiency."""
    m, candidates = delta(), poses(8)
    choice = hs.choose_poses(m, PATHS, candidates, 3, sigma=1e-6)
    each = [hs.information(m, PATHS, candidates[[k]], sigma=1e-6).sensitivity for k in range(8)]

    def volume(own: tuple[int, ...]) -> float:
        s = np.concatenate([each[k] for k in own])
        return float(np.linalg.slogdet(s.T @ s)[1])

    every = {own: volume(own) for own in combinations(range(8), 3)}
    best = max(every, key=lambda own: every[own])
    assert tuple(choice.indices.tolist()) == best
    assert np.array_equal(choice.poses, candidates[list(best)])
    assert np.isclose(choice.information.log_determinant, every[best], rtol=1e-9)
    # What weights can reach, any share of the candidates, is no less.
    assert 0.5 < choice.efficiency <= 1.0
    bound = choice.information.log_determinant - 3 * np.log(choice.efficiency)
    twice = hs.choose_poses(m, PATHS, candidates, 3, sigma=1e-6, repeats=True)
    assert every[best] - 1e-9 <= twice.information.log_determinant <= bound + 1e-6
    assert twice.efficiency >= choice.efficiency - 1e-9


def test_chosen_poses_tell_more_than_random_ones() -> None:
    m, candidates = delta(), poses(60)
    choice = hs.choose_poses(m, PATHS, {"x": candidates[:, 0], "y": candidates[:, 1], "z": candidates[:, 2]}, 6)
    assert set(choice.poses) == {"x", "y", "z"} and choice.efficiency > 0.8
    s = hs.information(m, PATHS, candidates).sensitivity.reshape(60, 3, 3)
    rng = np.random.default_rng(3)
    for _ in range(300):
        own = s[rng.choice(60, 6, replace=False)].reshape(-1, 3)
        assert np.linalg.slogdet(own.T @ own)[1] < choice.information.log_determinant
    # Smaller errors in fact, too: of the volume they are in.
    assert "efficiency" in repr(choice)


def test_poses_out_of_reach_are_no_candidates() -> None:
    m = delta()
    candidates = np.concatenate([[[3.0, 0.0, 0.5]], poses(6)])
    choice = hs.choose_poses(m, PATHS, candidates, 3)
    assert 0 not in choice.indices
    with pytest.raises(hs.PoseError, match="pose 0 has no result"):
        hs.information(m, PATHS, candidates)
    with pytest.raises(hs.PoseError, match="pose 0 has no result"):
        hs.identify(m, PATHS, candidates, np.zeros((7, 3)))
    with pytest.raises(hs.PoseError):
        hs.choose_poses(m, PATHS, candidates[:1], 1)


def test_bounds_and_starts() -> None:
    m = arm()
    measured = arm(u=2.4e3, v=6e3).sweep().displacement
    sigma = [1e-6] * 3 + [1e-5] * 3
    free = hs.identify(m, WALL, None, measured, sigma=sigma, start={WALL[0]: 9e3})
    assert np.isclose(free[WALL[0]], 2.4e3, rtol=1e-6) and np.isclose(free[WALL[1]], 6e3, rtol=1e-6)
    held = hs.identify(m, WALL, None, measured, sigma=sigma, bounds={WALL[0]: (2.8e3, 1e4)})
    assert np.isclose(held[WALL[0]], 2.8e3, rtol=1e-3) and held.reduced_chi_square > free.reduced_chi_square


def test_several_that_are_alike_are_one_value() -> None:
    """And a length, which may be below zero."""
    m = series(400.0, 400.0)
    both = "joints.{lower|upper}.stiffness.v"
    measured = series(500.0, 500.0).with_values({"points.C.1": 0.12}).sweep().displacement[:, :3]
    r = hs.identify(m, [both, "points.C.1"], None, measured, sigma=1e-7)
    assert np.isclose(r[both], 500.0, rtol=1e-5) and np.isclose(r["points.C.1"], 0.12, rtol=1e-5)


def test_without_scipy(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "scipy.optimize", None)
    with pytest.raises(hs.MissingError, match="scipy") as caught:
        hs.identify(arm(), WALL, None, np.zeros((1, 3)))
    assert isinstance(caught.value, ImportError) and caught.value.code == "missing-package"
    # The rest needs none.
    assert hs.information(arm(), WALL[:1]).paths == (WALL[0],)


ZERO = np.zeros((1, 3))
WRONG: list[Callable[[], Any]] = [
    lambda: hs.identify(None, WALL, None, ZERO),  # type: ignore[arg-type]
    lambda: hs.identify(arm(), "joints.wall.stiffness.u", None, ZERO),
    lambda: hs.identify(arm(), [], None, ZERO),
    lambda: hs.identify(arm(), [WALL[0], WALL[0]], None, ZERO),
    lambda: hs.identify(arm(), ["joints.wall.stiffness.q"], None, ZERO),
    lambda: hs.identify(arm(), WALL, None, np.zeros(3)),
    lambda: hs.identify(arm(), WALL, None, "measured"),
    lambda: hs.identify(arm(), WALL, None, {}),
    lambda: hs.identify(arm(), WALL, None, {"storm": ZERO}),
    lambda: hs.identify(arm(), WALL, None, np.zeros((2, 3))),
    lambda: hs.identify(arm(), WALL, None, np.full((1, 3), np.nan)),
    lambda: hs.identify(arm(), WALL, None, np.zeros((1, 2))),
    lambda: hs.identify(arm(), WALL, None, np.zeros((1, 6))),
    lambda: hs.identify(arm(), WALL, None, ZERO, columns=["dx", "dy"]),
    lambda: hs.identify(arm(), WALL, None, ZERO, columns=["dx", "dy", "k11"]),
    lambda: hs.identify(arm(), WALL, None, ZERO, sigma=0.0),
    lambda: hs.identify(arm(), WALL, None, ZERO, sigma=[1.0, 2.0]),
    lambda: hs.identify(arm(), WALL, None, ZERO, start={"storm": 1.0}),
    lambda: hs.identify(arm(), WALL, None, ZERO, start={WALL[0]: 0.0}),
    lambda: hs.identify(arm(), WALL, None, ZERO, bounds={"storm": (0.0, 1.0)}),
    lambda: hs.identify(arm(), WALL, None, ZERO, bounds={WALL[0]: (2.0, 1.0)}),
    lambda: hs.choose_poses(delta(), PATHS, [[0.0, 0.0, 0.5]], 0),
    lambda: hs.choose_poses(delta(), PATHS, [[0.0, 0.0, 0.5]], 2),
    lambda: hs.choose_poses(delta(), PATHS, [[0.0, 0.0, 0.5]], 1, columns=["dx"]),
]


@pytest.mark.parametrize("call", WRONG, ids=range(len(WRONG)))
def test_what_is_wrong_is_told(call: Callable[[], Any]) -> None:
    with pytest.raises((hs.ArgumentError, hs.InputError, hs.SelectionError)) as caught:
        call()
    assert caught.value.message
