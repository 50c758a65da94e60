"""The delta under its weight, in ten load cases, and its three lowest natural frequencies: what acts,
the results of hyperstat to compare with, and the measure that all peers share.

Nothing here belongs to a peer. All links are of steel with a density, the drives are locked, the
platform has no mass. Times are of the processor (user and system, all threads) in ms.
"""

import argparse
import csv
import platform
import random
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import delta  # before numpy: it asks for one thread
import numpy as np
import scipy.linalg
import scipy.sparse.linalg

DENSITY = 7850.0
GRAVITY = (0.0, 0.0, -9.81)
POSES = [pose for pose, _ in delta.references()]


def _wrenches():
    """Ten wrenches on the platform, N and N·m."""
    numbers = random.Random(12)
    largest = (100.0, 100.0, 100.0, 10.0, 10.0, 10.0)
    return np.array([[numbers.uniform(-a, a) for a in largest] for _ in range(10)]).T


WRENCHES = _wrenches()  # 6×10, a case a column


def mass_per_length(link):
    """ρA in kg/m"""
    return DENSITY * delta.section(link)[0]


def divided(elements):
    """Label of a division of arms, half bars and rods."""
    return "arm, bar, rod in {}, {}, {}: ".format(*elements)


def batch():
    """The three jobs as a batch file of hyperstat."""
    links = "".join(
        f"{name}: (section: Circle(diameter: {d!r}), material: "
        f"(young: {delta.YOUNG!r}, poisson: 0.3, density: {DENSITY!r})), "
        for name, d in delta.DIAMETERS.items()
    )
    mechanism = (
        f"Delta(base_radius: {delta.BASE_RADIUS!r}, platform_radius: {delta.PLATFORM_RADIUS!r}, "
        f"arm_length: {delta.ARM_LENGTH!r}, rod_length: {delta.ROD_LENGTH!r}, "
        f"rod_spacing: {delta.ROD_SPACING!r}, {links})"
    )
    cases = ", ".join(
        f'"c{k}": [(on: ("platform", "P"), force: {tuple(w[:3])}, moment: {tuple(w[3:])})]'
        for k, w in enumerate(WRENCHES.T.tolist())
    )
    poses = f"List([{', '.join(map(str, POSES))}])"
    jobs = {"weight": f"gravity: {GRAVITY}", "cases": f"cases: {{{cases}}}", "modes": "modes: 3"}
    return "(jobs: [" + "".join(
        f'(name: "{name}", mechanism: {mechanism}, poses: {poses}, {more}),' for name, more in jobs.items()
    ) + "])"  # fmt: skip


class Results:
    """What hyperstat finds in every pose: stiffness, displacements, frequencies."""

    def __init__(self, binary):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "states.ron"
            file.write_text(batch())
            command = [binary, "run", str(file), "--out", folder, "--threads", "1"]
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
            tables = {}
            for name in ("weight", "cases", "modes"):
                with open(Path(folder) / f"{name}.csv", newline="") as rows:
                    tables[name] = list(csv.DictReader(rows))

        def columns(table, names):
            return np.array([[float(row[n]) for n in names] for row in tables[table]])

        displacement = ("dx", "dy", "dz", "drx", "dry", "drz")
        self.weight = columns("weight", displacement)
        self.cases = np.stack(
            [columns("cases", [f"c{k}.{d}" for d in displacement]) for k in range(10)], axis=2
        )
        self.frequencies = columns("modes", ("f1", "f2", "f3"))
        pairs = [(r, c) for r in range(6) for c in range(r, 6)]
        upper = columns("weight", [f"k{r + 1}{c + 1}" for r, c in pairs])
        self.stiffness = np.empty((len(upper), 6, 6))
        for k, (r, c) in enumerate(pairs):
            self.stiffness[:, r, c] = self.stiffness[:, c, r] = upper[:, k]

    def plain(self, i, found):
        """Error of a 6×6"""
        return delta.difference(found, self.stiffness[i])

    def loaded(self, expected):
        """Error of a 6×6 with displacements: of displacements by the energy of what they lack."""

        def error(i, found):
            stiffness, found = found
            k = self.stiffness[i]
            u = expected[i].reshape(6, -1)
            d = found.reshape(6, -1) - u
            energy = np.einsum("ik,ij,jk->k", d, k, d) / np.einsum("ik,ij,jk->k", u, k, u)
            return max(self.plain(i, stiffness), float(np.sqrt(energy.max())))

        return error

    def modes(self, i, found):
        """Largest relative error of three frequencies"""
        return float(np.max(np.abs(found / self.frequencies[i] - 1.0)))

    def checks(self):
        """The check of every job."""
        weight, cases = self.loaded(self.weight), self.loaded(self.cases)
        return {"plain": self.plain, "weight": weight, "cases": cases, "modes": self.modes}


def lowest(stiffness, mass, count=3):
    """The lowest frequencies in Hz of matrices in whole: Lanczos (ARPACK) on L⁻¹ M L⁻ᵀ with
    K = L Lᵀ, which bears coordinates without mass."""
    factor = np.linalg.cholesky(stiffness)
    solve = scipy.linalg.blas.dtrsv  # of the factor's transpose, which is in Fortran's order
    upper = factor.T

    def product(x):
        return solve(upper, mass @ solve(upper, x), trans=1)

    operator = scipy.sparse.linalg.LinearOperator(stiffness.shape, matvec=product, dtype=float)
    start = np.ones(len(stiffness))
    found = scipy.sparse.linalg.eigsh(
        operator, count, which="LA", ncv=12, tol=1e-9, v0=start, return_eigenvectors=False
    )
    return np.sort(1.0 / np.sqrt(found)) / (2.0 * np.pi)


def measure(name, version, formulations):
    """Prints difference from hyperstat and time of every formulation: job, label, function of a
    pose, repeats."""
    root = Path(__file__).resolve().parents[2]
    arguments = argparse.ArgumentParser(description="Differences from hyperstat, and times.")
    arguments.add_argument("--hyperstat", default=str(root / "target" / "release" / "hyperstat"))
    binary = arguments.parse_args().hyperstat
    if not Path(binary).is_file():
        arguments.error(f"no {binary}: cargo build --release, or give --hyperstat BINARY")
    checks = Results(binary).checks()
    print(f"{name} {version}, Python {platform.python_version()}, {delta.processor()}")
    print(f"{len(POSES)} poses of the reference results; time of the processor, one thread")
    print(f"{'':61}{'difference':>11}{'min ms':>9}{'median ms':>11}")
    for job, label, function, repeats in formulations:
        try:
            error = max(checks[job](i, function(pose)) for i, pose in enumerate(POSES))
            times = delta.cost(function, POSES, repeats, time.process_time)
        except Exception as problem:  # a peer's own refusal is a result
            print(f"{job + ': ' + label:61}{type(problem).__name__}: {problem}")
            continue
        middle = statistics.median(times)
        print(f"{job + ': ' + label:61}{error:11.1e}{min(times):9.3f}{middle:11.3f}", flush=True)
