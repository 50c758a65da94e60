"""Sweeps from Python: rows without a result, threads, interrupts, memory, tables of others."""

from __future__ import annotations

import gc
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import hyperstat as hs


@pytest.fixture
def delta(examples: Path) -> hs.Mechanism:
    return hs.load(examples / "paper.ron", "delta-elastic-trajectory")


def grid(count: int) -> np.ndarray:
    """Poses that the delta reaches, `count` along each axis."""
    x = np.linspace(-0.15, 0.15, count)
    z = np.linspace(0.45, 0.55, count)
    return np.stack([own.ravel() for own in np.meshgrid(x, x, z, indexing="ij")], axis=1)


def test_rows_without_a_result_are_nan(delta: hs.Mechanism) -> None:
    t = delta.sweep([[0.0, 0.0, 0.5], [3.0, 0.0, 0.5], [0.1, 0.0, 0.5]])
    assert t.status.tolist() == ["ok", "unreachable", "ok"]
    assert np.isnan(t.stiffness[1]).all() and np.isnan(t.displacement[1]).all()
    assert np.isfinite(t.stiffness[[0, 2]]).all()
    assert list(t.why) == ["unreachable"] and t.why["unreachable"]
    one = delta.at((3.0, 0.0, 0.5))
    assert one.status == "unreachable" and one.why and np.isnan(one.stiffness).all()
    assert (t.pose[1, 0], t.pose[1, 2]) == (3.0, 0.5)
    # Even where it is the first pose that is asked.
    fresh = delta.with_values({"rod.section.diameter": 0.014})
    assert fresh.at((3.0, 0.0, 0.5)).status == "unreachable"
    assert fresh.at((0.0, 0.0, 0.5)).status == "ok"


def test_a_pose_is_a_row_of_a_sweep(delta: hs.Mechanism) -> None:
    poses = grid(4)
    t = delta.sweep(poses)
    for row, pose in enumerate(poses):
        one = delta.at(pose)
        assert np.array_equal(one.stiffness, t.stiffness[row])
        assert np.array_equal(one.displacement, t.displacement[row])
        assert np.array_equal(one.pose, t.pose[row])
        assert one.measure("softest_force") == t.measure("softest_force")[row]


def test_a_pose_is_a_solution(delta: hs.Mechanism) -> None:
    pose = (0.05, -0.1, 0.52)
    s = delta.in_pose(pose).solve()
    one = delta.at(pose)
    assert s.stiffness is not None
    scale = np.sqrt(np.outer(np.diag(s.stiffness), np.diag(s.stiffness)))
    assert np.max(np.abs(one.stiffness - s.stiffness) / scale) < 1e-12
    assert np.max(np.abs(one.displacement - s.displacement)) < 1e-10 * np.max(np.abs(s.displacement))


def test_loads_and_cases(delta: hs.Mechanism) -> None:
    poses = [[0.0, 0.0, 0.5], [0.1, 0.0, 0.5]]
    force, moment = [3.0, -4.0, 50.0], [1.0, 2.0, -3.0]
    load = hs.Load(on=("platform", "P"), force=force, moment=moment)
    t = delta.sweep(poses, loads=[load], cases={"push": [load], "none": []}, columns=["Measures"])
    wrench = np.array(force + moment)
    for row in range(2):
        expected = np.linalg.solve(t.stiffness[row], wrench)
        assert np.allclose(t.displacement[row], expected, rtol=1e-9, atol=1e-18)
        assert np.allclose(t.compliance[row] @ wrench, expected, rtol=1e-9, atol=1e-18)
    assert np.allclose(t.cases["push"].displacement, t.displacement, rtol=1e-12)
    assert not t.cases["none"].displacement.any()
    assert np.allclose(t.measure("deflection"), np.linalg.norm(t.displacement[:, :3], axis=1))
    assert np.allclose(t.measure("deflection", "push"), t["push.deflection"], rtol=1e-12)
    # Its own loads stay.
    assert delta.cases == [] and delta.sweep(poses).cases == {}
    named = delta.with_loads(cases={"push": [load]})
    assert named.cases == ["push"]
    assert np.array_equal(named.at(poses[0]).cases["push"], named.sweep(poses).cases["push"].displacement[0])


