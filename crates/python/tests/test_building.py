"""Mechanisms that are built of objects are those of files."""

from __future__ import annotations

import json
import runpy
from pathlib import Path

import numpy as np
import pytest

import hyperstat as hs

FOLDER = Path(__file__).resolve().parents[1]
STEEL = hs.Material(young=2.1e11, poisson=0.3)


def portal() -> hs.Mechanism:
    """`examples/portal.ron`."""
    return hs.Mechanism(
        {
            "name": "portal",
            "points": {"A": (0, 0, 0), "B": np.array([0, 0.3, 0.2]), "C": (0.1, 0.5, 0.2)},
            "bodies": {
                "arm": hs.Beam(through=["A", "B"], section=hs.Circle(diameter="14 mm"), material=STEEL),
                "platform": hs.Rigid(points=["B", "C"]),
            },
            "joints": {
                "shoulder": hs.Joint(
                    at="A",
                    between=("ground", "arm"),
                    kind=hs.Revolute(axis=(1, 0, 0)),
                    locked=True,
                ),
                "wrist": hs.Joint(
                    at="B",
                    between=("arm", "platform"),
                    kind="Fixed",
                    stiffness=hs.Stiffness(x=1e8, y=1e8, z=1e8),
                ),
            },
            "loads": [hs.Load(on=("platform", "C"), force=(0, 0, -50))],
            "output": ("platform", "C"),
        }
    )


def same(one: hs.Mechanism, other: hs.Mechanism) -> None:
    a, b = one.solve(), other.solve()
    assert np.array_equal(a.stiffness, b.stiffness)  # type: ignore[arg-type]
    assert np.array_equal(a.displacement, b.displacement)
    for name, joint in b.joints.items():
        assert np.array_equal(a.joints[name].wrench, joint.wrench)  # type: ignore[arg-type]


def test_a_file_of_objects(examples: Path) -> None:
    file = hs.load(examples / "portal.ron")
    built = portal()
    same(built, file)
    # And back: what is written reads the same.
    same(hs.Mechanism(built.to_ron()), file)
    same(hs.Mechanism(built.to_json()), file)
    same(hs.Mechanism(json.loads(built.to_json())), file)


def test_sections_and_materials_of_beams_get_names() -> None:
    rod = hs.Circle(diameter=0.014)
    m = hs.Mechanism(
        {
            "name": "two",
            "materials": {"steel": STEEL},
            "points": {"A": (0, 0, 0), "B": (1, 0, 0), "C": (2, 0, 0)},
            "bodies": {
                "a": hs.Beam(through=["A", "B"], section=rod, material="steel"),
                "b": hs.Frame(
                    members=[hs.Member(through=["B", "C"], section=hs.Tube(outer=0.03, inner=0.02))],
                    material=hs.Material(young=7e10, shear=2.6e10),
                ),
            },
            "joints": {
                "J": hs.Joint(at="A", between=("ground", "a"), kind=hs.Fixed()),
                "K": hs.Joint(at="B", between=("a", "b"), kind=hs.Fixed()),
            },
            "output": ("b", "C"),
        }
    )
    written = json.loads(m.to_json())
    assert len(written["sections"]) == 2 and len(written["materials"]) == 2
    assert m.solve().stiffness is not None


