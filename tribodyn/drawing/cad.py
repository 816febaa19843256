"""Files for CAD and wire erosion, in millimetres: DXF of gears, cutters and the pair, CSV of a profile.

Of helical gears the transverse section, and DXF files say so in a text on a layer of its own.
Outlines are closed polylines (LWPOLYLINE); circles are circles, so that a bore can be picked. What writes a
file raises as `write_output`.
"""

from io import StringIO
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from ezdxf import units
from ezdxf.filemanagement import new

from tribodyn.drawing.picture import gears_in_mesh
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.body import (
    ROOT_POINTS,
    TIP_POINTS,
    gear_polygon,
    half_profile,
    rack_outline,
    tooth_outline,
)
from tribodyn.geometry.drive import SIDES, Side, body_of, tip_circle_radius
from tribodyn.geometry.helix import hand_name, lead
from tribodyn.numerics.files.output_files import MARKS, write_output

#: Layer -> (AutoCAD colour index, line type).
LAYERS = {
    "OUTLINE": (7, "CONTINUOUS"),
    "BORE": (7, "CONTINUOUS"),
    "TIP_CIRCLE": (3, "DASHED2"),
    "PITCH_CIRCLE": (8, "CENTER2"),
    "ROOT_CIRCLE": (3, "DASHED2"),
    "ROLLING_LINE": (8, "CENTER2"),
    "CENTRE_LINE": (8, "CENTER2"),
    "PATH_OF_CONTACT": (1, "CONTINUOUS"),
    "TEXT": (8, "CONTINUOUS"),
}
#: Teeth of a rack cutter's drawing, and the height of its body above the root, in pitches.
RACK_TEETH, RACK_BACK = 5, 0.5
_MILLIMETRES = 1e3
# Far below what any machine resolves, far above rounding.
_SAME_POINT = 1e-12


def write_gear(
    path: Path, assembly: Assembly, side: Side, flank_points: int = 60, *, force: bool = False
) -> Path:
    """Draw one gear about its own axis, turned as it is while a pair touches at the pitch point."""
    drawing = _drawing()
    _add_gear(drawing, assembly, side, gear_polygon(assembly, side, flank_points), (0.0, 0.0))
    _say_section(drawing, assembly, (side,))
    return _saved(drawing, path, force)


def write_rack(
    path: Path, assembly: Assembly, side: Side, flank_points: int = 60, *, force: bool = False
) -> Path:
    """Draw the rack cutter of one body, teeth down, x along the rolling line from a tooth's axis."""
    drawing = _drawing()
    shape = rack_outline(assembly, side, flank_points)
    offsets = (np.arange(RACK_TEETH) - (RACK_TEETH - 1) / 2) * shape.pitch
    # Neighbouring pitches share the middle of a gap.
    x = np.concatenate([shape.x[:-1] + offset for offset in offsets] + [shape.x[-1:] + offsets[-1]])
    y = np.concatenate([shape.y[:-1]] * RACK_TEETH + [shape.y[-1:]])
    back = shape.root_height + RACK_BACK * shape.pitch
    outline = np.stack([np.append(x, [x[-1], x[0]]), np.append(y, [back, back])], axis=1)
    _add_outline(drawing, outline)
    _add_line(drawing, "ROLLING_LINE", np.array([[x[0], 0.0], [x[-1], 0.0]]))
    _say_section(drawing, assembly, (side,))
    return _saved(drawing, path, force)


def write_pair(path: Path, assembly: Assembly, flank_points: int = 60, *, force: bool = False) -> Path:
    """Draw both gears as a pair begins contact, with the path of contact, from the pitch point."""
    drawing = _drawing()
    mesh = gears_in_mesh(assembly, flank_points)
    centres = (0.0, -mesh.pitch_radii[0]), (0.0, mesh.pitch_radii[1])
    for side, outline, centre in zip(SIDES, (mesh.pinion, mesh.gear), centres, strict=True):
        _add_gear(drawing, assembly, side, outline, centre)
    _add_line(drawing, "CENTRE_LINE", np.array(centres))
    _add_line(drawing, "PATH_OF_CONTACT", mesh.path)
    _say_section(drawing, assembly, SIDES)
    return _saved(drawing, path, force)


