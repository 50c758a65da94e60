"""Kinds of joints of one's own, against built-in ones and closed forms."""

from __future__ import annotations

import importlib.util
import pickle
import sys
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import pytest

import hyperstat as hs

Array = npt.NDArray[np.float64]
CANTILEVER = """(
    name: "cantilever",
    materials: { "steel": (young: 2.1e11, poisson: 0.3) },
    sections: { "rod": Circle(diameter: 0.02) },
    points: { "A": (0.0, 0.0, 0.0), "B": (0.3, 0.1, 0.2) },
    bodies: { "bar": Beam(through: ["A", "B"], section: "rod", material: "steel") },
    joints: { "wall": (at: "A", between: ("bar", "ground"), kind: KIND) },
    loads: [(on: ("bar", "B"), force: (3.0, -4.0, 5.0), moment: (1.0, 2.0, -1.0))],
    output: ("bar", "B"),
)"""


def solved(kind: str, *joints: hs.JointKind) -> Array:
    return hs.Mechanism(CANTILEVER.replace("KIND", kind), joints=joints).solve(allow_free=True).displacement


def spd() -> Array:
    rng = np.random.default_rng(4)
    root = rng.normal(size=(6, 6)) * np.array([1e-4, 1e-4, 1e-4, 1e-3, 1e-3, 1e-3])[:, None]
    return root @ root.T


def test_a_compliance_is_a_stiffness_matrix() -> None:
    c = spd()
    own = solved("Bushing", hs.JointKind("Bushing", compliance=c))
    k = np.linalg.inv(c)
    text = CANTILEVER.replace("kind: KIND", f"kind: Fixed, stiffness: Matrix({((k + k.T) / 2.0).tolist()})")
    expected = hs.Mechanism(text).solve().displacement
    # The inverse of a matrix of this condition is no better.
    assert np.allclose(own, expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())


def test_free_directions_are_those_of_built_in_kinds() -> None:
    """A revolute joint about y of its frame, a screw by its basis."""
    frame = "axis: (0.3, -1.0, 0.2)"
    hinge = hs.JointKind("Hinge", "v", frame="axis")
    basis = np.eye(6)
    pitch = 0.004
    basis[:, 4] = [0.0, pitch, 0.0, 0.0, 1.0, 0.0]
    thread = hs.JointKind("Thread", "v", frame="axis", basis=basis)
    lead = hs.JointKind("Lead", ["v"], frame="axis", arguments=["lead"], basis=screw)
    for own, built_in in (
        (f"Hinge({frame}), stiffness: (v: 2e3, x: 1e6)", f"Revolute({frame}), stiffness: (v: 2e3, x: 1e6)"),
        (f"Thread({frame}), stiffness: (v: 2e3)", f"Screw({frame}, pitch: {pitch}), stiffness: (v: 2e3)"),
        (f'Lead({frame}, lead: "4 mm/rad"), stiffness: (v: 2e3)', f"Screw({frame}, pitch: {pitch}), stiffness: (v: 2e3)"),
    ):
        found = solved(own, hinge, thread, lead)
        assert np.allclose(found, solved(built_in), rtol=1e-12, atol=0.0)


def screw(lead: float) -> Array:
    own = np.eye(6)
    own[1, 4] = lead
    return own


