"""The delta in Exudyn: output stiffness of one pose after another, its error and its time.

    python delta_exudyn.py

Nodes with six coordinates, exact beams between them: a beam is a connector of the end of a lever
(the first node's marker, moved along the beam) with the second node, whose stiffness is the 6×6 of
a cantilever. No mass, no damping: one Jacobian of the static solver, with the joints' equations,
and six unit loads solved in numpy.

* joints: every body has its own nodes, every joint is Exudyn's generic joint. 33 nodes a plain
  user would have, and 105 equations of joints.
* released: what joints B, Ba, Bb, Ca and Cb let go is condensed in the stiffness of arm and rods,
  so that bodies share their nodes; joint C remains. 19 nodes and 15 equations.
"""

import delta  # before numpy: it asks for one thread
import exudyn as exu
import numpy as np

IDENTITY = np.eye(3)
PLATFORM = "platform"


def beam_stiffness(link, length, releases=()):
    """Stiffness of a cantilever's end in its own axes (x along it), and a rank less for every
    released deformation."""
    area, second, polar = delta.section(link)
    bending = delta.YOUNG * second
    k = np.zeros((6, 6))
    k[0, 0] = delta.YOUNG * area / length
    k[1, 1] = k[2, 2] = 12 * bending / length**3
    k[3, 3] = delta.SHEAR * polar / length
    k[4, 4] = k[5, 5] = 4 * bending / length
    k[1, 5] = k[5, 1] = -6 * bending / length**2
    k[2, 4] = k[4, 2] = 6 * bending / length**2
    for direction in releases:
        force = k @ direction
        k = k - np.outer(force, force) / (direction @ force)
    return k


def turn_at(distance):
    """Deformation of the end by a turn about local y at `distance` before it."""
    return np.array([0.0, 0.0, -distance, 0.0, 1.0, 0.0])


ARM = beam_stiffness("arm", delta.ARM_LENGTH)
BAR = beam_stiffness("bar", delta.ROD_SPACING / 2)
ROD = beam_stiffness("rod", delta.ROD_LENGTH)
RELEASED_ARM = beam_stiffness("arm", delta.ARM_LENGTH, [turn_at(0.0)])
RELEASED_ROD = beam_stiffness("rod", delta.ROD_LENGTH, [turn_at(0.0), turn_at(delta.ROD_LENGTH)])


def frame(along, y):
    """Rotation matrix of a frame with x `along` a vector and a given y."""
    length = (along[0] ** 2 + along[1] ** 2 + along[2] ** 2) ** 0.5
    x = (along[0] / length, along[1] / length, along[2] / length)
    return np.array((x, y, delta.cross(x, y))).T


def placed(rotation, translation):
    """Homogeneous transformation."""
    transformation = np.eye(4)
    transformation[:3, :3] = rotation
    transformation[:3, 3] = translation
    return transformation


def between(a, b):
    """From a to b."""
    return (b[0] - a[0], b[1] - a[1], b[2] - a[2])


class Mechanism:
    """A system of Exudyn; items by their parameters as dictionaries, the quickest way in."""

    def __init__(self):
        self.container = exu.SystemContainer()
        self.system = self.container.AddSystem()
        self.settings = exu.SimulationSettings()
        self.settings.staticSolver.verboseMode = 0
        self.settings.solution.file.write = False
        self.nodes = {}
        self.turning = []  # markers whose place changes from pose to pose

    def begin(self, pose):
        """Starts anew, with the platform alone."""
        self.system.Reset()
        self.nodes.clear()
        self.turning.clear()
        self.ground = self.system.AddObject({"objectType": "Ground"})
        self.add_node(PLATFORM, pose)

    def add_node(self, name, position):
        """A node, and a body of no mass that markers away from the node need."""
        node = {"nodeType": "RigidBodyRxyz", "referenceCoordinates": [*position, 0.0, 0.0, 0.0]}
        number = self.system.AddNode(node)
        body = self.system.AddObject({"objectType": "RigidBody", "nodeNumber": number})
        self.nodes[name] = (number, body, position)

    def marker(self, name, point, rotation):
        """A marker of a node's body at a point; without a name, of the ground."""
        body, origin = (self.ground, (0.0, 0.0, 0.0)) if name is None else self.nodes[name][1:]
        place = placed(rotation, between(origin, point))
        marker = {"markerType": "BodyRigid", "bodyNumber": body, "localHT": place}
        return self.system.AddMarker(marker)

    def add_beam(self, first, second, stiffness, rotation):
        """A beam from a node, or the ground, to a node; returns its markers."""
        end = self.nodes[second][2]
        markers = [self.marker(first, end, rotation), self.marker(second, end, rotation)]
        kind = "ConnectorRigidBodySpringDamper"
        self.system.AddObject(
            {"objectType": kind, "markerNumbers": markers, "stiffness": stiffness}
        )
        return markers

    def add_revolute(self, first, second, axis, point):
        """A revolute joint between nodes."""
        least = min(range(3), key=lambda k: abs(axis[k]))
        rotation = frame(delta.cross(axis, IDENTITY[least]), axis)
        markers = [self.marker(name, point, rotation) for name in (first, second)]
        self.system.AddObject(
            {
                "objectType": "JointGeneric",
                "markerNumbers": markers,
                "constrainedAxes": [1, 1, 1, 1, 0, 1],
            }
        )

    def solved(self):
        """The 6×6 of the platform, whose coordinates are the first."""
        self.system.Assemble()
        solver = exu.MainSolverStatic()
        solver.InitializeSolver(self.system, self.settings)
        solver.ComputeNewtonJacobian(self.system, self.settings)
        jacobian = solver.GetSystemJacobian()
        solver.FinalizeSolver(self.system, self.settings)
        loads = np.zeros((len(jacobian), 6))
        loads[:6] = -np.eye(6)
        return np.linalg.inv(np.linalg.solve(jacobian, loads)[:6])


