"""The delta in Exudyn under its weight, in ten load cases, and its natural frequencies.

    python states_exudyn.py [--hyperstat BINARY]

* connectors: the plain pose as delta_exudyn.py has it. Connectors have no loads along them and no
  mass.
* matrices: beams as objects of Exudyn with a matrix of stiffness, one of mass and a vector of
  forces (GenericODE2), by the beam's static shapes, the rotations that hinges let go condensed.
  The platform is a lever in the matrices of the wrists, whose torsion goes past the platform as in
  delta_opensees.py: no equations of joints, stiffness and mass positive definite. The weight is a
  column of the solution, cases are ten more, or come from the six unit loads alone, whose compliance
  has every case in it. Frequencies by Exudyn's own function, or by SciPy from the matrices that
  Exudyn assembles.
"""

import delta  # before numpy: it asks for one thread
import delta_exudyn as plain
import delta_states
import exudyn as exu
import numpy as np

GRAVITY = np.array(delta_states.GRAVITY)


def bending(length, sign):
    """Stiffness, mass and load of a unit beam in one plane over (w₁, θ₁, w₂, θ₂); `sign` is that of
    a rotation to the slope."""
    s = length * sign
    k = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]]) / length**3
    m = np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]) / 420
    scale = np.array([1, s, 1, s])
    load = np.array([0.5, 1 / 12, 0.5, -1 / 12]) * scale
    return k * np.outer(scale, scale), m * np.outer(scale, scale) * length, load * length


def beam(link, length, hinges=(), part="all"):
    """Stiffness, mass (12×12) and weight by gravity's components (12×3) of a beam in its own axes,
    without the rotations at `hinges`; `part`: "bent" has no torsion, "turned" has that alone."""
    area, second, polar = delta.section(link)
    density = delta_states.DENSITY
    k, m, w = np.zeros((12, 12)), np.zeros((12, 12)), np.zeros((12, 3))
    bar, consistent = np.array([[1, -1], [-1, 1]]) / length, np.array([[2, 1], [1, 2]]) * length / 6
    if part != "bent":
        turn = np.ix_((3, 9), (3, 9))
        k[turn], m[turn] = delta.SHEAR * polar * bar, density * polar * consistent
    if part != "turned":
        along = np.ix_((0, 6), (0, 6))
        k[along], m[along] = delta.YOUNG * area * bar, density * area * consistent
        w[(0, 6), 0] = density * area * length / 2
        for axis, plane, sign in ((1, (1, 5, 7, 11), 1), (2, (2, 4, 8, 10), -1)):
            unit = bending(length, sign)
            k[np.ix_(plane, plane)] = delta.YOUNG * second * unit[0]
            m[np.ix_(plane, plane)] = density * area * unit[1]
            w[plane, axis] = density * area * unit[2]
    if hinges:
        held = list(hinges)
        shape = np.eye(12)
        shape[held] = -np.linalg.solve(k[np.ix_(held, held)], k[held])
        shape[:, held] = 0.0
        k, m, w = shape.T @ k @ shape, shape.T @ m @ shape, shape.T @ w
    return k, m, w


def segment(link, length, count, first=(), last=(), part="all"):
    """The equal elements of a segment, stacked; hinges and `part` are those of its ends."""
    found = []
    for k in range(count):
        hinges = (*(first if k == 0 else ()), *(last if k == count - 1 else ()))
        found.append(beam(link, length / count, hinges, part if k == 0 else "all"))
    return tuple(np.stack(matrices) for matrices in zip(*found))


def turned(matrices, rotation):
    """Elements' matrices in global axes, and their weight."""
    k, m, w = matrices
    full = np.kron(np.eye(4), rotation)
    force = (w @ (rotation.T @ GRAVITY)) @ full.T
    return full @ k @ full.T, full @ m @ full.T, force


def levered(matrices, reach):
    """Matrices of an element whose first node is a lever `reach` away from where it begins."""
    x, y, z = reach
    full = np.eye(12)
    full[:3, 3:6] = [[0, z, -y], [-z, 0, x], [y, -x, 0]]
    k, m, force = matrices
    return full.T @ k @ full, full.T @ m @ full, full.T @ force


