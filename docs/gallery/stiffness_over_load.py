"""Cornering stiffness and peak friction over load.

Stiffness grows less than in proportion to the load, and the friction coefficient falls: a heavily loaded
tire has less of both for its load.

Picture: Left: the stiffness curve bends down. Right: the friction coefficient falls with load.
"""

import numpy as np

from tire_pipeline.pages.drawing import new_figure
from tire_pipeline.tir import read_tir

tire = read_tir("examples/tire.tir")
loads = np.linspace(1600.0, 8400.0, 40)
stiffness = np.abs(tire.forces(normal_load=loads).cornering_stiffness)
sweep = tire.forces(normal_load=loads[:, None], slip_angle=np.linspace(-0.2, 0.0, 101)).fy
friction = np.abs(sweep).max(axis=1) / loads

figure, (left, right) = new_figure(1, 2, width=8.0, height=3.2)
left.plot(loads / 1e3, stiffness / 1e3)
left.set_ylabel("cornering stiffness (kN/rad)")
right.plot(loads / 1e3, friction)
right.set_ylabel("largest side force / normal load")
for axes in (left, right):
    axes.set_xlabel("normal load (kN)")
