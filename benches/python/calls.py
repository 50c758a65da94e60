"""What calls from Python cost beside the same in Rust, and beside OpenSeesPy and Exudyn, in one run.

    cargo build --release --manifest-path benches/python/core/Cargo.toml
    python -m venv /tmp/peers && /tmp/peers/bin/pip install ./crates/python -r benches/peers/requirements.txt
    /tmp/peers/bin/python benches/python/calls.py --core benches/python/core/target/release/hyperstat-core-bench

The delta with rigid joints. Sweeps of Rust and of Python are taken in turn, on one thread, so that other work on
the machine meets both. Without `--core` there is no Rust beside it; a program that is not installed is left out.
"""

import argparse
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "peers"))

import delta  # noqa: E402 (it asks for one thread, before numpy)
import numpy as np  # noqa: E402

import hyperstat as hs  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
FILE, JOB = ROOT / "examples" / "paper.ron", "delta-rigid-trajectory"
COUNT, TURNS, SINGLE = 100_000, 15, 2000


def poses(count):
    """Those of `core/src/main.rs`."""
    k = np.arange(count)
    share = [(k % 50) / 49, (k // 50 % 50) / 49, (k // 2500 % 40) / 39]
    return np.stack([-0.15 + 0.3 * share[0], -0.15 + 0.3 * share[1], 0.45 + 0.1 * share[2]], axis=1)


class Core:
    """The program of `core`."""

    def __init__(self, path: str) -> None:
        self.process = subprocess.Popen(
            [path, FILE, JOB, str(COUNT)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1
        )

    def __call__(self, what: str) -> tuple[float, float, float]:
        """Seconds of the clock and of the processor, and the sum of k11."""
        self.process.stdin.write(what + "\n")
        wall, used, total = self.process.stdout.readline().split()
        return float(wall), float(used), float(total)


def timed(call: Callable[[], object]) -> tuple[float, float]:
    """Seconds of the clock and of the processor."""
    begun, used = time.perf_counter(), time.process_time()
    call()
    return time.perf_counter() - begun, time.process_time() - used


def row(name: str, times: list[float], per: int, scale: float = 1e6, note: str = "") -> None:
    least, middle = min(times) / per * scale, statistics.median(times) / per * scale
    print(f"{name:58}{least:10.2f}{middle:10.2f}  {note}")


def sweeps(m: hs.Mechanism, core: Core | None) -> None:
    rows = poses(COUNT)
    total = float(m.sweep(rows, threads=1).stiffness[:, 0, 0].sum())
    own, other, pairs = [], [], []
    for _ in range(TURNS):
        if core is not None:
            other.append(core("sweep"))
        own.append(timed(lambda: m.sweep(rows, threads=1)))
    if core is not None:
        assert abs(other[0][2] / total - 1.0) < 1e-12, "they do not find the same"
        row("Rust, a sweep of 1e5 poses, one thread", [w for w, _, _ in other], COUNT)
        pairs = [a[0] / b[0] for a, b in zip(own, other)]
    ratio = ""
    if core is not None:
        least = min(w for w, _ in own) / min(w for w, _, _ in other)
        used = sum(c for _, c in own) / sum(c for _, c, _ in other)
        ratio = f"ratio {least:.3f} of the least, {statistics.median(pairs):.3f} in turn, {used:.3f} of processor time"
    row("Python, m.sweep(poses)", [w for w, _ in own], COUNT, note=ratio)
    del rows


def calls(m: hs.Mechanism, core: Core | None) -> None:
    rows = poses(SINGLE)
    plain = [tuple(own) for own in rows.tolist()]
    least = 0.0
    if core is not None:
        times = [core("at")[0] for _ in range(TURNS)]
        least = min(times) / SINGLE * 1e6
        row("Rust, a single pose", times, SINGLE)
    for name, given in (("a tuple", plain), ("a row of an array", list(rows))):
        times = [timed(lambda: [m.at(own) for own in given])[0] for _ in range(TURNS)]
        more = f"{min(times) / SINGLE * 1e6 - least:.1f} more than in Rust" if core is not None else ""
        row(f"Python, m.at(pose) of {name}", times, SINGLE, note=more)
    named = [dict(zip("xyz", own)) for own in plain]
    row("Python, m.at(pose) by names", [timed(lambda: [m.at(own) for own in named])[0] for _ in range(5)], SINGLE)
    posed = m.in_pose(plain[7])
    posed.solve()
    row("Python, m.solve(), all of its report", [timed(posed.solve)[0] for _ in range(50)], 1)
    changes = [{"rod.section.diameter": 0.014 + 1e-6 * k} for k in range(50)]
    row("Python, m.with_values(…)", [timed(lambda: m.with_values(own))[0] for own in changes], 1)
    few = rows[:: SINGLE // 48][:48]
    designs = {"rod.section.diameter": 0.014 + 1e-5 * np.arange(40)}
    row(
        "Python, m.evaluate(…), 40 designs in 48 poses, a row",
        [timed(lambda: m.evaluate(designs, few, threads=1))[0] for _ in range(7)],
        40 * 48,
    )
    paths = ["rod.section.diameter", "bar.section.diameter", "arm.section.diameter", "rod.material.young"]
    lengths = ["arm_length", "rod_length", "base_radius", "rod_spacing"]
    for name, own in (("sections and materials", paths), ("lengths", lengths)):
        plain_sweep = [timed(lambda: m.sweep(few, threads=1))[0] for _ in range(15)]
        times = [timed(lambda: m.value_and_gradient("deflection", own, few, threads=1))[0] for _ in range(7)]
        note = f"{min(times) / min(plain_sweep):.1f} of these poses alone"
        row(f"Python, value_and_gradient by 4 {name}, a pose", times, len(few), note=note)


def peers() -> None:
    rng = np.random.default_rng(0)
    at = [tuple(own) for own in poses(COUNT)[rng.choice(COUNT, 100, replace=False)].tolist()]
    m = hs.load(FILE, JOB)
    expected = [m.at(own).stiffness for own in at]

    def judged(name: str, stiffness: Callable[[tuple[float, ...]], np.ndarray]) -> None:
        off = max(delta.difference(stiffness(own), wanted) for own, wanted in zip(at, expected))
        times = [timed(lambda: [stiffness(own) for own in at])[0] for _ in range(7)]
        row(name, times, len(at), note=f"the same to {off:.1e}")

    try:
        import delta_opensees

        judged("OpenSeesPy, model updated", delta_opensees.Updated(("Transformation",), "RCM", "ProfileSPD"))
    except ImportError as error:
        print(f"OpenSeesPy: {error}")
    try:
        import delta_exudyn

        mechanism = delta_exudyn.Mechanism()
        judged("Exudyn, model updated", lambda own: delta_exudyn.moved(mechanism, own))
    except ImportError as error:
        print(f"Exudyn: {error}")


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--core", help="the program of benches/python/core")
    given = parser.parse_args()
    core = Core(given.core) if given.core else None
    m = hs.load(FILE, JOB)
    print(f"hyperstat {hs.__version__}, Python {sys.version.split()[0]}, numpy {np.__version__}, {delta.processor()}")
    print(f"{'µs':58}{'least':>10}{'median':>10}")
    sweeps(m, core)
    calls(m, core)
    peers()


if __name__ == "__main__":
    main()