def test_values_and_designs(delta: hs.Mechanism) -> None:
    poses = grid(3)
    diameters = [0.012, 0.014, 0.02]
    t = delta.evaluate({"rod.section.diameter": diameters}, poses)
    assert t.by_design(t.stiffness).shape == (3, 27, 6, 6)
    for k, diameter in enumerate(diameters):
        one = delta.with_values({"rod.section.diameter": diameter}).sweep(poses)
        assert np.allclose(one.stiffness, t.by_design(t.stiffness)[k], rtol=1e-10, atol=1e-3)
    bad = delta.evaluate({"rod.section.diameter": [0.014, -1.0]}, poses[:2])
    assert bad.status.tolist() == ["ok", "ok", "design", "design"]


def test_designs_are_columns(delta: hs.Mechanism) -> None:
    """As in the command line's table: the number of the design and what varies, behind all others."""
    sections = [hs.Circle(diameter=0.03), "Circle(diameter: 0.025)"]
    t = delta.evaluate({"rod.section.diameter": [0.012, 0.014], "arm.section": sections}, grid(2))
    assert t.columns[-3:] == ["design", "rod.section.diameter", "arm.section"]
    assert t["design"].tolist() == [0] * 8 + [1] * 8
    assert t["rod.section.diameter"].tolist() == [0.012] * 8 + [0.014] * 8
    assert t["arm.section"][[0, 8]].tolist() == ["Circle(diameter: 0.03)", "Circle(diameter: 0.025)"]
    assert np.array_equal(t.measure("rod.section.diameter"), t["rod.section.diameter"])
    assert "design" not in delta.sweep(grid(2)).columns
    pytest.importorskip("pandas")
    assert list(t.to_pandas().groupby("design")["k33"].count()) == [8, 8]


def test_a_design_of_a_job_has_its_columns(examples: Path) -> None:
    """Those that the command line's table has: number and values of the design."""
    path = examples / "designs.ron"
    m = hs.load(path, "delta-rods-and-arms", 3)
    t = m.sweep()
    assert t.columns[-3:] == ["design", *list(t.varied)[1:]] and set(t["design"]) == {3}
    first = hs.load(path, "delta-rods-and-arms").sweep()
    assert set(first["design"]) == {0} and first.columns == t.columns
    # The values are those that the mechanism has.
    paths = list(t.varied)[1:]
    for name in paths:
        own = hs.load(path, "delta-rods-and-arms").with_values({p: t[p][0] for p in paths}).sweep()
        assert np.array_equal(own.stiffness, t.stiffness, equal_nan=True) and "design" not in own.columns
        assert t.measure(name)[0] == t[name][0]
    # Other poses and loads are of the same design.
    other = m.sweep(t.pose[:2, :3], loads=[])
    assert other.varied["design"].tolist() == [3, 3] and other[paths[0]][0] == t[paths[0]][0]
    assert "design" not in m.evaluate({paths[0]: [t[paths[0]][0]]}).columns[:-2]
    assert list(m.evaluate({paths[0]: [0.01, 0.02]}, t.pose[:1, :3])["design"]) == [0, 1]


def test_columns_of_words_are_so_without_a_result(delta: hs.Mechanism) -> None:
    columns = ["Stress", "Utilisation"]
    strong = hs.Material(young=2.1e11, poisson=0.3, yield_=3.55e8)
    delta = delta.with_values({"rod.material": strong})
    some = delta.sweep([[0.0, 0.0, 0.5], [3.0, 0.0, 0.5]], columns=columns)
    none = delta.sweep([[3.0, 0.0, 0.5]], columns=columns)
    for name, own in none.further.items():
        if name.endswith("_at"):
            assert own.dtype == object and own.tolist() == [None]
        else:
            assert own.dtype == np.float64 and np.isnan(own).all()
    assert some["stress_at"].dtype == object and isinstance(some["stress_at"][0], str)


