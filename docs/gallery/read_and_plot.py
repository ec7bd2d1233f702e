"""Read a tire file and plot it.

`read_tir` brings all units to SI. `plot` draws the forces over slip and the cornering stiffness over
load.

Picture: Side force and longitudinal force over slip at three loads, and the cornering stiffness over
load. The example file has no aligning moment.
"""

from tire_pipeline.tir import read_tir

tire = read_tir("examples/tire.tir")
forces = tire.forces(slip_angle=0.05, normal_load=4000.0)  # rad, N
print(tire)
print(f"Fy {forces.fy:.0f} N, cornering stiffness {forces.cornering_stiffness:.0f} N/rad")

figure = tire.plot(loads=[2000, 4000, 6000])
