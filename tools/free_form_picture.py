"""The picture of the free-form search for the docs: teeth, path, curvature and loss before and after.

tribodyn run design-free-form-23-47               # writes design-free-form-23-47.h5 and …-best.toml
python -m tools.free_form_picture design-free-form-23-47-best.toml
"""

import sys
from typing import Any

import numpy as np

import tribodyn as td
from tools.marked_block import PICTURES
from tribodyn.geometry.path import kinematics
from tribodyn.post.style import INK, PALETTE, house_style, new_figure, save

START = "crc-23-47"


def teeth(axes: Any, pairs: dict[str, td.GearPair]) -> None:
    """Draw both gears about the pitch point, before and after."""
    for (name, pair), style in zip(pairs.items(), (":", "-"), strict=True):
        for outline, colour in zip(pair.outlines.values(), PALETTE, strict=False):
            axes.plot(1e3 * outline[:, 0], 1e3 * outline[:, 1], colour, ls=style, lw=1.2)
        axes.plot(1e3 * pair.path[:, 0], 1e3 * pair.path[:, 1], INK, ls=style, lw=1.6, label=name)
    axes.set(xlim=(-9, 9), ylim=(-6, 6), aspect="equal", xlabel="x / mm", ylabel="y / mm")
    axes.legend(loc="upper left")


def along(panels: Any, pairs: dict[str, td.GearPair]) -> None:
    """Draw pressure angle, equivalent radius and sliding along the contact, over the pinion's rotation."""
    for (name, pair), style in zip(pairs.items(), (":", "-"), strict=True):
        gears = pair._assembly
        r = np.linspace(gears.r_start, gears.r_end, 400)
        at = kinematics(gears.path, r)
        turned = np.degrees(gears.path.rotation(r))
        panels[0].plot(turned, np.degrees(at.pressure_angle), PALETTE[2], ls=style, label=name)
        panels[1].plot(turned, 1e3 / at.relative_curvature, PALETTE[3], ls=style)
        panels[2].plot(turned, 1e3 * np.abs(at.sliding), PALETTE[4], ls=style)
    panels[0].set(ylabel="pressure angle / °")
    panels[1].set(ylabel="equivalent radius / mm")
    panels[2].set(ylabel="sliding / (mm/rad)", xlabel="pinion's rotation from P / °")
    panels[0].legend()


def main() -> None:
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        raise SystemExit(__doc__)
    pairs = {"CRC": td.drive(START), "free form": td.drive(sys.argv[1])}
    with house_style():
        figure = new_figure(10.0, 5.2)
        grid = figure.add_gridspec(3, 2, width_ratios=(1.15, 1.0))
        teeth(figure.add_subplot(grid[:, 0]), pairs)
        along([figure.add_subplot(grid[row, 1]) for row in range(3)], pairs)
        save(figure, PICTURES / "design-free-form.png", force=True)


if __name__ == "__main__":
    main()
