"""Every error is one of hyperstat's, with its place, what would be right, and a code."""

from __future__ import annotations

import pickle
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import hyperstat as hs

BROKEN = sorted((Path(__file__).resolve().parents[2] / "mechanisms/tests/broken").glob("*.ron"))

BEAM = """(
    name: "beam",
    materials: { "steel": (young: 2.1e11, poisson: 0.3) },
    sections: { "rod": Circle(diameter: -0.014) },
    points: { "A": (0.0, 0.0, 0.0), "B": (0.0, 0.3, 0.2) },
    bodies: { "arm": Beam(through: ["A", "B"], section: "rod", material: "steel") },
    joints: { "base": (at: "A", between: ("ground", "arm"), kind: Fixed) },
    output: ("arm", "B"),
)"""


@pytest.mark.parametrize("path", BROKEN, ids=[path.stem for path in BROKEN])
def test_a_broken_file_says_where(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The message, the place and the help are those that the loader's tests know."""
    monkeypatch.chdir(path.parents[2])
    expected = path.with_suffix(".txt").read_text().splitlines()
    with pytest.raises(hs.Error) as caught:
        hs.load(path.relative_to(path.parents[2]))
    error = caught.value
    assert error.code == "input"
    assert str(error).splitlines()[0] == expected[0]
    helped = [line[4:] for line in expected if line.startswith("  = ")]
    if len(helped) == 1 and expected[-1].startswith("  = "):
        assert error.help == helped[0]


def test_a_text_has_places() -> None:
    with pytest.raises(hs.InputError) as caught:
        hs.Mechanism(BEAM)
    error = caught.value
    assert (error.place.path, error.place.line, error.place.column) == ("text", 4, 41)  # type: ignore[union-attr]
    assert error.code == "input" and isinstance(error, ValueError)
    assert str(error).splitlines()[0] == f"text:4:41: {error.message}"
    assert "-0.014" in str(error) and "^" in str(error)
    again = pickle.loads(pickle.dumps(error))
    assert str(again) == str(error) and again.place == error.place


def test_an_object_has_places() -> None:
    with pytest.raises(hs.InputError) as caught:
        hs.Delta(
            base_radius=0.25,
            platform_radius=0.06,
            arm_length=0.3,
            rod_length=-0.6,
            rod_spacing=0.12,
            **{name: hs.Link(section=hs.Circle(diameter=0.02), material=STEEL) for name in LINKS},
        )
    place = caught.value.place
    assert place is not None and '"rod_length": -0.6' in place.text


STEEL = hs.Material(young=2.1e11, poisson=0.3)
LINKS = ("arm", "bar", "rod")


@pytest.fixture
def delta(examples: Path) -> hs.Mechanism:
    return hs.load(examples / "paper.ron", "delta-elastic-trajectory")


WRONG: list[tuple[type[hs.Error], str, Callable[[hs.Mechanism], object]]] = [
    (hs.InputError, "input", lambda m: m.sweep(np.full((2, 3), np.nan))),
    (hs.InputError, "input", lambda m: m.sweep(np.ones((2, 6)))),
    (hs.InputError, "input", lambda m: m.sweep(np.zeros((0, 3)))),
    (hs.InputError, "input", lambda m: m.sweep({"q": [0.1]})),
    (hs.InputError, "input", lambda m: m.with_values({"rod.diameter": 0.1})),
    (hs.InputError, "input", lambda m: m.with_values({"rod.section.diameter": -0.1})),
    (hs.InputError, "input", lambda m: m.with_loads([{"on": ["platform", "Q"], "force": [0, 0, 1]}])),
    (hs.InputError, "input", lambda m: m.with_loads(nonsense=3)),
    (hs.ArgumentError, "argument", lambda m: m.sweep(np.ones(3))),
    (hs.ArgumentError, "argument", lambda m: m.sweep("abc")),
    (hs.ArgumentError, "argument", lambda m: m.solve(along="up")),  # type: ignore[arg-type]
    (hs.ArgumentError, "argument", lambda m: m.solve(along=(0, 0, 0), why=True)),
    (hs.ArgumentError, "argument", lambda m: m.at((0.0, 0.0))),
    (hs.InputError, "input", lambda m: m.at({"A.v": 1.0, "x": 1.0})),
    (hs.ArgumentError, "argument", lambda m: m.at("home")),  # type: ignore[arg-type]
    (hs.ArgumentError, "argument", lambda m: m.in_pose([1.0, "y", 2.0])),  # type: ignore[list-item]
    (hs.ArgumentError, "argument", lambda m: m.solve(modes=0)),
    (hs.ArgumentError, "argument", lambda m: m.sweep(threads=-1)),
    (hs.ArgumentError, "argument", lambda m: m.with_values({"rod.section.diameter": [1, 2]})),  # type: ignore[dict-item]
    (hs.SelectionError, "unknown-design", lambda m: hs.load(m.path, m.job, -1)),
    (hs.ArgumentError, "argument", lambda m: m.sweep().measure("stiffness")),
    (hs.SelectionError, "unknown-case", lambda m: m.solve(why=True, case="storm")),
    (hs.PoseError, "unreachable", lambda m: m.in_pose((5.0, 0.0, 0.5)).solve()),
]


@pytest.mark.parametrize(("kind", "code", "call"), WRONG, ids=range(len(WRONG)))
def test_what_is_wrong_is_told(
    kind: type[hs.Error], code: str, call: Callable[[hs.Mechanism], object], delta: hs.Mechanism
) -> None:
    with pytest.raises(kind) as caught:
        call(delta)
    assert caught.value.code == code and caught.value.message
    # It is as it was.
    assert delta.solve().stiffness is not None


def test_places_of_arguments(delta: hs.Mechanism) -> None:
    poses = np.array([[0.0, 0.0, 0.5], [0.0, np.inf, 0.5]])
    with pytest.raises(hs.InputError) as caught:
        delta.sweep(poses)
    assert str(caught.value.place) == "poses.1.y"
    with pytest.raises(hs.InputError) as caught:
        delta.sweep(poses[:1], loads=[{"on": ["platform", "P"], "force": [0, 0, "x"]}])
    assert caught.value.place is not None and caught.value.place.path == "loads"


def test_choices(examples: Path) -> None:
    with pytest.raises(hs.SelectionError) as caught:
        hs.load(examples / "paper.ron")
    assert caught.value.code == "job-not-chosen" and "delta-rigid-trajectory" in str(caught.value)
    with pytest.raises(hs.SelectionError, match="holds no job `x`"):
        hs.load(examples / "paper.ron", "x")
    with pytest.raises(hs.SelectionError, match="61"):
        hs.load(examples / "paper.ron", "delta-rigid-trajectory", pose=61)
    with pytest.raises(hs.SelectionError, match="mechanism file"):
        hs.load(examples / "portal.ron", design=1)
    with pytest.raises(hs.InputError, match="cannot be read"):
        hs.load(examples / "none.ron")


def test_what_is_not_held_is_named() -> None:
    free = BEAM.replace("-0.014", "0.014").replace("kind: Fixed", "kind: Revolute(axis: (1, 0, 0))")
    m = hs.Mechanism(free)
    with pytest.raises(hs.UnsolvableError) as caught:
        m.solve()
    assert caught.value.code == "free-output" and "base.v" in (caught.value.help or "")
    assert np.isnan(m.solve(allow_free=True).compliance).all()
    loaded = m.with_loads([hs.Load(on=("arm", "B"), force=(0.0, 0.0, -1.0))])
    with pytest.raises(hs.UnsolvableError, match="base"):
        loaded.solve()


def test_every_error_is_one(delta: hs.Mechanism) -> None:
    kinds = [own for own in vars(hs).values() if isinstance(own, type) and issubclass(own, Exception)]
    assert len(kinds) >= 7 and all(issubclass(own, hs.Error) for own in kinds)
