"""The delta in OpenSeesPy under its weight, in ten load cases, and its natural frequencies.

    python states_opensees.py [--hyperstat BINARY]

* weight: the model of delta_opensees.py, a seventh step with uniform loads along all elements;
  OpenSees knows what a release does to their end forces.
* cases: six unit loads and ten more steps with the same factor; or the six alone, whose compliance
  has every case in it.
* modes: OpenSees' consistent mass of a beam knows nothing of its releases; with them frequencies
  converge by the square of an element's length only. So joints B, Ba, Bb, Ca, Cb have nodes on both
  sides, translations tied, and stiff springs about the two directions that the joint holds (they
  change a frequency by less than 1e-6). Arms, half bars and rods have so many consistent elements.
  The wrist's torsion is as in delta_opensees.py, with its mass. Frequencies come from OpenSees' own
  ARPACK, which is quicker when it is asked for twelve; or K and M are read out and go to SciPy.
"""

import delta  # before numpy: it asks for one thread
import delta_opensees as plain
import delta_states
import numpy as np
from delta_opensees import NAMES, ops

WEIGHT = 7  # time series and pattern of the weight; the cases follow
STIFF = 1e10  # N·m/rad: 1e7 times the rods' EI/L
BEST = (("Transformation",), "RCM", "ProfileSPD")


def own_axes(along, y):
    """Unit vectors of a local frame: x `along` a vector, and a given y."""
    length = np.linalg.norm(along)
    x = tuple(a / length for a in along)
    return x, y, delta.cross(x, y)


def uniform(tags, link, axes):
    """Weight along elements of one link."""
    size = delta_states.mass_per_length(link)
    x, y, z = (size * sum(a * g for a, g in zip(axis, delta_states.GRAVITY)) for axis in axes)
    ops.eleLoad("-ele", *tags, "-type", "-beamUniform", y, z, x)


def weigh(pose):
    """The weight at a pose as a load pattern, in the step after the unit loads."""
    ops.pattern("Plain", WEIGHT, WEIGHT)
    level = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))  # of bars only z matters
    for i, limb in enumerate(delta.limbs(pose)):
        first = plain.ELEMENTS * i
        rod = own_axes(np.subtract(limb["C"], limb["B"]), limb["y"])
        uniform((first, first + 1), "rod", rod)
        along = np.subtract(limb["B"], limb["A"])
        x, z, y = own_axes(along, limb["x"])  # local z is the limb's axis
        uniform((first + 2,), "arm", (x, tuple(-a for a in y), z))
        uniform(range(first + 3, first + 7), "bar", level)


def series(tag, step, steps):
    """A factor of 1 in one step."""
    ops.timeSeries("Path", tag, "-dt", 1.0, "-values", *(float(t == step) for t in range(steps)))


class Weight(plain.Updated):
    """Stiffness, and displacement under weight."""

    def __call__(self, pose):
        first = self.transformation == 0
        if not first:
            ops.remove("loadPattern", WEIGHT)  # before its elements are gone
        self.place(pose)
        if first:
            series(WEIGHT, WEIGHT, 9)
        weigh(pose)
        found = plain.displacements(7)
        return np.linalg.inv(found[:, :6]), found[:, 6]


class Cases(plain.Updated):
    """Stiffness, and displacements in ten cases: ten steps more."""

    def __call__(self, pose):
        first = self.transformation == 0
        self.place(pose)
        if first:
            for k, wrench in enumerate(delta_states.WRENCHES.T.tolist()):
                series(WEIGHT + k, WEIGHT + k, 18)
                ops.pattern("Plain", WEIGHT + k, WEIGHT + k)
                ops.load(plain.PLATFORM, *wrench)
        found = plain.displacements(16)
        return np.linalg.inv(found[:, :6]), found[:, 6:]


class Combined(plain.Updated):
    """Stiffness, and displacements in ten cases by the compliance of the six unit loads."""

    def __call__(self, pose):
        self.place(pose)
        compliance = plain.displacements(6)
        return np.linalg.inv(compliance), compliance @ delta_states.WRENCHES


