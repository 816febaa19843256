"""Pictures of the tooth families for the docs: teeth in mesh, path of contact, pressure angle and radius.

python -m tools.family_pictures           # writes docs/pictures/family-*.png
"""

from typing import Any

import numpy as np

from tools.marked_block import PICTURES
from tribodyn.gears.case import LubricatedCase
from tribodyn.gears.tabulated import tables
from tribodyn.geometry.assembly import assemble
from tribodyn.geometry.body import gear_polygon
from tribodyn.geometry.drive import SIDES
from tribodyn.geometry.families import family
from tribodyn.geometry.path import kinematics, position
from tribodyn.post.style import INK, PALETTE, house_style, new_figure, save
from tribodyn.studies.protocol.load import load_scenario
from tribodyn.tribology.contact import averaged_radius

SCENARIOS = {
    "involute": "involute-23-47",
    "crc": "crc-23-47",
    "cycloidal": "cycloidal-23-47",
    "parabolic": "parabolic-23-47",
    "circular-arc": "circular-arc-23-47",
    "s-gear": "s-gear-23-47",
    "points": "points-23-47",
    "spline": "spline-23-47",
    "high-contact-ratio": "high-contact-ratio",
}


def teeth(axes: Any, pair: LubricatedCase) -> None:
    """Draw both gears about the pitch point, touching there, with the path of contact."""
    kind = family(pair.family)
    assembly = assemble(kind, pair.drive)
    for side, colour in zip(SIDES, PALETTE, strict=False):
        outline = np.asarray(gear_polygon(assembly, side))
        pitch = getattr(assembly.path, f"{side}_pitch_radius")
        centre = -pitch if side == "pinion" else pitch
        axes.fill(1e3 * outline[:, 0], 1e3 * (outline[:, 1] + centre), colour, alpha=0.25, lw=0)
        axes.plot(1e3 * outline[:, 0], 1e3 * (outline[:, 1] + centre), colour, lw=1.0, label=side)
    x, y = position(assembly.path, np.linspace(assembly.r_start, assembly.r_end, 401))
    axes.plot(1e3 * x, 1e3 * y, INK, lw=1.6, label="path of contact")
    axes.plot(0, 0, "o", color=INK, ms=3)
    axes.annotate("P", (0, 0), (3, 3), textcoords="offset points")
    span = 4.2 * 1e3 * pair.drive.module
    axes.set(
        xlim=(-span, span), ylim=(-0.7 * span, 0.7 * span), aspect="equal", xlabel="x / mm", ylabel="y / mm"
    )
    axes.legend(loc="lower right")


def contact(angle: Any, radius: Any, pair: LubricatedCase) -> None:
    """Draw pressure angle and equivalent radius along the path; averaged where it vanishes at P."""
    cycle = tables(pair).cycle
    assembly = assemble(family(pair.family), pair.drive)
    r = np.linspace(assembly.r_start, assembly.r_end, 802)
    at = kinematics(assembly.path, r)
    angle.plot(1e3 * r, np.degrees(at.pressure_angle), PALETTE[2])
    angle.set(ylabel="pressure angle / °", ylim=(0, 1.1 * np.degrees(np.max(at.pressure_angle))))
    equivalent = 1 / at.relative_curvature
    radius.plot(1e3 * r, 1e3 * equivalent, PALETTE[3], label="at the point")
    length = float(cycle.pitch_point_length)
    if length > 0:
        width = min(body.face_width for body in (pair.drive.pinion, pair.drive.gear))
        load = pair.operating.gear_torque / float(cycle.gear_pitch_radius) / width
        modulus = 2 / sum((1 - m.poisson_ratio**2) / m.youngs_modulus for m in pair.materials)
        radius.plot(
            1e3 * r, 1e3 * averaged_radius(equivalent, load, modulus, length), INK, ls="--", label="averaged"
        )
        radius.legend()
    radius.set(
        xlabel="signed distance from P / mm",
        ylabel="equivalent radius / mm",
        ylim=(0, 1.1e3 * np.max(equivalent)),
    )


def main() -> None:
    for name, scenario in SCENARIOS.items():
        pair = load_scenario(scenario).pair
        with house_style():
            figure = new_figure(8.0, 3.8)
            grid = figure.add_gridspec(2, 2, width_ratios=(1.4, 1))
            teeth(figure.add_subplot(grid[:, 0]), pair)
            contact(figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, 1]), pair)
            print(save(figure, PICTURES / f"family-{name}.png", force=True))


if __name__ == "__main__":
    main()