class Matrices:
    """A system of Exudyn whose objects are matrices, arms, half bars and rods in so many."""

    def __init__(self, arm=1, bar=1, rod=1, loaded=False):
        self.loaded = loaded
        self.arm = segment("arm", delta.ARM_LENGTH, arm, last=(10,))
        self.rod = segment("rod", delta.ROD_LENGTH, rod, first=(4,), last=(10,))
        self.container = exu.SystemContainer()
        self.system = self.container.AddSystem()
        self.settings = exu.SimulationSettings()
        self.settings.staticSolver.verboseMode = 0
        self.settings.solution.file.write = False
        platform = self.node()
        half = delta.ROD_SPACING / 2
        whole, bent = (segment("bar", half, bar, part=part) for part in ("all", "bent"))
        between = tuple(a[None] for a in beam("bar", 2 * half / bar, part="turned"))
        self.turning = []  # of every limb: its arm's objects, and those of both rods
        for limb in delta.limbs(delta.HOME):
            at = {name: self.node() for name in ("B", "Ba", "Bb", "Ca", "Cb")}
            across = plain.frame(limb["x"], (0.0, 0.0, 1.0))
            reach = plain.between(delta.HOME, limb["C"])
            beside = []
            for side, sign in (("a", -1.0), ("b", 1.0)):
                rotation = across * (sign, 1.0, sign)
                self.chain(at["B"], at["B" + side], turned(whole, rotation))
                wrist = turned(bent, rotation)
                beside.append(self.chain(platform, at["C" + side], wrist, reach)[0][1])
            self.chain(*beside, turned(between, across))
            # where arms and rods are is told in every pose
            arms = self.chain(None, at["B"], turned(self.arm, plain.IDENTITY))
            rods = [
                self.chain(at["B" + s], at["C" + s], turned(self.rod, plain.IDENTITY)) for s in "ab"
            ]
            self.turning.append(([o for o, _ in arms], [[o for o, _ in chain] for chain in rods]))
        self.system.Assemble()

    def node(self):
        """A node; where it is matters to none of the matrices."""
        node = {"nodeType": "RigidBodyRxyz", "referenceCoordinates": [0.0] * 6}
        return self.system.AddNode(node)

    def chain(self, first, last, matrices, reach=None):
        """Objects from a node, or the ground, to a node; returns them with their second nodes."""
        count = len(matrices[0])
        nodes = (first, *(self.node() for _ in range(count - 1)), last)
        found = []
        for k in range(count):
            own = tuple(a[k] for a in matrices)
            if reach is not None and k == 0:
                own = levered(own, reach)
            ends = [nodes[k], nodes[k + 1]]
            if nodes[k] is None:
                ends, own = ends[1:], (own[0][6:, 6:], own[1][6:, 6:], own[2][6:])
            names = ("stiffnessMatrix", "massMatrix", "forceVector")
            item = {"objectType": "GenericODE2", "nodeNumbers": ends} | dict(zip(names, own))
            found.append((self.system.AddObject(item), nodes[k + 1]))
        return found

    def tell(self, objects, matrices, vibrating, fixed=False):
        """Gives objects their matrices."""
        for k, number in enumerate(objects):
            kept = slice(6 if fixed and k == 0 else 0, None)
            set_parameter = self.system.SetObjectParameter
            set_parameter(number, "stiffnessMatrix", matrices[0][k, kept, kept])
            if vibrating:
                set_parameter(number, "massMatrix", matrices[1][k, kept, kept])
            if self.loaded:
                set_parameter(number, "forceVector", matrices[2][k, kept])

    def place(self, pose, vibrating=False):
        """Turns arms and rods to where they are at a pose."""
        for (arm, rods), limb in zip(self.turning, delta.limbs(pose)):
            rotation = plain.frame(plain.between(limb["A"], limb["B"]), limb["x"])
            self.tell(arm, turned(self.arm, rotation), vibrating, fixed=True)
            rotation = plain.frame(plain.between(limb["B"], limb["C"]), limb["y"])
            matrices = turned(self.rod, rotation)
            for rod in rods:
                self.tell(rod, matrices, vibrating)

    def assembled(self, more=None):
        """Stiffness of the system, and what else of the solver is asked for."""
        solver = exu.MainSolverStatic()
        solver.InitializeSolver(self.system, self.settings)
        solver.ComputeNewtonJacobian(self.system, self.settings)
        found = -solver.GetSystemJacobian(), more(solver) if more else None
        solver.FinalizeSolver(self.system, self.settings)
        return found

    def force(self, solver):
        """Forces on all coordinates"""
        solver.ComputeNewtonResidual(self.system, self.settings)
        return solver.GetSystemResidual()

    def mass(self, solver):
        """The system's mass"""
        solver.ComputeMassMatrix(self.system)
        return solver.GetSystemMassMatrix()

    def plain(self, pose):
        """Stiffness"""
        self.place(pose)
        return np.linalg.inv(compliance(self.assembled()[0]))

    def weight(self, pose):
        """Stiffness, and displacement under weight"""
        self.place(pose)
        stiffness, force = self.assembled(self.force)
        found = compliance(stiffness, force)
        return np.linalg.inv(found[:, :6]), found[:, 6]

    def cases(self, pose):
        """Stiffness, and displacements in ten cases, each a column"""
        self.place(pose)
        stiffness = self.assembled()[0]
        wrenches = np.zeros((10, len(stiffness)))
        wrenches[:, :6] = delta_states.WRENCHES.T
        found = compliance(stiffness, *wrenches)
        return np.linalg.inv(found[:, :6]), found[:, 6:]

    def combined(self, pose):
        """Stiffness, and displacements in ten cases by the compliance"""
        self.place(pose)
        found = compliance(self.assembled()[0])
        return np.linalg.inv(found), found @ delta_states.WRENCHES

    def modes(self, pose):
        """Frequencies by SciPy"""
        self.place(pose, vibrating=True)
        return delta_states.lowest(*self.assembled(self.mass))

    def own_modes(self, pose):
        """Frequencies by Exudyn's own function"""
        self.place(pose, vibrating=True)
        found = exu.solver.ComputeODE2Eigenvalues(
            self.system, self.settings, numberOfEigenvalues=3, convert2Frequencies=True
        )
        return found[0]


