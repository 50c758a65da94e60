"""What calls are given means what it says, or is refused."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hyperstat as hs

POSES = [[0.0, 0.0, 0.5], [0.1, -0.05, 0.52]]


@pytest.fixture
def delta(examples: Path) -> hs.Mechanism:
    return hs.load(examples / "paper.ron", "delta-elastic-trajectory")


@pytest.fixture
def pushed(delta: hs.Mechanism) -> hs.Table:
    """With a case whose numbers are far from those of the job's own loads."""
    load = hs.Load(on=("platform", "P"), force=(300.0, -400.0, 5000.0))
    columns = ["Measures", "Stress"]
    return delta.sweep(POSES, cases={"push": [load]}, columns=columns)


@pytest.mark.parametrize("name", ["deflection", "rotation"])
def test_a_measure_of_a_case_is_of_the_case(pushed: hs.Table, name: str) -> None:
    """Even where there is a column of that name, of the loads outside cases."""
    part = slice(0, 3) if name == "deflection" else slice(3, 6)
    length = np.linalg.norm(pushed.cases["push"].displacement[:, part], axis=1)
    assert np.allclose(pushed.measure(name, "push"), length, rtol=1e-12)
    assert not np.allclose(pushed.measure(name), length, rtol=0.1)
    assert np.array_equal(pushed.measure(name), pushed[name])


def test_a_column_of_a_case_is_of_the_case(pushed: hs.Table) -> None:
    assert np.array_equal(pushed.measure("dz", "push"), pushed["push.dz"])
    assert not np.array_equal(pushed.measure("dz", "push"), pushed["dz"])
    assert np.array_equal(pushed.measure("stress", "push"), pushed["push.stress"])
    # No load changes these.
    assert np.array_equal(pushed.measure("k11", "push"), pushed["k11"])
    assert np.array_equal(pushed.measure("k21"), pushed["k12"])
    assert np.allclose(pushed.measure("softest_force", "push"), pushed.measure("softest_force"))
    with pytest.raises(hs.SelectionError) as caught:
        pushed.measure("deflection", "pusj")
    assert caught.value.code == "unknown-case" and caught.value.help == "did you mean `push`?"


def test_columns_without_a_case(delta: hs.Mechanism) -> None:
    load = hs.Load(on=("platform", "P"), force=(300.0, -400.0, 5000.0))
    t = delta.sweep(POSES, cases={"push": [load]}, columns=["Mass", "Stress"])
    with pytest.raises(hs.ArgumentError, match="not of a case"):
        t.measure("mass", "push")
    with pytest.raises(hs.ArgumentError, match="words"):
        t.measure("stress_at")


def test_a_measure_that_there_is_not(delta: hs.Mechanism) -> None:
    one = delta.at(POSES[0])
    assert one.measure("softest_force") > 0.0
    assert np.isnan(delta.at((3.0, 0.0, 0.5)).measure("softest_force"))
    for name in ("nonsense", "k11", ""):
        with pytest.raises(hs.ArgumentError, match="unknown measure"):
            one.measure(name)
        with pytest.raises(hs.ArgumentError, match="unknown measure"):
            delta.at((3.0, 0.0, 0.5)).measure(name)


def refused(call: Callable[[], object]) -> str:
    with pytest.raises(hs.Error) as caught:
        call()
    return str(caught.value)


NO_POSES: list[Any] = [
    {"x": 0.0},
    {"x": 0.0, "y": 0.0},
    {"x": 0.0, "y": 0.0, "z": np.nan},
    {"x": 0.0, "y": 0.0, "z": 0.5, "rx": 0.1},
    {"x": 0.0, "y": 0.0, "z": 0.5, "q": 0.1},
    {"A1.v": 0.1},
    {},
    (0.0, 0.0, np.nan),
    (np.inf, 0.0, 0.5),
    (0.0, 0.0, 0.5, 0.0, 0.0, 0.1),
    (0.0, 0.5),
]


@pytest.mark.parametrize("pose", NO_POSES, ids=range(len(NO_POSES)))
def test_a_pose_does_not_depend_on_those_before(delta: hs.Mechanism, pose: Any) -> None:
    """What is no pose of a sweep is none of `at`, whether it is the first or comes later."""
    first = refused(lambda: delta.with_values({}).at(pose))
    assert delta.at(POSES[0]).status == "ok"
    assert delta.at(dict(zip("xyz", POSES[1]))).status == "ok"
    assert refused(lambda: delta.at(pose)) == first == refused(lambda: delta.in_pose(pose))
    assert refused(lambda: delta.at(pose)) == first


def test_poses_of_drives_do_not_depend_on_those_before(examples: Path) -> None:
    m = hs.load(examples / "five_bar_sweep.ron", "five-bar-motion")
    t = m.sweep()
    last = {name: float(values[-1]) for name, values in t.drives.items()}
    assert np.array_equal(m.at(last).stiffness, t.stiffness[-1])
    for wrong in ({**last, "A9.v": 0.1}, {**last, "x": 0.1}, {"A1.v": np.nan, "A2.v": 0.0}):
        fresh = hs.load(examples / "five_bar_sweep.ron", "five-bar-motion")
        assert refused(lambda: m.at(wrong)) == refused(lambda: fresh.at(wrong))
    file = hs.load(examples / "portal.ron")
    assert "finite" in refused(lambda: file.at((0.0, 0.0, np.nan)))


