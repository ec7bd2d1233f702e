"""Draw docs/reference/axes.png: what a positive sign means in each axis system.

Arrows are not drawn by hand: directions come from ``AXES`` and from forces of an example tire.
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle
from matplotlib.transforms import Affine2D

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "tests" / "magic_formula"))
from magic_formula_tires import tire_52  # noqa: E402

from tire_pipeline.magic_formula.parameters.axes import AXES  # noqa: E402

DARK, BLUE, RED, GREEN = "#333333", "#0072b2", "#d55e00", "#009e73"
SLIP, TILT = 0.25, 0.25
PLAIN = ("PHY1", "PHY2", "PHY3", "PVY1", "PVY2", "QHZ1", "QHZ2", "QDZ6", "QDZ7", "PEY3", "QEZ4")


def arrow(ax: Axes, start, end, colour, text="", shift=(0.0, 0.0), width=2.0):
    """Draw an arrow with a label at its end."""
    ax.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": colour, "lw": width})
    if text:
        ax.text(
            end[0] + shift[0], end[1] + shift[1], text, color=colour, ha="center", va="center", fontsize=9
        )


def turning(ax: Axes, centre, counterclockwise: bool, colour, text, radius=0.5):
    """Draw an arc arrow and its label."""
    angles = np.deg2rad(np.linspace(200, 340, 30))
    x, y = centre[0] + radius * np.cos(angles), centre[1] + radius * np.sin(angles)
    ax.plot(x, y, color=colour, lw=2)
    a, b = (-2, -1) if counterclockwise else (1, 0)
    arrow(ax, (x[a], y[a]), (x[b], y[b]), colour)
    ax.text(centre[0], centre[1] - radius - 0.16, text, color=colour, ha="center", va="center", fontsize=9)


def panel(ax: Axes, title: str):
    """Prepare an empty panel."""
    ax.set_xlim(-1.75, 1.75)
    ax.set_ylim(-1.5, 1.65)
    ax.set_aspect("equal")
    ax.axis("off")
    ax.set_title(title, fontsize=11, color=DARK)


def from_above(ax: Axes, name: str, tire):
    """Rolling up the page; the page's left is the tire's left."""
    signs = AXES[name]
    y_right = signs.fy < 0
    panel(ax, f"{name}, from above: slip angle > 0")
    ax.add_patch(Rectangle((-0.17, -0.55), 0.34, 1.1, color="#dddddd"))
    arrow(ax, (0, 0), (0, 1.35), DARK, "x", (0.12, 0.05), 1.2)
    side = 1.35 if y_right else -1.35
    arrow(ax, (0, 0), (side, 0), DARK, "y", (0.0, 0.16), 1.2)
    ax.text(
        -0.25 * np.sign(side),
        0.0,
        "⊗ z" if y_right else "⊙ z",
        ha="center",
        va="center",
        fontsize=9,
        color=DARK,
    )
    forces = tire.forces(slip_angle=SLIP, normal_load=4000.0, axes=name)
    # to the left on the page: ISO's positive slip angle
    to_left = signs.slip_angle * SLIP
    arrow(ax, (0, 0), (-1.3 * np.sin(2 * to_left), 1.3 * np.cos(2 * to_left)), BLUE, "velocity", (0.0, 0.13))
    on_page = (1.0 if y_right else -1.0) * np.sign(forces.fy)
    label = f"Fy {'>' if forces.fy > 0 else '<'} 0"
    arrow(ax, (0, -0.25), (0.95 * on_page, -0.25), RED, label, (0.0, -0.17))
    counterclockwise = (forces.mz > 0) != y_right
    turning(ax, (0.0, -0.6), counterclockwise, GREEN, f"Mz {'>' if forces.mz > 0 else '<'} 0")


def from_behind(ax: Axes, name: str, tire):
    """Rolling into the page."""
    signs = AXES[name]
    y_right = signs.fy < 0
    panel(ax, f"{name}, from behind: camber > 0")
    ax.plot([-1.6, 1.6], [-0.75, -0.75], color="#aaaaaa", lw=1)
    lean = signs.camber * TILT
    wheel = Rectangle((-0.17, 0.0), 0.34, 1.5, color="#dddddd")
    wheel.set_transform(Affine2D().rotate(-lean).translate(0, -0.75) + ax.transData)
    ax.add_patch(wheel)
    arrow(ax, (0, -0.75), (0, -1.35 if y_right else 1.1), DARK, "z", (0.14, 0.0), 1.2)
    side = 1.35 if y_right else -1.35
    arrow(ax, (0, -0.75), (side, -0.75), DARK, "y", (0.0, 0.16), 1.2)
    forces = tire.forces(camber=TILT, normal_load=4000.0, axes=name)
    on_page = (1.0 if y_right else -1.0) * np.sign(forces.fy)
    arrow(ax, (0, -0.9), (0.75 * on_page, -0.9), RED, f"Fy {'>' if forces.fy > 0 else '<'} 0", (0.0, -0.17))
    rolling = tire.forces(normal_load=4000.0, axes=name)
    driven = tire.forces(slip_ratio=0.05, normal_load=4000.0, axes=name)
    lines = (
        f"slip ratio > 0: Fx {'>' if driven.fx > 0 else '<'} 0\n"
        f"rolling forward: My {'>' if rolling.my > 0 else '<'} 0\n"
        f"slope of Fy: {'>' if rolling.cornering_stiffness > 0 else '<'} 0"
    )
    ax.text(-1.7, 1.3, lines, fontsize=8, color=DARK, va="center")


def main() -> None:
    """Draw the figure."""
    tire = tire_52().replace(**dict.fromkeys(PLAIN, 0.0))
    figure, panels = plt.subplots(2, 3, figsize=(10, 6.4))
    for column, name in enumerate(AXES):
        from_above(panels[0, column], name, tire)
        from_behind(panels[1, column], name, tire)
    figure.tight_layout()
    figure.savefig(HERE.parent / "reference" / "axes.png", dpi=80)


if __name__ == "__main__":
    main()
