"""What can be pickled and copied."""

from __future__ import annotations

import copy
import pickle
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

import hyperstat as hs

POSE = (0.05, -0.1, 0.52)


def mechanisms(examples: Path) -> dict[str, hs.Mechanism]:
    job = hs.load(examples / "paper.ron", "delta-elastic-trajectory", pose=3)
    link = hs.Link(section=hs.Circle(diameter=0.02), material=hs.Material(young=2.1e11, poisson=0.3))
    built = hs.Delta(
        base_radius=0.25,
        platform_radius=0.06,
        arm_length=0.30,
        rod_length=0.60,
        rod_spacing=0.12,
        arm=link,
        bar=link,
        rod=link,
    )
    thicker = job.with_values({"rod.section": hs.Circle(diameter=0.02)})
    return {
        "file": hs.load(examples / "portal.ron"),
        "text": hs.Mechanism((examples / "portal.ron").read_text(encoding="utf-8")),
        "job": job,
        "design": hs.load(examples / "designs.ron", "delta-rods-and-arms", 3),
        "built": built,
        "changed": thicker.with_loads([hs.Load(on=("platform", "P"), force=(1, 2, 3))]),
        "posed": built.in_pose(dict(zip("xyz", POSE))),
    }


NAMES = ["file", "text", "job", "design", "built", "changed", "posed"]


@pytest.mark.parametrize("name", NAMES)
def test_mechanisms_are_pickled(name: str, examples: Path) -> None:
    m = mechanisms(examples)[name]
    for again in (pickle.loads(pickle.dumps(m)), copy.copy(m), copy.deepcopy(m)):
        assert type(again) is type(m) and repr(again) == repr(m) and again.poses == m.poses
        one = m if name != "built" else m.in_pose(POSE)
        other = again if name != "built" else again.in_pose(POSE)
        assert other.solve().to_dict() == one.solve().to_dict()
        assert np.array_equal(other.sweep().stiffness, one.sweep().stiffness)


def test_results_are_pickled(examples: Path) -> None:
    m = hs.load(examples / "paper.ron", "delta-elastic-trajectory")
    s = m.solve()
    # What is worked out when it is asked for goes along.
    s.displacements, s.joints, s.stiffness
    again = pickle.loads(pickle.dumps(s))
    assert again.to_dict() == s.to_dict() and np.array_equal(again.stiffness, s.stiffness)
    assert np.array_equal(again.joints["B1"].wrench, s.joints["B1"].wrench)
    load = hs.Load(on=("platform", "P"), force=(1, 2, 3))
    t = m.sweep(cases={"push": [load]}, columns=["Stress"])
    for table in (pickle.loads(pickle.dumps(t)), copy.deepcopy(t)):
        assert table.columns == t.columns and repr(table) == repr(t)
        assert np.array_equal(table.cases["push"].displacement, t.cases["push"].displacement)


def test_poses_are_pickled(examples: Path) -> None:
    m = hs.load(examples / "paper.ron", "delta-elastic-trajectory")
    load = hs.Load(on=("platform", "P"), force=(1, 2, 3))
    m = m.with_loads(cases={"push": [load]}, columns=["Stress", "Mass"])
    for pose in (POSE, (3.0, 0.0, 0.5)):
        one = m.at(pose)
        for again in (pickle.loads(pickle.dumps(one)), copy.copy(one), copy.deepcopy(one)):
            assert repr(again) == repr(one) and (again.status, again.why) == (one.status, one.why)
            assert again.keys() == one.keys() and len(again.keys()) > 6
            for name in ("pose", "stiffness", "displacement"):
                assert np.array_equal(getattr(again, name), getattr(one, name), equal_nan=True)
            for name in one.keys():
                assert again[name] == one[name] or (again[name] != again[name] and one[name] != one[name])
            assert np.array_equal(again.cases["push"], one.cases["push"], equal_nan=True)
            for name in ("deflection", "softest_force"):
                assert np.array_equal(again.measure(name), one.measure(name), equal_nan=True)


def test_a_pose_whose_output_is_rigid_is_pickled() -> None:
    text = """(
        name: "held",
        points: { "A": (0.0, 0.0, 0.0) },
        bodies: { "block": Rigid(points: ["A"]) },
        joints: { "J": (at: "A", between: ("ground", "block"), kind: Revolute(axis: (0.0, 0.0, 1.0)),
            stiffness: (v: 100.0)) },
        loads: [(on: ("block", "A"), moment: (0.0, 0.0, 2.0))],
        output: ("block", "A"),
    )"""
    one = hs.Mechanism(text).at((0.0, 0.0, 0.0))
    again = pickle.loads(pickle.dumps(one))
    assert again.status == one.status == "rigid" and again.why == one.why is not None
    assert np.array_equal(again.displacement, one.displacement) and np.isclose(one.displacement[5], 0.02)
    assert np.isnan(again.stiffness).all()


def _solved(m: hs.Mechanism) -> float:
    return float(m.solve().stiffness[0, 0])


def test_mechanisms_go_to_other_processes(examples: Path) -> None:
    m = hs.load(examples / "portal.ron")
    many = [m.with_values({"sections.rod.diameter": own}) for own in (0.012, 0.014)]
    with get_context("spawn").Pool(1) as pool:
        assert pool.map(_solved, many) == [_solved(own) for own in many]