def test_drives_are_columns(examples: Path) -> None:
    m = hs.load(examples / "five_bar_sweep.ron", _first_job(examples / "five_bar_sweep.ron"))
    t = m.sweep()
    if t.drives:
        first = {name: float(values[0]) for name, values in t.drives.items()}
        assert np.array_equal(m.at(first).stiffness, t.stiffness[0], equal_nan=True)


def _first_job(path: Path) -> str | None:
    try:
        hs.load(path)
    except hs.SelectionError as error:
        return (error.help or "").removeprefix("its jobs are ").split(", ")[0]
    return None


def test_another_thread_goes_on(delta: hs.Mechanism) -> None:
    poses = np.tile(grid(20), (20, 1))
    seen: list[float] = []
    ended = threading.Event()

    def count() -> None:
        while not ended.is_set():
            seen.append(time.perf_counter())
            time.sleep(0.001)

    other = threading.Thread(target=count)
    other.start()
    begun = time.perf_counter()
    delta.sweep(poses)
    took = time.perf_counter() - begun
    ended.set()
    other.join()
    during = [own for own in seen if begun < own < begun + took]
    # A thousand a second where nobody is in its way; the cores are busy.
    assert took > 0.05 and len(during) > 50 * took, (took, len(during))


def test_many_threads_at_once(delta: hs.Mechanism) -> None:
    poses = grid(6)
    expected = delta.sweep(poses).stiffness
    found: list[bool] = []

    def work() -> None:
        same = [np.array_equal(delta.sweep(poses).stiffness, expected) for _ in range(3)]
        same += [np.array_equal(delta.at(poses[7]).stiffness, expected[7]) for _ in range(50)]
        same.append(delta.solve().stiffness is not None)
        found.extend(same)

    threads = [threading.Thread(target=work) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 6 * 54 and all(found)


def test_progress_and_what_ends_a_sweep(delta: hs.Mechanism) -> None:
    poses = np.tile(grid(16), (20, 1))
    told: list[tuple[int, int]] = []
    delta.sweep(poses, progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (len(poses), len(poses)) and sorted(told) == told

    class Enough(Exception):
        pass

    def stop(done: int, total: int) -> None:
        raise Enough

    with pytest.raises(Enough):
        delta.sweep(poses, progress=stop)
    assert delta.sweep(poses[:3]).ok.all()


def _interrupted(call: Callable[[], object]) -> float:
    """Seconds from an interrupt to its exception."""
    sent: list[float] = []

    def send() -> None:
        sent.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(0.2, send)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        call()
    return time.perf_counter() - sent[0]


def test_an_interrupt_ends_what_takes_long(delta: hs.Mechanism) -> None:
    """Within half a second: it is looked for twenty times a second, however long a pose takes."""
    poses = np.tile(grid(20), (100, 1))
    paths = ["rod.section.diameter", "joint_stiffness.x", "arm_length"]
    assert _interrupted(lambda: delta.sweep(poses, one_by_one=True)) < 0.5
    assert _interrupted(lambda: delta.sweep(poses[:20000], columns=["Budget"], one_by_one=True)) < 0.5
    assert _interrupted(lambda: delta.value_and_gradient("deflection", paths, poses)) < 0.5
    # And what comes next goes as ever.
    assert delta.sweep(poses[:3]).ok.all()


def test_progress_of_what_is_called_from_another_thread(delta: hs.Mechanism) -> None:
    told: list[int] = []
    poses = np.tile(grid(16), (20, 1))
    thread = threading.Thread(target=lambda: delta.sweep(poses, progress=lambda done, _: told.append(done)))
    thread.start()
    thread.join()
    assert told[-1] == len(poses)


def test_a_forked_process_has_threads_of_its_own(delta: hs.Mechanism) -> None:
    poses = grid(3)
    expected = delta.sweep(poses).stiffness
    child = os.fork()
    if child == 0:
        signal.alarm(60)
        os._exit(0 if np.array_equal(delta.sweep(poses).stiffness, expected) else 1)
    assert os.waitpid(child, 0)[1] == 0


@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_a_process_that_is_forked_while_others_compute(examples: Path, delta: hs.Mechanism) -> None:
    """What other threads are at in a call of the same mechanism is not there in the child."""
    poses = grid(3)
    expected = delta.sweep(poses).stiffness
    portal = hs.load(examples / "portal.ron")
    solution = portal.solve().to_dict()
    ended = threading.Event()

    def work(call: Callable[[], object]) -> None:
        while not ended.is_set():
            call()

    calls: list[Callable[[], object]] = [
        lambda: delta.sweep(poses),
        lambda: delta.at(poses[5]),
        lambda: portal.solve(),
        lambda: hs.load(examples / "portal.ron").solve(),
        lambda: delta.value_and_gradient("k11", ["joint_stiffness.x"], poses[:2]),
    ]
    threads = [threading.Thread(target=work, args=(call,)) for call in calls]
    for thread in threads:
        thread.start()
    try:
        for _ in range(40):
            child = os.fork()
            if child == 0:
                signal.alarm(60)
                same = np.array_equal(delta.sweep(poses).stiffness, expected)
                same = same and np.array_equal(delta.at(poses[7]).stiffness, expected[7])
                os._exit(0 if same and portal.solve().to_dict() == solution else 1)
            assert os.waitpid(child, 0)[1] == 0
    finally:
        ended.set()
        for thread in threads:
            thread.join()


def test_a_fork_of_what_was_imported_twice() -> None:
    code = (
        "import importlib, os, signal, hyperstat\n"
        "importlib.reload(hyperstat)\n"
        "signal.alarm(30)\n"
        "child = os.fork()\n"
        "child or os._exit(0)\n"
        "assert os.waitpid(child, 0)[1] == 0\n"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def resident() -> int:
    """Memory of this process [bytes]."""
    pages = Path("/proc/self/statm").read_text().split()[1]
    return int(pages) * os.sysconf("SC_PAGE_SIZE")


def test_memory_is_flat(examples: Path, delta: hs.Mechanism) -> None:
    poses = grid(2)
    paths = [examples / "portal.ron", examples / "delta.ron"]

    def round(count: int) -> None:
        for k in range(count):
            hs.load(paths[0]).solve()
            delta.sweep(poses)
            delta.at(poses[0])
            if k % 20 == 0:
                with pytest.raises(hs.Error):
                    hs.Mechanism("(name: 3)")

    round(500)
    gc.collect()
    before = resident()
    round(4500)
    gc.collect()
    # Ten thousand loads and sweeps in all; what one keeps would be a kilobyte at least.
    assert resident() - before < 4 << 20


def test_tables_of_others(delta: hs.Mechanism) -> None:
    pandas = pytest.importorskip("pandas")
    t = delta.sweep([[0.0, 0.0, 0.5], [3.0, 0.0, 0.5]], columns=["Mass", "Stress"])
    frame = t.to_pandas()
    assert list(frame.columns) == t.columns and isinstance(frame, pandas.DataFrame)
    assert frame["status"].tolist() == ["ok", "unreachable"]
    arrow = t.to_arrow()
    assert arrow.column_names == t.columns and arrow.schema.field("k11").metadata == {b"unit": b"N/m"}
    assert arrow["k11"].to_pylist() == [t.stiffness[0, 0, 0], None]
    data = t.to_xarray()
    assert data.stiffness.shape == (2, 6, 6) and data.stiffness.sel(i="x", j="x")[0] == t["k11"][0]


def test_tables_tell_what_they_are(delta: hs.Mechanism) -> None:
    t = delta.sweep([[0.0, 0.0, 0.5], [3.0, 0.0, 0.5]])
    assert repr(t) == "<hyperstat.Table of 2 poses: 1 ok, 1 unreachable>"
    assert "<table>" in t._repr_html_() and "nan" in t._repr_html_()
    assert repr(delta.at((0.0, 0.0, 0.5))) == "<hyperstat.Pose at (0.000000, 0.000000, 0.500000, 0.000000, 0.000000, 0.000000): ok>"
