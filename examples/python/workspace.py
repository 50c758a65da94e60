"""A delta built of objects, swept over its workspace: the softest pose, with another rod, and under a case.

    python examples/python/workspace.py
"""

import numpy as np

import hyperstat as hs

steel = hs.Material(young=2.1e11, poisson=0.3, density=7850.0)


def link(diameter: float) -> hs.Link:
    """A round bar of steel; diameter [m]."""
    return hs.Link(section=hs.Circle(diameter=diameter), material=steel)


delta = hs.Delta(
    base_radius=0.25,
    platform_radius=0.06,
    arm_length=0.30,
    rod_length=0.60,
    rod_spacing=0.12,
    arm=link(0.030),
    bar=link(0.020),
    rod=link(0.014),
    joint_stiffness=hs.Stiffness(x=1e8, y=1e8, z=1e8, u=1e5, w=1e5),
    drive_stiffness=1e5,
)

# Poses: x fastest, as `Grid` in a batch file.
x, z = np.linspace(-0.2, 0.2, 21), np.linspace(0.40, 0.60, 5)
poses = np.stack([own.ravel() for own in np.meshgrid(x, x, z)], axis=1)

push = hs.Load(on=("platform", "P"), force=(0.0, 0.0, -100.0))
table = delta.sweep(poses, cases={"push": [push]}, columns=["Mass"])
print(table)

softest = table.measure("pure_force_stiffness_min")
row = int(np.nanargmin(softest))
print(f"softest at {table.pose[row, :3]}: {softest[row]:.4g} N/m along the softest direction")
print(f"largest deflection under the push: {np.nanmax(table.measure('deflection', 'push')):.4g} m")

thicker = delta.with_values({"rod.section.diameter": 0.016}).sweep(poses)
gain = np.nanmin(thicker.measure("pure_force_stiffness_min")) / np.nanmin(softest)
print(f"with rods of 16 mm: {gain:.3f} times that")