def _example() -> Any:
    """`examples/python/own_joint.py`, as a module that pickles find."""
    path = Path(__file__).resolve().parents[3] / "examples/python/own_joint.py"
    spec = importlib.util.spec_from_file_location("own_joint", path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["own_joint"] = module
    spec.loader.exec_module(module)
    return module


EXAMPLE = _example()
NAMES, SPRING, OFFSET = EXAMPLE.SIZES, EXAMPLE.SPRING, EXAMPLE.OFFSET


def test_the_lever_of_the_own_joints(examples: Path) -> None:
    """Hanging on its blades it turns by `F l / (2 E I / L)` (Haringx 1949), and bends."""
    text = (examples / "own-joints/lever.ron").read_text()
    text = text.replace('"bottom": (at: "D", between: ("rod", "ground"), kind: Spherical),', "")
    text = text.replace("kind: OffsetUniversal", "locked: true, kind: OffsetUniversal")
    m = hs.Mechanism(text, joints=[SPRING, OFFSET])
    s = m.solve()
    assert s.mobility == 3
    pivot = 2.0 * 2.1e11 * (0.01 * 0.0005**3 / 12.0) / 0.05
    lever = 50.0 * 0.3**2 / (2.0 * 2.1e11 * 0.02 * 0.03**3 / 12.0)
    assert np.isclose(s.displacement[4], 50.0 * 0.3 / pivot + lever, rtol=1e-9)


def test_the_lever_by_both_solvers_and_of_other_offsets(examples: Path) -> None:
    m = hs.load(examples / "own-joints/lever.ron", joints=[SPRING, OFFSET])
    verification = m.solve(verify=True)["verification"]
    assert verification["disagreements"] == [] and verification["stiffness"] < 1e-10
    # Functions are called anew for other arguments, in designs too.
    crossing = m.with_values({"joints.top.kind.offset": 0.0})
    text = (examples / "own-joints/lever.ron").read_text().replace(", offset: 0.015)", ")")
    built_in = hs.Mechanism(text.replace("OffsetUniversal", "Universal"), joints=[SPRING])
    expected = built_in.solve().stiffness
    assert np.allclose(crossing.solve().stiffness, expected, rtol=1e-10, atol=1e-10 * expected.max())
    t = m.evaluate({"joints.top.kind.offset": [0.0, 0.015]})
    assert np.allclose(t.stiffness[0], expected, rtol=1e-10, atol=1e-10 * expected.max())
    assert np.allclose(t.stiffness[1], m.solve().stiffness, rtol=1e-10, atol=1e-10 * expected.max())
    for again in (pickle.loads(pickle.dumps(m)), m.in_pose((0.0, 0.0, 0.0)) if m.poses > 1 else m):
        assert np.array_equal(again.solve().stiffness, m.solve().stiffness)


def test_joints_of_objects() -> None:
    data = {
        "name": "bar",
        "points": {"A": (0, 0, 0), "B": (0.2, 0, 0)},
        "bodies": {
            "bar": hs.Beam(
                through=["A", "B"],
                section=hs.Circle(diameter=0.01),
                material=hs.Material(young=2e11, poisson=0.3),
            )
        },
        "joints": {"J": hs.Joint(at="A", between=("bar", "ground"), kind=SPRING(axis=(0, 1, 0), **values()))},
        "output": ("bar", "B"),
    }
    assert hs.Mechanism(data, joints=[SPRING]).solve().stiffness[2, 2] > 0.0
    assert hs.JointKind("Pin", "w")() == "Pin"


def values() -> dict[str, float]:
    return dict(zip(NAMES, (0.05, 0.01, 0.0005, 0.7, 0.012, 2.1e11, 0.3)))


def test_what_is_wrong_is_told_at_its_place(examples: Path) -> None:
    path = examples / "own-joints/lever.ron"
    with pytest.raises(hs.InputError, match="unknown joint kind `CrossSpring`"):
        hs.load(path)

    def broken(**arguments: float) -> Array:
        raise ValueError("no such blades")

    kind = hs.JointKind("CrossSpring", "v", frame="axis", arguments=NAMES, compliance=broken)
    with pytest.raises(hs.InputError, match="ValueError: no such blades") as caught:
        hs.load(path, joints=[kind, OFFSET])
    assert caught.value.place is not None and "CrossSpring" in caught.value.place.text
    text = path.read_text()
    for right, wrong, message in (
        ("offset: 0.015", 'offset: "15 mn"', "`mn` is no unit"),
        ("offset: 0.015", "ofset: 0.015", "`offset`"),
        ("(1.0, 0.0, 0.0)), offset", "(0.0, 2.0, 0.0)), offset", "parallel"),
    ):
        assert right in text
        with pytest.raises(hs.InputError, match=message) as caught:
            hs.Mechanism(text.replace(right, wrong), joints=[SPRING, OFFSET])
        assert caught.value.place is not None and caught.value.place.line > 0
    # As of the command line, no file is written of kinds without a writer.
    with pytest.raises(hs.Error, match="CrossSpring"):
        hs.load(path, joints=[SPRING, OFFSET]).to_ron()


WRONG: list[Any] = [
    lambda: hs.JointKind(""),
    lambda: hs.JointKind("A joint"),
    lambda: hs.JointKind("Pin", "q"),
    lambda: hs.JointKind("Pin", frame="local"),  # type: ignore[arg-type]
    lambda: hs.JointKind("Pin", arguments="length"),
    lambda: hs.JointKind("Pin", arguments=["axis"]),
    lambda: hs.JointKind("Pin", compliance=np.eye(5)),
    lambda: hs.JointKind("Pin", compliance="soft"),
    lambda: hs.JointKind("Pin", compliance=np.full((6, 6), np.nan)),
    lambda: hs.JointKind("Pin", compliance=np.triu(np.ones((6, 6)))),
    lambda: hs.JointKind("Pin", compliance=-np.eye(6)),
    lambda: hs.JointKind("Pin", compliance=np.diag([1, 1, 1, 1, 1, 0]) + np.eye(6)[::-1] * 0.1),
    lambda: hs.JointKind("Pin", compliance=2 * np.ones((6, 6)) - np.eye(6)),
    lambda: hs.JointKind("Pin", basis=np.ones((6, 6))),
    lambda: hs.load("lever.ron", joints=["Pin"]),  # type: ignore[list-item]
    lambda: hs.load("lever.ron", joints=hs.Circle(diameter=1.0)),  # type: ignore[arg-type]
]


@pytest.mark.parametrize("make", WRONG, ids=range(len(WRONG)))
def test_kinds_that_are_none_are_refused(make: Any) -> None:
    with pytest.raises(hs.ArgumentError) as caught:
        make()
    assert caught.value.help