def compliance(stiffness, *columns):
    """Displacements of the platform, whose coordinates are the first, under unit loads and more."""
    loads = np.zeros((len(stiffness), 6 + len(columns)))
    loads[:6, :6] = np.eye(6)
    for k, column in enumerate(columns):
        loads[:, 6 + k] = column
    return np.linalg.solve(stiffness, loads)[:6]


def main():
    """Prints every job's formulations."""
    mechanism, joined, loaded = plain.Mechanism(), Matrices(), Matrices(loaded=True)
    formulations = [("plain", "connectors, updated", lambda p: plain.moved(mechanism, p), 10)]
    formulations += [("plain", "matrices, updated", joined.plain, 10)]
    formulations += [("weight", "matrices, updated", loaded.weight, 10)]
    formulations += [("cases", "matrices, updated, ten columns more", joined.cases, 10)]
    formulations += [("cases", "matrices, updated, by the compliance", joined.combined, 10)]
    for elements in ((1, 1, 1), (2, 1, 5)):
        model = Matrices(*elements)
        label = delta_states.divided(elements)
        formulations += [("modes", label + "own function", model.own_modes, 1)]
        formulations += [("modes", label + "matrices to SciPy", model.modes, 1)]
    finer = (4, 2, 16)  # for the limit
    label = delta_states.divided(finer) + "matrices to SciPy"
    formulations += [("modes", label, Matrices(*finer).modes, 1)]
    delta_states.measure("Exudyn", exu.__version__, formulations)


if __name__ == "__main__":
    main()