def test_sections_of_groups_get_names() -> None:
    """Beside those of the mechanism, of which they may have the names."""
    group = hs.Group(
        points={"C": (1, 0, 0), "D": (1, 1, 0)},
        bodies={"arm": hs.Beam(through=["C", "D"], section=hs.Circle(diameter=0.02), material=STEEL)},
        joints={"K": hs.Joint(at="C", between=("beam", "arm"), kind="Fixed")},
    )
    fields = {
        "name": "chain",
        "points": {"A": (0, 0, 0)},
        "bodies": {"beam": hs.Beam(through=["A", "C1"], section=hs.Circle(diameter=0.03), material=STEEL)},
        "groups": {"tip": group},
        "copies": {"tip": hs.Copies(places=hs.Moved(by=[(0, 0, 0)]))},
        "joints": {"J": hs.Joint(at="A", between=("ground", "beam"), kind="Fixed")},
        "output": ("arm1", "D1"),
    }
    named = {
        **fields,
        "materials": {"steel": STEEL},
        "sections": {"thin": hs.Circle(diameter=0.02), "thick": hs.Circle(diameter=0.03)},
        "bodies": {"beam": hs.Beam(through=["A", "C1"], section="thick", material="steel")},
    }
    held = hs.Mechanism(fields).solve()
    assert np.array_equal(held.stiffness, hs.Mechanism(named).solve().stiffness)
    # Of another section it is another mechanism.
    group.bodies["arm"].section = hs.Circle(diameter=0.01)  # type: ignore[attr-defined]
    assert hs.Mechanism(fields).solve().stiffness[2, 2] < held.stiffness[2, 2]


def test_names_that_are_given_stay_free() -> None:
    """A beam that names a section of no table does not get that of another beam."""
    beams = {
        "a": hs.Beam(through=["A", "B"], section=hs.Circle(diameter=0.02), material=STEEL),
        "b": hs.Beam(through=["B", "C"], section="a", material=STEEL),
    }
    fields = {
        "name": "two",
        "points": {"A": (0, 0, 0), "B": (1, 0, 0), "C": (2, 0, 0)},
        "bodies": beams,
        "joints": {
            "J": hs.Joint(at="A", between=("ground", "a"), kind="Fixed"),
            "K": hs.Joint(at="B", between=("a", "b"), kind="Fixed"),
        },
        "output": ("b", "C"),
    }
    with pytest.raises(hs.InputError, match="`a`"):
        hs.Mechanism(fields)
    given = hs.Mechanism({**fields, "sections": {"a": hs.Circle(diameter=0.01)}})
    beams["b"].section = hs.Circle(diameter=0.01)  # type: ignore[attr-defined]
    assert np.array_equal(given.solve().stiffness, hs.Mechanism(fields).solve().stiffness)
    beams["b"].section = "a"  # type: ignore[attr-defined]
    with pytest.raises(hs.InputError):
        hs.Mechanism({**fields, "sections": []})


LINK = {"section": hs.Circle(diameter=0.014), "material": hs.Material(young=2.1e11, poisson=0.3)}


def delta(**fields: object) -> hs.Delta:
    material = hs.Material(young=2.1e11, poisson=0.3, density=7850.0)
    arm, bar, rod = (
        hs.Link(section=hs.Circle(diameter=own), material=material) for own in (0.03, 0.02, 0.014)
    )
    return hs.Delta(
        base_radius=0.25,
        platform_radius=0.06,
        arm_length=0.30,
        rod_length=0.60,
        rod_spacing=0.12,
        arm=arm,
        bar=bar,
        rod=rod,
        **fields,  # type: ignore[arg-type]
    )


def test_a_prebuilt_one_of_objects(examples: Path) -> None:
    stiffness = hs.Stiffness(x=1e8, y=1e8, z=1e8, u=1e5, w=1e5)
    built = delta(joint_stiffness=stiffness)
    job = hs.load(examples / "paper.ron", "delta-elastic-trajectory")
    t = job.sweep()
    given = built.sweep(t.pose[:, :3])
    assert np.array_equal(given.stiffness, t.stiffness)
    assert built.at(t.pose[0, :3]).status == "ok"
    with pytest.raises(hs.ArgumentError, match="no pose"):
        built.solve()
    with pytest.raises(hs.ArgumentError, match="no pose"):
        built.sweep()
    k = built.in_pose(t.pose[0, :3]).solve().stiffness
    assert k is not None and np.allclose(k, t.stiffness[0], rtol=1e-9, atol=1e-3)
    thicker = built.with_values({"rod.section.diameter": 0.02}).in_pose((0, 0, 0.5))
    assert thicker.solve().stiffness[2, 2] > built.at((0, 0, 0.5)).stiffness[2, 2]  # type: ignore[index]


