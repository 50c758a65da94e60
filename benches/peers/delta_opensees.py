"""The delta in OpenSeesPy: output stiffness of one pose after another, its error and its time.

    python delta_opensees.py

The model is exact, without springs in place of joints: every revolute joint is something that
OpenSees has.

* Joint A is locked: a fixed node. Joint B is a moment release at the arm's end, joints Ba, Bb, Ca
  and Cb are moment releases at the rods' ends: bodies share their nodes.
* The platform is three rigid links to P.
* Joint C lets the wrist turn about the wrist's own line. Its two halves pass torsion to each other
  and none to the platform. So they are elements without torsion, welded to the platform, and a
  third element from Ca to Cb has their torsion and nothing else.

What is left is positive definite, and the constraints are of the kind that the fast handler
(Transformation) takes. The compliance comes from six unit loads with one factorization.
"""

import ctypes
import importlib.util
from pathlib import Path

import numpy as np

import delta


def load_libraries():
    """Loads the libraries that the Linux wheel brings but does not find by itself."""
    wheel = importlib.util.find_spec("openseespylinux")
    if wheel is None:
        return
    folder = Path(wheel.origin).parent / "lib"
    for name in ("quadmath.so.0", "gfortran.so.4", "gomp.so.1", "blas.so.3", "lapack.so.3"):
        ctypes.CDLL(str(folder / f"lib{name}"), mode=ctypes.RTLD_GLOBAL)


load_libraries()
import openseespy.opensees as ops  # noqa: E402

PLATFORM = 1
NAMES = ("A", "B", "Ba", "Bb", "C", "Ca", "Cb")
ELEMENTS = 8  # of a limb


def node(limb, name):
    """Tag of a limb's node."""
    return 10 * (limb + 1) + NAMES.index(name)


def beam(tag, ends, link, transformation, *release, torsion=True, only_torsion=False):
    """An Euler–Bernoulli beam with a link's section."""
    area, second, polar = delta.section(link)
    if only_torsion:
        area, second = 0.0, 0.0
    if not torsion:
        polar = 0.0
    ops.element(
        "elasticBeamColumn", tag, *ends, area, delta.YOUNG, delta.SHEAR, polar, second, second,
        transformation, *release,
    )  # fmt: skip


def rods(limb, axis, transformation):
    """Both rods of a limb; their local y is the parallelogram's axis, about which they turn."""
    ops.geomTransf("Linear", transformation, *(-x for x in axis))
    for tag, (start, end) in ((0, ("Ba", "Ca")), (1, ("Bb", "Cb"))):
        ends = (node(limb, start), node(limb, end))
        beam(ELEMENTS * limb + tag, ends, "rod", transformation, "-releasey", 3)


def build(pose):
    """The model at a pose, with a unit load in every direction, one a step of time."""
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    ops.node(PLATFORM, *pose)
    for i, limb in enumerate(delta.limbs(pose)):
        for name in NAMES:
            ops.node(node(i, name), *limb[name])
        ops.fix(node(i, "A"), 1, 1, 1, 1, 1, 1)
        ops.rigidLink("beam", PLATFORM, node(i, "C"))
        arm, bar, rod = 3 * i + 1, 3 * i + 2, 3 * i + 3
        ops.geomTransf("Linear", arm, *limb["x"])  # local z is the limb's axis
        ops.geomTransf("Linear", bar, 0.0, 0.0, 1.0)
        first = ELEMENTS * i
        rods(i, limb["x"], rod)
        beam(first + 2, (node(i, "A"), node(i, "B")), "arm", arm, "-releasez", 2)
        beam(first + 3, (node(i, "B"), node(i, "Ba")), "bar", bar)
        beam(first + 4, (node(i, "B"), node(i, "Bb")), "bar", bar)
        beam(first + 5, (node(i, "C"), node(i, "Ca")), "bar", bar, torsion=False)
        beam(first + 6, (node(i, "C"), node(i, "Cb")), "bar", bar, torsion=False)
        beam(first + 7, (node(i, "Ca"), node(i, "Cb")), "bar", bar, only_torsion=True)
    for k in range(6):
        ops.timeSeries("Path", k + 1, "-dt", 1.0, "-values", *(float(t == k + 1) for t in range(9)))
        ops.pattern("Plain", k + 1, k + 1)
        ops.load(PLATFORM, *(float(j == k) for j in range(6)))


def analysis(handler, numberer, system):
    """Sets up the analysis of a model that is there."""
    ops.constraints(*handler)
    ops.numberer(numberer)
    ops.system(system)
    ops.integrator("LoadControl", 1.0)
    ops.algorithm("Linear", "-factorOnce")
    ops.analysis("Static")


def displacements(steps):
    """Displacements of the platform in so many steps, one a column."""
    found = np.empty((6, steps))
    for k in range(steps):
        if ops.analyze(1) != 0:
            raise RuntimeError("the analysis failed")
        found[:, k] = ops.nodeDisp(PLATFORM)
    return found


def solved():
    """The 6×6 from six steps, a unit load each."""
    return np.linalg.inv(displacements(6))


def rebuilt(handler, numberer, system):
    """Everything anew for each pose."""

    def stiffness(pose):
        build(pose)
        analysis(handler, numberer, system)
        return solved()

    return stiffness


class Updated:
    """The model built once. Points are moved; the rods, whose transformation turns, made anew:
    OpenSees starts an element's new axes from its old ones, and the axes of the joints drift."""

    def __init__(self, *options):
        self.options = options
        self.transformation = 0

    def __call__(self, pose):
        self.place(pose)
        return solved()

    def place(self, pose):
        """Has the model at a pose, ready for the first step."""
        if self.transformation == 0:
            build(pose)
            analysis(*self.options)
            self.transformation = 10
            return
        limbs = delta.limbs(pose)
        for k, x in enumerate(pose):
            ops.setNodeCoord(PLATFORM, k + 1, x)
        ops.reset()
        for i, limb in enumerate(limbs):
            for name in NAMES:
                for k, x in enumerate(limb[name]):
                    ops.setNodeCoord(node(i, name), k + 1, x)
            ops.remove("element", ELEMENTS * i)
            ops.remove("element", ELEMENTS * i + 1)
            rods(i, limb["x"], self.transformation)
            self.transformation += 1
        ops.updateElementDomain()
        ops.setTime(0.0)
        ops.algorithm("Linear", "-factorOnce")


def main():
    """Prints error and time of every choice of constraint handler and solver worth a look."""
    transformation, lagrange = ("Transformation",), ("Lagrange",)
    choices = [(transformation, *o) for o in (("RCM", "ProfileSPD"), ("AMD", "BandSPD"))]
    choices += [(transformation, "RCM", system) for system in ("BandGeneral", "UmfPack")]
    choices += [(lagrange, "RCM", system) for system in ("BandGeneral", "UmfPack")]
    choices += [(("Penalty", 1e14, 1e14), "RCM", "ProfileSPD")]
    formulations = [(f"rebuilt, {h[0]}, {s}, {n}", rebuilt(h, n, s)) for h, n, s in choices]
    best = (transformation, "RCM", "ProfileSPD")
    formulations.append(("updated, Transformation, ProfileSPD, RCM", Updated(*best)))
    delta.measure("OpenSees", ops.version(), formulations)


if __name__ == "__main__":
    main()