def _say_section(drawing: Any, assembly: Assembly, sides: tuple[Side, ...]) -> None:
    """Say of helical gears which section is drawn, and how it turns along the axis."""
    drive = assembly.drive
    if not drive.helix_angle:
        return
    turns = ", ".join(
        f"{side} {hand_name(drive, side)}-hand, lead {_MILLIMETRES * float(lead(drive, side)):.6g} mm"
        for side in sides
    )
    text = f"Transverse section. Helix angle {np.degrees(abs(drive.helix_angle)):.6g} deg; {turns}"
    below = -2.0 * max(float(tip_circle_radius(drive, side)) for side in sides)
    drawing.modelspace().add_text(
        text,
        height=_MILLIMETRES * float(drive.module),
        dxfattribs={"layer": "TEXT", "insert": (0.0, _MILLIMETRES * below)},
    )


def _saved(drawing: Any, path: Path, force: bool) -> Path:
    stream = StringIO()
    drawing.write(stream)
    return write_output(path, stream.getvalue(), force=force)


def _drawing() -> Any:
    drawing = new("R2010", setup=["linetypes"], units=units.MM)
    drawing.header.custom_vars.append("Software", MARKS[".dxf"].decode().strip())
    for name, (color, linetype) in LAYERS.items():
        drawing.layers.add(name, color=color, linetype=linetype)
    return drawing


def _add_gear(
    drawing: Any, assembly: Assembly, side: Side, outline: np.ndarray, centre: tuple[float, float]
) -> None:
    """Add an outline (closed by its last point) and the circles about its axis, m."""
    _add_outline(drawing, outline[:-1])
    drive = assembly.drive
    circles = {
        "BORE": body_of(drive, side).bore_radius,
        "ROOT_CIRCLE": assembly.tooth(side).root_radius,
        "PITCH_CIRCLE": assembly.path_of(side).pinion_pitch_radius,
        "TIP_CIRCLE": tip_circle_radius(drive, side),
    }
    for layer, radius in circles.items():
        if radius:
            drawing.modelspace().add_circle(
                [_MILLIMETRES * place for place in centre],
                _MILLIMETRES * abs(float(radius)),  # negative of an internal gear
                dxfattribs={"layer": layer},
            )


def _add_outline(drawing: Any, points: np.ndarray) -> None:
    """Add a closed outline, m, without the points that a sharp corner or a pointed gap would repeat."""
    step = np.hypot(*(points - np.roll(points, 1, axis=0)).T)
    kept = points[step > _SAME_POINT]
    _add_line(drawing, "OUTLINE", kept, close=True)


def _add_line(drawing: Any, layer: str, points: np.ndarray, close: bool = False) -> None:
    line = drawing.modelspace().add_lwpolyline((), close=close, dxfattribs={"layer": layer})
    # at once: to append n points takes n² steps; behind x and y stand widths and a bulge, which are zero
    line.lwpoints.extend(np.pad(_MILLIMETRES * points, ((0, 0), (0, 3))))


class ToothProfile(NamedTuple):
    """One tooth from the middle of a gap to the middle of the next."""

    #: curve that each point belongs to: root, fillet, flank or tip; a point where two meet belongs to the
    #: fillet, or to the flank at the tip
    part: list[str]
    #: radius, angle: polar coordinates about the axis from the tooth's axis of symmetry, m and rad; the angle
    #: grows
    radius: np.ndarray
    angle: np.ndarray


def tooth_profile(assembly: Assembly, side: Side, flank_points: int = 60) -> ToothProfile:
    """Points of one tooth of a body, of plain numbers; the gear repeats it `teeth` times."""
    fillet_points = max(flank_points // 2, 8)
    shape = tooth_outline(assembly.tooth(side), flank_points, fillet_points)
    radius, angle = half_profile(shape, body_of(assembly.drive, side).teeth)
    part = [
        *["root"] * ROOT_POINTS,
        *["fillet"] * fillet_points,
        *["flank"] * (flank_points - 1),
        *["tip"] * TIP_POINTS,
    ]
    return ToothProfile(
        part + part[::-1], np.concatenate([radius, radius[::-1]]), np.concatenate([-angle, angle[::-1]])
    )


def write_profile(path: Path, profile: ToothProfile, *, force: bool = False) -> Path:
    """Write a profile as CSV: x along the tooth's axis outwards, y across, mm; raises as `write_output`."""
    x, y = profile.radius * np.cos(profile.angle), profile.radius * np.sin(profile.angle)
    columns = (1e3 * x, 1e3 * y, 1e3 * profile.radius, np.degrees(profile.angle))
    lines = [
        ",".join([part, *(f"{number:.9g}" for number in numbers)])
        for part, *numbers in zip(profile.part, *columns, strict=True)
    ]
    return write_output(path, MARKS[".csv"].decode() + "\n".join(lines) + "\n", force=force)
