"""Two kinds of joints that hyperstat does not have, in a file that names them: those of `examples/own-joints`.

    python examples/python/own_joint.py
"""

from pathlib import Path

import numpy as np
import numpy.typing as npt

import hyperstat as hs

Array = npt.NDArray[np.float64]


def blades(
    length: float, width: float, thickness: float, angle: float, spacing: float, young: float, poisson: float
) -> Array:
    """Compliance of a pivot of two crossed leaf springs, each a beam without shear from body to body; x halves the
    angle between them, y is the pivot's axis.
    """
    shear = young / (2.0 + 2.0 * poisson)
    flat, edge = width * thickness**3 / 12.0, thickness * width**3 / 12.0
    torsion = width * thickness**3 / 3.0 * (1.0 - 0.63 * thickness / width)
    # Of a blade held at one end, at the other: x along it, y along its width, z through its thickness.
    k = np.diag([young * width * thickness / length, 0.0, 0.0, shear * torsion / length, 0.0, 0.0])
    for force, turn, second, sign in ((1, 5, edge, -1.0), (2, 4, flat, 1.0)):
        k[force, force] = 12.0 * young * second / length**3
        k[turn, turn] = 4.0 * young * second / length
        k[force, turn] = k[turn, force] = sign * 6.0 * young * second / length**2
    stiffness = np.zeros((6, 6))
    for side in (-1.0, 1.0):
        along = np.array([np.cos(side * angle), 0.0, np.sin(side * angle)])
        across = np.array([0.0, 1.0, 0.0])
        axes = np.stack([along, across, np.cross(along, across)])
        x, y, z = along * length / 2.0 + across * side * spacing / 2.0
        # From the pivot's middle to the blade's end, then into the blade's axes.
        moved = np.eye(6)
        moved[:3, 3:] = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]]
        to_end = np.kron(np.eye(2), axes) @ moved
        stiffness += to_end.T @ k @ to_end
    return np.asarray(np.linalg.inv(stiffness), dtype=np.float64)


def offset_axes(offset: float) -> Array:
    """Turning about the second axis, `offset` beyond the joint's point, moves that along the first."""
    basis = np.eye(6)
    basis[0, 4] = -offset
    return basis


SIZES = ["length", "width", "thickness", "angle", "spacing", "young", "poisson"]
SPRING = hs.JointKind("CrossSpring", "v", frame="axis", arguments=SIZES, compliance=blades)
OFFSET = hs.JointKind("OffsetUniversal", "uv", frame="axes", arguments=["offset"], basis=offset_axes)

if __name__ == "__main__":
    path = Path(__file__).resolve().parents[1] / "own-joints" / "lever.ron"
    lever = hs.load(path, joints=[SPRING, OFFSET])
    solution = lever.solve(verify=True)
    print(solution)
    print("both solvers agree to", solution["verification"]["stiffness"])
    for thickness in (0.0005, 0.001):
        other = lever.with_values({"joints.pivot.kind.thickness": thickness})
        print(f"blades of {thickness * 1e3} mm: {other.solve().displacement[2] * 1e6:.3f} µm")