def test_a_mapping_is_a_pose(delta: hs.Mechanism) -> None:
    class Own(Mapping[str, float]):
        def __getitem__(self, name: str) -> float:
            return dict(zip("xyz", POSES[1]))[name]

        def __iter__(self) -> Iterator[str]:
            return iter("zyx")

        def __len__(self) -> int:
            return 3

    expected = delta.at(POSES[1]).stiffness
    assert np.array_equal(delta.at(Own()).stiffness, expected)
    assert np.array_equal(delta.at(np.array(POSES[1])).stiffness, expected)
    assert np.array_equal(delta.sweep([POSES[1]]).stiffness[0], expected)
    solved = delta.in_pose(Own()).solve().stiffness
    assert np.allclose(solved, expected, rtol=1e-9, atol=1e-3)


def test_frames_are_taken_by_name(delta: hs.Mechanism) -> None:
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(POSES, columns=["x", "y", "z"])
    expected = delta.sweep(POSES)
    turned = frame[["z", "y", "x"]]
    for given in (frame, turned, frame.to_numpy(), pandas.DataFrame(POSES)):
        assert np.array_equal(delta.sweep(given).stiffness, expected.stiffness)
    assert np.array_equal(delta.at(turned.iloc[1]).stiffness, delta.at(POSES[1]).stiffness)
    assert "q" in refused(lambda: delta.sweep(frame.rename(columns={"z": "q"})))
    arrow = pytest.importorskip("pyarrow").Table.from_pandas(turned)
    assert np.array_equal(delta.sweep(arrow).stiffness, expected.stiffness)


def test_only_real_numbers_that_are_there(delta: hs.Mechanism) -> None:
    masked = np.ma.array(POSES, mask=[[False] * 3, [False, True, False]])
    whole = np.ma.array(POSES)
    for wrong in (masked, list(masked), np.array(POSES) + 0j, np.array(POSES).astype(str)):
        with pytest.raises(hs.ArgumentError):
            delta.sweep(wrong)
        with pytest.raises(hs.ArgumentError):
            delta.at(wrong[1])
    with pytest.raises(hs.ArgumentError):
        delta.sweep({"x": masked[:, 0], "y": masked[:, 1], "z": masked[:, 2]})
    with pytest.raises(hs.ArgumentError, match="different lengths"):
        delta.sweep({"x": [0.0, 0.1], "y": [0.0, 0.1, 0.2], "z": 0.5})
    assert delta.sweep(whole).ok.all()


SELECTED = (hs.ArgumentError, hs.SelectionError)
WRONG: list[Callable[[hs.Mechanism], object]] = [
    lambda m: hs.Mechanism(m.path),  # type: ignore[arg-type]
    lambda m: hs.Mechanism(None),  # type: ignore[arg-type]
    lambda m: hs.Mechanism([]),  # type: ignore[arg-type]
    lambda m: hs.Mechanism({"name": object()}),
    lambda m: hs.load(None),  # type: ignore[arg-type]
    lambda m: hs.load(m.path, 3),  # type: ignore[arg-type]
    lambda m: hs.load(m.path, m.job, "a"),  # type: ignore[arg-type]
    lambda m: m.with_loads([object()]),
    lambda m: m.solve(why=True, along=[1, 2]),
    lambda m: m.solve(why=True, along=3),  # type: ignore[arg-type]
    lambda m: m.solve(modes="3"),  # type: ignore[arg-type]
    lambda m: m.sweep(threads="4"),  # type: ignore[arg-type]
    lambda m: m.sweep(threads=-4),
    lambda m: m.value_and_gradient("k11", ["drive_stiffness"], threads=-4),
    lambda m: m.value_and_gradient("k11", ["drive_stiffness"], threads="4"),  # type: ignore[arg-type]
    lambda m: m.value_and_gradient("k11", "abc"),
    lambda m: m.value_and_gradient("k11", [3]),  # type: ignore[list-item]
    lambda m: m.evaluate({"rod.section.diameter": 0.01}),  # type: ignore[dict-item]
    lambda m: m.evaluate({"rod.section.diameter": "0.01"}),
    lambda m: m.evaluate([0.01]),  # type: ignore[arg-type]
    lambda m: m.with_values([0.01]),  # type: ignore[arg-type]
    lambda m: m.sweep({}),
    lambda m: m.sweep().measure("status"),
    lambda m: m.sweep().measure("deflection", "storm"),
    lambda m: m.sweep().cases["storm"],
    lambda m: m.sweep()["storm"],
    lambda m: m.solve().cases["storm"],
    lambda m: m.solve().joints["storm"],
    lambda m: m.solve().displacements["storm"],
]


@pytest.mark.parametrize("call", WRONG, ids=range(len(WRONG)))
def test_what_is_wrong_is_an_error_of_ours(delta: hs.Mechanism, call: Callable[[hs.Mechanism], object]) -> None:
    with pytest.raises(SELECTED) as caught:
        call(delta)
    assert caught.value.message and caught.value.code


def test_mappings_of_results_are_mappings(delta: hs.Mechanism) -> None:
    """What is not in them is a KeyError too, as `get` and `in` need it."""
    s = delta.solve()
    assert "storm" not in s.joints and s.joints.get("storm") is None
    t = delta.sweep(POSES)
    assert "storm" not in t.cases and t.cases.get("storm") is None
    with pytest.raises(KeyError):
        t.cases["storm"]
