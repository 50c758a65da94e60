"""A map of a delta's stiffness and its deformed shape, with matplotlib.

    python examples/python/plots.py
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import hyperstat as hs

folder = Path(__file__).resolve().parents[1]
delta = hs.load(folder / "paper.ron", "delta-elastic-trajectory")
x = np.linspace(-0.2, 0.2, 41)
poses = np.stack([own.ravel() for own in np.meshgrid(x, x, [0.5])], axis=1)

figure = plt.figure(figsize=(11, 4.5), layout="constrained")
delta.sweep(poses).plot_map("pure_force_stiffness_min", ax=figure.add_subplot(1, 2, 1))
delta.solve().plot(figure.add_subplot(1, 2, 2, projection="3d"))
figure.savefig("delta.png", dpi=150)