def test_a_prebuilt_one_in_a_batch() -> None:
    built = delta(joint_stiffness=hs.Stiffness(x=1e8, y=1e8, z=1e8, u=1e5, w=1e5))
    poses = [(0.0, 0.0, 0.5), (0.1, -0.05, 0.52)]
    job = hs.Mechanism({"jobs": [{"name": "a", "mechanism": built, "poses": {"List": poses}}]})
    assert np.array_equal(job.sweep().stiffness, built.sweep(poses).stiffness)
    assert built.to_data()["Delta"]["base_radius"] == 0.25


def test_values_may_be_parts(examples: Path) -> None:
    """In files of either format, of jobs and of prebuilt mechanisms."""
    thick = hs.Circle(diameter=0.02)
    files = [hs.load(examples / "portal.ron"), portal(), hs.load(examples / "portal.ron").with_loads([])]
    for m, path in zip(files, ("sections.rod", "sections.arm", "sections.rod")):
        wanted = m.with_values({f"{path}.diameter": 0.02}).solve().stiffness
        assert np.array_equal(m.with_values({path: thick}).solve().stiffness, wanted)
        t = m.evaluate({path: [hs.Circle(diameter=0.014), thick, hs.Tube(outer=0.02, inner=1e-5)]})
        assert t.ok.all() and np.allclose(t.stiffness[1], wanted, rtol=1e-9, atol=1e-3)
        other = m.with_values({"joints.wrist.stiffness": hs.Stiffness(x=1e8, y="100 N/um", z=1e8)})
        assert np.array_equal(other.solve().stiffness, m.solve().stiffness)
    link = hs.Link(section=thick, material=STEEL)
    built = delta().with_values({"rod": link})
    wanted = delta().with_values({"rod.section.diameter": 0.02}).at((0, 0, 0.5)).stiffness
    assert np.array_equal(built.at((0, 0, 0.5)).stiffness, wanted)
    with pytest.raises(hs.InputError, match="diameter"):
        files[0].with_values({"sections.rod": hs.Circle(diameter=-0.02)})


def test_a_mechanism_out_of_reach_is_shown() -> None:
    m = delta().in_pose((5.0, 0.0, 0.5))
    assert "<b>" in m._repr_html_() and "hyperstat.Mechanism" in m._repr_html_()


def test_a_prebuilt_one_without_poses() -> None:
    m = hs.SingleFreedom(
        lengths=(0.2, 0.2),
        sections=(hs.Circle(diameter=0.02), hs.Circle(diameter=0.02)),
        material=STEEL,
        joint_stiffness=(1e8, 1e8),
    )
    assert m.solve().stiffness is not None


def test_classes_are_those_of_the_schema() -> None:
    """Written by `generate.py`: run it where this fails."""
    generate = runpy.run_path(str(FOLDER / "generate.py"))
    own = (FOLDER / "python/hyperstat/parts.py").read_text(encoding="utf-8")
    assert generate["written"](hs.schema()) == own


def test_every_prebuilt_one_has_a_class() -> None:
    definitions = json.loads(hs.schema())["$defs"]
    kinds = set(definitions["job_mechanism"]["properties"]) - {"File"}
    assert kinds and kinds <= set(hs.__all__)


def test_parts_tell_what_they_are() -> None:
    assert repr(hs.Circle(diameter=0.014)) == "Circle(diameter=0.014)"
    assert hs.Circle(diameter=0.014) == hs.Circle(diameter=0.014) != hs.Circle(diameter=0.02)
    load = hs.Load(on="arm", per_length=(0, 0, 1), from_=(0, 0, 1))
    assert load.to_data()["from"] == [0, 0, 1]
    assert hs.Fixed().to_data() == "Fixed"
    assert repr(portal()) == "<hyperstat.Mechanism 'portal'>"
    assert "mobility" in portal()._repr_html_()
    assert "<table>" in portal().solve()._repr_html_()
