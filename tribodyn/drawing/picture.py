"""The tooth pair as a picture: both gears whole, and the teeth in contact with their path."""

import numpy as np
from matplotlib.figure import Figure

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.body import gear_polygon
from tribodyn.geometry.drive import SIDES, tip_radius
from tribodyn.geometry.path import position
from tribodyn.post.figures.gears_in_mesh import GearsInMesh, draw_gears, draw_whole, key_rolls, placed
from tribodyn.post.style import WIDTH, house_style, literal, mark_panel, new_figure

_PATH_POINTS = 201


def gears_in_mesh(assembly: Assembly, flank_points: int = 60) -> GearsInMesh:
    """Place the gears of a drive as they stand when a pair begins contact."""
    path, drive = assembly.path, assembly.drive
    start, end = assembly.roll_limits
    rolls = key_rolls(start, end, assembly.pitch_angle)
    points = {name: position(path, path.signed_distance(np.asarray(roll))) for name, roll in rolls.items()}
    radii = float(path.pinion_pitch_radius), float(path.gear_pitch_radius)
    outlines = [np.asarray(gear_polygon(assembly, side, flank_points)) for side in SIDES]
    pinion, gear = placed(outlines[0], outlines[1], radii, start)
    along = path.signed_distance(np.linspace(start, end, _PATH_POINTS))
    return GearsInMesh(
        pinion=pinion,
        gear=gear,
        path=np.stack(position(path, along), axis=-1),
        pitch_radii=radii,
        tip_radii=(float(tip_radius(drive, "pinion")), float(tip_radius(drive, "gear"))),
        key_points={name: (float(x), float(y)) for name, (x, y) in points.items()},
        outside=(max(-float(drive.pinion.bore_radius), 0.0), max(-float(drive.gear.bore_radius), 0.0)),
    )


def pair_figure(assembly: Assembly, title: str, flank_points: int = 60) -> Figure:
    """Draw the pair: (a) whole, (b) the teeth in contact, tip and pitch circles, path and key points."""
    drive, mesh = assembly.drive, gears_in_mesh(assembly, flank_points)
    with house_style():
        # as tall as the whole pair at this width
        width = 1.5 * WIDTH
        across = 2 * max(*mesh.tip_radii, *mesh.outside)
        along = max(sum(mesh.tip_radii) + sum(mesh.pitch_radii), across)
        share = min(0.45, max(0.25, 0.62 * across / along))
        figure = new_figure(width, 0.8 * (1 - share) * width + 0.3)
        whole, close = figure.subplots(1, 2, width_ratios=(share, 1 - share))
        draw_whole(whole, mesh, (float(drive.pinion.bore_radius), float(drive.gear.bore_radius)))
        draw_gears(close, mesh)
        for letter, axes in zip("ab", (whole, close), strict=True):
            mark_panel(axes, letter)
        figure.suptitle(literal(title), x=0.01, ha="left", fontsize=10)
    return figure