class Vibrating:
    """The model with mass, arms, half bars and rods in so many elements."""

    def __init__(self, arm, bar, rod):
        self.divisions = {"arm": arm, "bar": bar, "rod": rod}
        self.nodes = self.elements = 0

    def node(self, point):
        """A new node."""
        self.nodes += 1
        ops.node(self.nodes, *point)
        return self.nodes

    def element(self, kind, *arguments):
        """A new element."""
        self.elements += 1
        ops.element(kind, self.elements, *arguments)

    def beam(self, ends, link, transformation, part="all"):
        """An element with consistent mass; `part`: "bent" has no torsion, "turned" has that alone."""
        area, second, polar = delta.section(link)
        if part == "turned":  # mass of torsion is ρ A L polar / A
            area, second = 1e-9 * area, 0.0
        if part == "bent":
            polar = 0.0
        self.element(
            "elasticBeamColumn", *ends, area, delta.YOUNG, delta.SHEAR, polar, second, second,
            transformation, "-mass", delta_states.DENSITY * area, "-cMass",
        )  # fmt: skip

    def hinged(self, node, axis, across):
        """A node on the other side of a revolute joint."""
        other = self.node(ops.nodeCoord(node))
        ops.equalDOF(node, other, 1, 2, 3)
        springs = ("-mat", 1, 1, "-dir", 5, 6, "-orient", *axis, *across)
        self.element("zeroLength", node, other, *springs)
        return other

    def chain(self, ends, link, transformation, first="all"):
        """Elements of a segment; returns its second node."""
        count = self.divisions[link]
        a, b = (np.array(ops.nodeCoord(end)) for end in ends)
        inner = [self.node((a + (b - a) * (k / count)).tolist()) for k in range(1, count)]
        nodes = (ends[0], *inner, ends[1])
        for k in range(count):
            self.beam(nodes[k : k + 2], link, transformation, first if k == 0 else "all")
        return nodes[1]

    def build(self, pose):
        """The model at a pose."""
        ops.wipe()
        ops.model("basic", "-ndm", 3, "-ndf", 6)
        ops.uniaxialMaterial("Elastic", 1, STIFF)
        self.nodes = self.elements = 0
        centre = self.node(pose)
        for i, limb in enumerate(delta.limbs(pose)):
            at = {name: self.node(limb[name]) for name in NAMES}
            ops.fix(at["A"], 1, 1, 1, 1, 1, 1)
            ops.rigidLink("beam", centre, at["C"])
            arm, bar, rod = 3 * i + 1, 3 * i + 2, 3 * i + 3
            ops.geomTransf("Linear", arm, *limb["x"])
            ops.geomTransf("Linear", bar, 0.0, 0.0, 1.0)
            ops.geomTransf("Linear", rod, *limb["x"])
            self.chain((at["A"], self.hinged(at["B"], limb["x"], (0.0, 0.0, 1.0))), "arm", arm)
            for side in ("Ba", "Bb"):
                self.chain((at["B"], at[side]), "bar", bar)
            beside = [self.chain((at["C"], at[s]), "bar", bar, "bent") for s in ("Ca", "Cb")]
            self.beam(beside, "bar", bar, "turned")
            along = np.subtract(limb["C"], limb["B"]).tolist()
            for side in "ab":
                ends = [self.hinged(at[joint + side], limb["y"], along) for joint in "BC"]
                self.chain(ends, "rod", rod)

    def own(self, asked):
        """Frequencies by OpenSees' own solver, asked for so many."""

        def frequencies(pose):
            self.build(pose)
            plain.analysis(*BEST)
            return np.sqrt(ops.eigen(asked)[:3]) / (2.0 * np.pi)

        return frequencies

    def read_out(self, pose):
        """Frequencies by SciPy, of the matrices that OpenSees assembles."""
        self.build(pose)
        ops.constraints("Transformation")
        ops.numberer("Plain")
        ops.system("FullGeneral")
        ops.algorithm("Linear")
        ops.integrator("GimmeMCK", 0.0, 0.0, 1.0)
        ops.analysis("Transient", "-noWarnings")
        ops.analyze(1, 0.0)  # numbers the equations
        size = ops.systemSize()
        stiffness = np.array(ops.printA("-ret")).reshape(size, size)
        ops.integrator("GimmeMCK", 1.0, 0.0, 0.0)
        return delta_states.lowest(stiffness, np.array(ops.printA("-ret")).reshape(size, size))


def main():
    """Prints every job's formulations."""
    updated = plain.Updated(*BEST)
    formulations = [("plain", "updated", updated, 10)]
    formulations += [("weight", "updated, loads along elements", Weight(*BEST), 10)]
    formulations += [("cases", "updated, ten steps more", Cases(*BEST), 10)]
    formulations += [("cases", "updated, by the compliance", Combined(*BEST), 10)]
    for elements in ((1, 1, 1), (1, 1, 5)):
        model = Vibrating(*elements)
        ways = {"own solver": model.own(3), "own, asked for 12": model.own(12)}
        ways["matrices to SciPy"] = model.read_out
        label = delta_states.divided(elements)
        formulations += [("modes", label + way, f, 1) for way, f in ways.items()]
    finer = (2, 1, 10)  # for the limit
    label = delta_states.divided(finer) + "own, asked for 12"
    formulations += [("modes", label, Vibrating(*finer).own(12), 1)]
    delta_states.measure("OpenSees", ops.version(), formulations)


if __name__ == "__main__":
    main()
