"""What Python finds is what the command line prints, to the last bit."""

from __future__ import annotations

import csv
import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

import hyperstat as hs
from hyperstat import Table


def run(binary: Path, *arguments: object) -> str:
    done = subprocess.run([binary, *map(str, arguments)], capture_output=True, text=True, check=False)
    assert done.returncode in (0, 1), done.stderr
    return done.stdout


def table(path: Path) -> dict[str, list[str]]:
    with path.open(newline="") as lines:
        rows = list(csv.reader(lines))
    return {name: [row[k] for row in rows[1:]] for k, name in enumerate(rows[0])}


def equal(found: Table, expected: dict[str, list[str]]) -> None:
    assert ["pose", *found.columns] == list(expected)
    for name in found.columns:
        own, wanted = found[name], expected[name]
        if name == "status" or own.dtype == object:
            assert [word or "" for word in own] == wanted, name
        else:
            numbers = np.array([float(cell) if cell else np.nan for cell in wanted])
            # Bit for bit: the same doubles, zeros of the same sign.
            assert np.array_equal(own, numbers, equal_nan=True), name
            assert np.array_equal(np.signbit(own), np.signbit(numbers)), name


SOLVED = [
    ("portal.ron", []),
    ("gripper.ron", []),
    ("delta_states.ron", []),
    ("paper.ron", ["--job", "delta-elastic-trajectory", "--pose", "7"]),
]


@pytest.mark.parametrize(("file", "choice"), SOLVED, ids=[file for file, _ in SOLVED])
def test_to_dict_is_the_json_of_solve(
    file: str, choice: list[str], examples: Path, binary: Path
) -> None:
    chosen = dict(zip(choice[::2], choice[1::2]))
    try:
        m = hs.load(examples / file, chosen.get("--job"), pose=int(chosen.get("--pose", 0)))
    except hs.SelectionError as error:
        # Of a batch of several jobs the first.
        job = (error.help or "").removeprefix("its jobs are ").split(", ")[0]
        choice = ["--job", job, *choice]
        m = hs.load(examples / file, job, pose=int(chosen.get("--pose", 0)))
    out = run(binary, "solve", examples / file, *choice, "--format", "json")
    assert m.solve().to_dict() == json.loads(out)
    why = run(binary, "solve", examples / file, *choice, "--format", "json", "--why", "--verify")
    assert m.solve(why=True, verify=True).to_dict() == json.loads(why)


def test_modes_are_those_of_the_command_line(examples: Path, binary: Path) -> None:
    out = run(binary, "solve", examples / "cantilever_modes.ron", "--modes", "4", "--format", "json")
    s = hs.load(examples / "cantilever_modes.ron").solve(modes=4)
    assert s.to_dict() == json.loads(out)
    assert len(s.frequencies) == 4 and (np.diff(s.frequencies) >= 0).all()


BATCHES = ["paper.ron", "delta_states.ron", "five_bar_sweep.ron", "prebuilt.ron", "delta_modes.ron"]


@pytest.mark.parametrize("file", BATCHES)
def test_sweeps_are_the_tables_of_run(
    file: str, examples: Path, binary: Path, tmp_path: Path
) -> None:
    run(binary, "run", examples / file, "--out", tmp_path)
    tables = sorted(tmp_path.glob("*.csv"))
    assert tables
    for path in tables:
        expected = table(path)
        m = hs.load(examples / file, path.stem)
        if m.designs == 1:
            t = m.sweep()
            equal(t, expected)
            again(m, t)


def again(m: hs.Mechanism, t: Table) -> None:
    """The same poses, handed in as an array, and one after another."""
    if t.drives:
        given = m.sweep(t.drives)
    elif np.isfinite(t.pose).all() and not np.any(t.pose[:, 3:]) and m.poses > 1:
        given = m.sweep(t.pose[:, :3])
        one = m.at(t.pose[0, :3])
        assert np.array_equal(one.stiffness, t.stiffness[0], equal_nan=True)
        assert np.array_equal(one.displacement, t.displacement[0], equal_nan=True)
        assert one.status == t.status[0]
        for name, found in one.cases.items():
            assert np.array_equal(found, t.cases[name].displacement[0])
    else:
        return
    assert np.array_equal(given.stiffness, t.stiffness, equal_nan=True)
    assert np.array_equal(given.displacement, t.displacement, equal_nan=True)
    assert given.status.tolist() == t.status.tolist()


def test_designs_are_those_of_the_command_line(
    examples: Path, binary: Path, tmp_path: Path
) -> None:
    run(binary, "run", examples / "designs.ron", "--out", tmp_path)
    for path in sorted(tmp_path.glob("*.csv")):
        expected = table(path)
        if "design" not in expected:
            continue
        count = len(set(expected["design"]))
        for design in {0, count - 1}:
            m = hs.load(examples / "designs.ron", path.stem, design)
            t = m.sweep()
            rows = [k for k, own in enumerate(expected["design"]) if own == str(design)]
            for name in ("status", "dz", "k11", "k66"):
                wanted = [expected[name][k] for k in rows]
                if name == "status":
                    assert t.status.tolist() == wanted
                else:
                    numbers = np.array([float(cell) if cell else np.nan for cell in wanted])
                    assert np.array_equal(t[name], numbers, equal_nan=True)
            assert list(expected)[1:] == t.columns
            for name, values in t.varied.items():
                wanted = [expected[name][k] for k in rows]
                assert [read(cell) for cell in wanted] == list(values), name


def read(cell: str) -> float | str:
    """What a cell of a column of designs holds."""
    try:
        return float(cell)
    except ValueError:
        return cell


def test_numbers_do_not_depend_on_threads(examples: Path) -> None:
    m = hs.load(examples / "paper.ron", "delta-elastic-trajectory")
    one, three, alone = m.sweep(threads=1), m.sweep(threads=3), m.sweep(one_by_one=True)
    assert np.array_equal(one.stiffness, three.stiffness)
    scale = np.max(np.abs(one.stiffness))
    assert np.max(np.abs(one.stiffness - alone.stiffness)) < 1e-12 * scale
