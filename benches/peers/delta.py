"""The delta of the book's page on prebuilt mechanisms with rigid joints: geometry of a pose,
reference results, and the measure of accuracy and time that all peers share.

Nothing here belongs to a peer. Positions in m, stiffness in N/m, N/rad, N, N·m/rad.
"""

import csv
import json
import math
import os
import platform
import statistics
import time
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # for matrices this small one is faster

import numpy as np  # noqa: E402

BASE_RADIUS = 0.25
PLATFORM_RADIUS = 0.06
ARM_LENGTH = 0.30
ROD_LENGTH = 0.60
ROD_SPACING = 0.12
DIAMETERS = {"arm": 0.030, "bar": 0.020, "rod": 0.014}
YOUNG = 2.1e11
SHEAR = YOUNG / 2.6  # Poisson's ratio 0.3

REFERENCE = Path(__file__).resolve().parents[2] / "tests" / "reference"


def section(name):
    """Area, second moment (both axes), torsion constant of a link's round section."""
    d = DIAMETERS[name]
    second = math.pi * d**4 / 64
    return math.pi * d**2 / 4, second, 2 * second


def _add(a, b, factor=1.0):
    return (a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2])


def cross(a, b):
    """a × b"""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def limbs(pose):
    """Three limbs at a pose of the platform: points A, B, Ba, Bb, C, Ca, Cb, the limb's axis x
    (joints A, B, C) and the parallelogram's axis y (joints Ba, Bb, Ca, Cb), unit vectors.

    Plain Python: for vectors of three it is several times faster than numpy.
    """
    found = []
    for i in range(3):
        cosine, sine = math.cos(2 * math.pi * i / 3), math.sin(2 * math.pi * i / 3)
        axis, outward = (cosine, sine, 0.0), (-sine, cosine, 0.0)
        a = (BASE_RADIUS * outward[0], BASE_RADIUS * outward[1], 0.0)
        c = _add(pose, outward, PLATFORM_RADIUS)
        d = _add(c, a, -1.0)
        along = d[0] * outward[0] + d[1] * outward[1]
        square = d[0] ** 2 + d[1] ** 2 + d[2] ** 2
        reach = (square + ARM_LENGTH**2 - ROD_LENGTH**2) / (2 * ARM_LENGTH)
        middle = math.atan2(d[2], along)
        half = math.acos(reach / math.hypot(along, d[2]))
        angle = max(middle + half, middle - half, key=math.cos)  # the elbow is out
        b = _add(a, outward, ARM_LENGTH * math.cos(angle))
        b = (b[0], b[1], b[2] + ARM_LENGTH * math.sin(angle))
        rod = _add(c, b, -1.0)
        normal = cross(rod, axis)
        length = math.sqrt(normal[0] ** 2 + normal[1] ** 2 + normal[2] ** 2)
        normal = (normal[0] / length, normal[1] / length, normal[2] / length)
        half = ROD_SPACING / 2
        found.append(
            {
                "A": a, "B": b, "Ba": _add(b, axis, -half), "Bb": _add(b, axis, half),
                "C": c, "Ca": _add(c, axis, -half), "Cb": _add(c, axis, half),
                "x": axis, "y": normal,
            }
        )  # fmt: skip
    return found


def references():
    """Poses and output stiffness in 60 digits: the paper's trajectory and the mechanism file."""
    cases = []
    with open(REFERENCE / "delta_trajectory_rigid.csv", newline="") as file:
        for row in csv.DictReader(file):
            stiffness = np.zeros((6, 6))
            for r in range(6):
                for c in range(r, 6):
                    stiffness[r, c] = stiffness[c, r] = float(row[f"k{r + 1}{c + 1}"])
            cases.append((tuple(float(row[k]) for k in "xyz"), stiffness))
    with open(REFERENCE / "delta_rigid_joints.json") as file:
        stiffness = np.array(json.load(file)["output_stiffness"], dtype=float)
    cases.append(((-0.2, -0.2, 0.5), stiffness))
    return cases


def difference(found, expected):
    """Largest |ΔK_ij| / √(K_ii K_jj)"""
    scale = np.sqrt(np.diag(expected))
    return float(np.max(np.abs(found - expected) / np.outer(scale, scale)))


def processor():
    """Name of the processor."""
    try:
        with open("/proc/cpuinfo") as file:
            return next(line.split(":")[1].strip() for line in file if "model name" in line)
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


HOME = (0.0, 0.0, 0.5)


def measure(name, version, formulations, repeats=20):
    """Prints error and time of every formulation: a function of a pose that returns the 6×6."""
    cases = references()
    print(f"{name} {version}, Python {platform.python_version()}, {processor()}")
    print(f"{len(cases)} poses of the reference results, each {repeats} times; and {HOME}")
    print(f"{'':44}{'error':>9}{'min ms':>9}{'median ms':>11}{'median ms, home':>17}")
    for label, stiffness in formulations:
        try:
            error = max(difference(stiffness(pose), expected) for pose, expected in cases)
            times = cost(stiffness, [pose for pose, _ in cases], repeats)
            home = cost(stiffness, [HOME], 200)
        except Exception as problem:  # a peer's own refusal is a result
            print(f"{label:44}{type(problem).__name__}: {problem}")
            continue
        middle = statistics.median
        print(f"{label:44}{error:9.1e}{min(times):9.3f}{middle(times):11.3f}{middle(home):17.3f}")


def cost(job, poses, repeats, clock=time.perf_counter):
    """Times of a job, ms, in all poses again and again."""
    times = []
    for _ in range(repeats):
        for pose in poses:
            start = clock()
            job(pose)
            times.append(1e3 * (clock() - start))
    return times