def jointed(mechanism, pose):
    """Every body with its own nodes, every joint as Exudyn has it."""
    mechanism.begin(pose)
    for i, limb in enumerate(delta.limbs(pose)):
        across = frame(limb["x"], (0.0, 0.0, 1.0))
        bodies = {"arm": ("B",), "elbow": ("B", "Ba", "Bb"), "wrist": ("C", "Ca", "Cb")}
        bodies |= {"roda": ("Ba", "Ca"), "rodb": ("Bb", "Cb")}
        for body, points in bodies.items():
            for point in points:
                mechanism.add_node((i, body, point), limb[point])
        arm = frame(between(limb["A"], limb["B"]), limb["x"])
        mechanism.add_beam(None, (i, "arm", "B"), ARM, arm)
        for body, middle in (("elbow", "B"), ("wrist", "C")):
            for side, sign in (("a", -1.0), ("b", 1.0)):
                ends = (i, body, middle), (i, body, middle + side)
                mechanism.add_beam(*ends, BAR, across * (sign, 1.0, sign))
        mechanism.add_revolute((i, "arm", "B"), (i, "elbow", "B"), limb["x"], limb["B"])
        mechanism.add_revolute((i, "wrist", "C"), PLATFORM, limb["x"], limb["C"])
        rotation = frame(between(limb["B"], limb["C"]), limb["y"])
        for side in "ab":
            start, end = "B" + side, "C" + side
            rod = "rod" + side
            mechanism.add_beam((i, rod, start), (i, rod, end), ROD, rotation)
            for body, point in (("elbow", start), ("wrist", end)):
                mechanism.add_revolute((i, body, point), (i, rod, point), limb["y"], limb[point])
    return mechanism.solved()


def released(mechanism, pose):
    """Shared nodes, and releases in the stiffness of arm and rods."""
    mechanism.begin(pose)
    for i, limb in enumerate(delta.limbs(pose)):
        across = frame(limb["x"], (0.0, 0.0, 1.0))
        for point in ("B", "Ba", "Bb", "C", "Ca", "Cb"):
            mechanism.add_node((i, point), limb[point])
        for middle in "BC":
            for side, sign in (("a", -1.0), ("b", 1.0)):
                ends = (i, middle), (i, middle + side)
                mechanism.add_beam(*ends, BAR, across * (sign, 1.0, sign))
        mechanism.add_revolute((i, "C"), PLATFORM, limb["x"], limb["C"])
        arm = frame(between(limb["A"], limb["B"]), limb["x"])
        mechanism.turning.append(mechanism.add_beam(None, (i, "B"), RELEASED_ARM, arm))
        rod = frame(between(limb["B"], limb["C"]), limb["y"])
        for side in "ab":
            ends = (i, "B" + side), (i, "C" + side)
            mechanism.turning.append(mechanism.add_beam(*ends, RELEASED_ROD, rod))
    return mechanism.solved()


def moved(mechanism, pose):
    """The system of `released`, built once: nodes are moved, arms and rods turned."""
    if not mechanism.nodes:
        return released(mechanism, pose)
    system = mechanism.system
    turning = iter(mechanism.turning)

    def turn(rotation, reach):
        first, second = next(turning)
        system.SetMarkerParameter(first, "localHT", placed(rotation, reach))
        system.SetMarkerParameter(second, "localHT", placed(rotation, (0.0, 0.0, 0.0)))

    def move(name, position):
        node = mechanism.nodes[name][0]
        system.SetNodeParameter(node, "referenceCoordinates", [*position, 0.0, 0.0, 0.0])

    move(PLATFORM, pose)
    for i, limb in enumerate(delta.limbs(pose)):
        for point in ("B", "Ba", "Bb", "C", "Ca", "Cb"):
            move((i, point), limb[point])
        turn(frame(between(limb["A"], limb["B"]), limb["x"]), limb["B"])
        along = between(limb["B"], limb["C"])
        rod = frame(along, limb["y"])
        turn(rod, along)
        turn(rod, along)
    return mechanism.solved()


def main():
    """Prints error and time of the formulations."""
    choices = {"rebuilt, joints": jointed, "rebuilt, released": released}
    choices |= {"updated, released": moved}
    formulations = [
        (label, lambda pose, f=choice, m=Mechanism(): f(m, pose)) for label, choice in choices.items()
    ]
    delta.measure("Exudyn", exu.__version__, formulations, repeats=10)


if __name__ == "__main__":
    main()
