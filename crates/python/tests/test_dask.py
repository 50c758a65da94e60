"""Runs and sweeps on a cluster of processes, of which one is killed: the bytes of one machine."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from distributed import Client, LocalCluster

import hyperstat as hs
from hyperstat import _hyperstat

# Two jobs, with poses out of reach, in some tenths of a second.
BATCH = """(jobs: [
    (
        name: "map",
        mechanism: Delta(
            base_radius: 0.25, platform_radius: 0.06, arm_length: 0.30, rod_length: 0.60, rod_spacing: 0.12,
            arm: (section: Circle(diameter: 0.030), material: (young: 2.1e11, poisson: 0.3)),
            bar: (section: Circle(diameter: 0.020), material: (young: 2.1e11, poisson: 0.3)),
            rod: (section: Circle(diameter: 0.014), material: (young: 2.1e11, poisson: 0.3)),
        ),
        poses: Grid(x: (-0.45, 0.45, 61), y: (-0.4, 0.4, 41), z: (0.45, 0.55, 21)),
        loads: [(on: ("platform", "P"), force: (3.0, 0.0, -30.0))],
        figures: [Trajectory(scale: Auto), Map(value: "k33", plane: z(0.5))],
    ),
    (name: "bar", mechanism: File("portal.ron")),
])"""
ROWS = 61 * 41 * 21


@pytest.fixture(scope="module")
def client() -> Iterator[Client]:
    cluster = LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None)
    with cluster, Client(cluster) as client:
        yield client


class Killing:
    """Kills a worker as soon as something is done."""

    def __init__(self, client: Client) -> None:
        self.victim = min(client.run(os.getpid).values())
        self.told: list[tuple[int, int]] = []

    def __call__(self, done: int, total: int) -> None:
        if not self.told:
            os.kill(self.victim, signal.SIGKILL)
        self.told.append((done, total))


@pytest.fixture
def batch(tmp_path: Path, examples: Path) -> Path:
    path = tmp_path / "batch.ron"
    path.write_text(BATCH, encoding="utf-8")
    portal = (examples / "portal.ron").read_bytes()
    (tmp_path / "portal.ron").write_bytes(portal)
    return path


def results(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


@pytest.mark.parametrize("form", ["csv", "parquet"])
def test_a_run_leaves_the_bytes_of_one_machine(
    form: Any, client: Client, batch: Path, binary: Path, tmp_path: Path
) -> None:
    command = [binary, "run", batch, "--out", tmp_path / "whole", "--summary", "--format", form]
    assert subprocess.run(command, check=False, capture_output=True).returncode == 1
    killing, out = Killing(client), tmp_path / "out"
    found = hs.dask.run(client, batch, out, shards=20, progress=killing, format=form, summary=True)
    assert results(out) == results(tmp_path / "whole")
    assert list(found) == ["map", "bar"] and found["map"].rows == ROWS and found["bar"].rows == 1
    assert set(found["map"].failures) == {"unreachable"} and found["bar"].failures == {}
    assert found["map"].files[0] == out / f"map.{form}" and all(path.is_file() for path in found["map"].files)
    done = [done for done, _ in killing.told]
    assert len(done) == 20 and done == sorted(done) and killing.told[-1] == (ROWS, ROWS)
    assert killing.victim not in client.run(os.getpid).values()
    # What is done is not done again, and what is spoilt is told.
    part = sorted((out / "parts" / "map").glob(f"[0-9]*.{form}"))[3]
    part.write_bytes(part.read_bytes()[:-1])
    with pytest.warns(UserWarning, match="bytes, and had .* its rows were computed again"):
        hs.dask.run(client, batch, out, shards=20, format=form, summary=True)
    assert results(out) == results(tmp_path / "whole")
    with pytest.raises(hs.RunError, match="parts of another run: it was with `--summary`"):
        hs.dask.run(client, batch, out, format=form)


def test_a_sweep_is_that_of_one_machine(client: Client, examples: Path) -> None:
    m = hs.load(examples / "paper.ron", "delta-elastic-trajectory")
    rng = np.random.default_rng(5)
    poses = rng.uniform((-0.3, -0.3, 0.4), (0.3, 0.3, 0.7), (20_000, 3))
    # The first shards have all kinds of words, and only some of them.
    poses[:4000, 2] = 5.0
    asked: dict[str, Any] = {
        "cases": {"push": [hs.Load(on=("platform", "P"), force=(1, 2, 3))]},
        "columns": ["Stress", "Mass"],
    }
    whole = m.sweep(poses, **asked)
    own = hs.dask.sweep(client, m, poses, shards=9, progress=Killing(client), **asked)
    assert own.columns == whole.columns and repr(own) == repr(whole) and own.why == whole.why
    assert own.designs == whole.designs and list(own.further) == list(whole.further)
    for name in whole.columns:
        if whole[name].dtype.kind == "f":
            assert np.array_equal(own[name], whole[name], equal_nan=True), name
        else:
            assert own[name].dtype == whole[name].dtype and own[name].tolist() == whole[name].tolist(), name
    assert np.array_equal(own.measure("stress", "push"), whole.measure("stress", "push"), equal_nan=True)
    # As many shards as it takes.
    few = hs.dask.sweep(client, m, {"x": poses[:50, 0], "y": 0.0, "z": 0.5})
    assert np.array_equal(few.stiffness, m.sweep({"x": poses[:50, 0], "y": 0.0, "z": 0.5}).stiffness)


def test_what_fails_is_tried_again(client: Client, tmp_path: Path) -> None:
    def flaky(path: str) -> int:
        if not os.path.exists(path):
            open(path, "w").close()
            raise OSError("the disk is full")
        return 5

    each = [(str(tmp_path / "first"),), (str(tmp_path / "second"),)]
    assert sorted(hs.dask._each(client, flaky, each, [1, 3], 1, False)) == [(0, 5), (1, 5)]
    with pytest.raises(OSError, match="the disk is full"):
        list(hs.dask._each(client, flaky, [(str(tmp_path / "third"),)], [1], 0, False))


def test_mistakes_are_told_here(client: Client, batch: Path, examples: Path, tmp_path: Path) -> None:
    m = hs.load(examples / "paper.ron", "delta-elastic-trajectory")
    poses = np.zeros((10, 3))
    for wrong, told in [
        (lambda: hs.dask.run("cluster", batch, tmp_path), "is no client of a cluster"),
        (lambda: hs.dask.run(client, batch, tmp_path, shards=0), "0 shards"),
        (lambda: hs.dask.run(client, batch, tmp_path, retries=-1), "-1 retries"),
        (lambda: hs.dask.run(client, batch, tmp_path, format="xlsx"), "is no form of tables"),
        (lambda: hs.dask.sweep(client, "m", poses), "is no mechanism"),
        (lambda: hs.dask.sweep(client, m, poses, colums=["Mass"]), "there is no argument `colums`"),
        (lambda: hs.dask.sweep(client, m, poses, columns=["Masses"]), "Masses"),
    ]:
        with pytest.raises((hs.ArgumentError, hs.InputError), match=told):
            wrong()
    poses[7, 1] = np.nan
    with pytest.raises(hs.Error) as wrong_pose:
        m.sweep(poses)
    with pytest.raises(type(wrong_pose.value)) as same:
        hs.dask.sweep(client, m, poses, shards=5)
    assert str(same.value) == str(wrong_pose.value)
    batch.write_text(BATCH.replace("arm_length: 0.30", "arm_length: -0.30"), encoding="utf-8")
    with pytest.raises(hs.InputError, match="batch.ron:5:") as mistake:
        hs.dask.run(client, batch, tmp_path / "none")
    assert mistake.value.place is not None and not (tmp_path / "none").exists()
    # A table that was read is not written to.
    (tmp_path / "map.csv").write_text("x,y,z\n0,0,0.5\n", encoding="utf-8")
    before, after = BATCH.index("Grid("), BATCH.index("\n    ),\n    (name")
    batch.write_text(BATCH[:before] + 'Csv("map.csv"),' + BATCH[after:], encoding="utf-8")
    with pytest.raises(hs.RunError, match="map.csv would be overwritten: it was read"):
        hs.dask.run(client, batch, tmp_path)
    # Workers that do not see the folder.
    with pytest.raises(hs.RunError, match="cannot be used(.|\n)*help: every worker has to see this folder"):
        _hyperstat.run_share(tmp_path / "elsewhere", "0" * 64, 0, 4)


def test_without_dask_it_says_so() -> None:
    lines = [
        "import sys",
        "sys.modules['distributed'] = None",
        "import hyperstat as hs",
        "try:",
        "    hs.dask.run(None, 'batch.ron', 'out')",
        "except hs.MissingError as error:",
        "    print(error)",
    ]
    done = subprocess.run([sys.executable, "-c", "\n".join(lines)], capture_output=True, text=True, check=True)
    assert done.stdout == "Dask is not installed\n  help: pip install 'hyperstat[dask]', on the workers too\n"
