"""A mechanism built of objects, solved, asked why, and written as a file.

    python examples/python/own_mechanism.py
"""

import numpy as np

import hyperstat as hs

steel = hs.Material(young=2.1e11, poisson=0.3, density=7850.0)
rod = hs.Circle(diameter="14 mm")

portal = hs.Mechanism(
    {
        "name": "portal",
        "points": {"A": (0, 0, 0), "B": (0, 0.3, 0.2), "C": (0.1, 0.5, 0.2)},
        "bodies": {
            "arm": hs.Beam(through=["A", "B"], section=rod, material=steel),
            "platform": hs.Rigid(points=["B", "C"]),
        },
        "joints": {
            "shoulder": hs.Joint(
                at="A", between=("ground", "arm"), kind=hs.Revolute(axis=(1, 0, 0)), locked=True
            ),
            "wrist": hs.Joint(
                at="B",
                between=("arm", "platform"),
                kind=hs.Fixed(),
                stiffness=hs.Stiffness(x=1e8, y=1e8, z=1e8),
            ),
        },
        "loads": [hs.Load(on=("platform", "C"), force=(0, 0, -50))],
        "output": ("platform", "C"),
    }
)

solution = portal.solve(why=True)
print(solution)
wrench = solution.joints["shoulder"].wrench
assert wrench is not None
print("wrench at the shoulder [N, N·m]:", wrench.round(6))
for part in solution["budget"]["parts"][:3]:
    name = part.get("body") or part.get("joint")
    print(f"{part['share']:6.1%}  {name}, {part['deformation']}")

try:
    portal.with_values({"sections.arm.diameter": -0.014})
except hs.InputError as error:
    print(f"{error.place}: {error.message}; {error.help}")

text = portal.to_ron()
again = hs.Mechanism(text).solve()
assert again.stiffness is not None and solution.stiffness is not None
assert np.array_equal(again.stiffness, solution.stiffness)
print(text.splitlines()[1].strip())
