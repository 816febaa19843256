"""The teeth in mesh and the train in its true positions, as a page draws and rolls them."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from tribodyn.app.core.held import HeldMesh
from tribodyn.app.core.shown import tables_of
from tribodyn.drawing.shapes import GearShape
from tribodyn.gears.case import GearCase
from tribodyn.gears.check import sheet_tables
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.body import body_masses, gear_polygon
from tribodyn.geometry.drive import SIDES, body_of, tip_radius
from tribodyn.geometry.path import position
from tribodyn.geometry.sheet import geometry_sheet
from tribodyn.post.page.motion import key_rolls
from tribodyn.studies.motion.case import Gearbox
from tribodyn.studies.motion.drivetrain.placed_parts import placed_parts
from tribodyn.train.planetary import CARRIER

MILLIMETRE = 1e-3
#: Points of a flank, of the path of contact, and positions over one pitch.
FLANK, PATH, POSITIONS = 14, 61, 61
#: Distance of chords from the outlines of a whole train, m.
COARSE = 2e-5


def mesh_geometry(mesh: HeldMesh, assembly: Assembly, *, bodies: bool) -> dict[str, Any]:
    """Both gears of a mesh about their axes, the path of contact and where pairs touch on it; mm and rad.

    From the pitch point, x along the pitch tangent, y along the line of centres to the gear's axis. At a roll
    angle of the pinion its outline stands turned by `turn` times that, counter-clockwise; so does the gear's.
    `bodies`: whether their masses are shown.
    """
    path, drive = assembly.path, assembly.drive
    start, end = (float(limit) for limit in assembly.roll_limits)
    pitch = float(assembly.pitch_angle)
    radii = float(path.pinion_pitch_radius), float(path.gear_pitch_radius)
    rolls = key_rolls(start, end, pitch)
    gears = []
    for side, name, turn, place in zip(
        SIDES, mesh.gears, (-1.0, radii[0] / radii[1]), (-radii[0], radii[1]), strict=True
    ):
        body = body_of(drive, side)
        gears.append(
            {
                "name": name,
                "outline": np.asarray(gear_polygon(assembly, side, FLANK)) / MILLIMETRE,
                "centre": [0.0, place / MILLIMETRE],
                "turn": turn,
                "teeth": abs(round(float(body.teeth))),
                "internal": bool(body.teeth < 0),
                "pitch_radius": abs(radii[SIDES.index(side)]) / MILLIMETRE,
                "tip_radius": abs(float(tip_radius(drive, side))) / MILLIMETRE,
                "root_radius": abs(float(assembly.tooth(side).root_radius)) / MILLIMETRE,
                "bore_radius": abs(float(body.bore_radius)) / MILLIMETRE,
            }
        )
    along = np.linspace(start, end, PATH)
    roll = start + pitch * np.linspace(0.0, 1.0, POSITIONS)
    pairs = int(np.ceil((end - start) / pitch))
    rolled = roll[:, None] + pitch * np.arange(pairs)
    inside = (rolled - end) * np.sign(pitch) <= 1e-9
    return {
        "gears": gears,
        "roll_range": [start, end],
        "pitch": pitch,
        "path": _at(assembly, along),
        "key_points": {name: _at(assembly, np.asarray(roll)).tolist() for name, roll in rolls.items()},
        "rolls": roll,
        "contact": np.where(inside[..., None], _at(assembly, np.where(inside, rolled, end)), np.nan),
        "tables": tables_of(sheet_tables(_sheet(mesh.pair, assembly, bodies))),
    }


def _at(assembly: Assembly, roll: np.ndarray) -> np.ndarray:
    """Points of the path of contact at roll angles, mm, (…, 2)."""
    path = assembly.path
    return np.stack(position(path, path.signed_distance(roll)), axis=-1) / MILLIMETRE


def _sheet(pair: GearCase, assembly: Assembly, bodies: bool) -> dict[str, Any]:
    """The sheet of a mesh's gears as `check` lays it out, with their masses or without."""
    masses = None
    if bodies:
        given = [(body.mass, body.inertia) for body in pair.masses]
        masses = body_masses(assembly, given, [material.density for material in pair.materials])
    return geometry_sheet(assembly, masses, gear_torque=pair.operating.gear_torque)


def train_geometry(case: Gearbox) -> dict[str, Any]:
    """All gears in their true positions, mm, and how they turn over the rotation of the first body, rad/rad.

    Bodies of a planetary set go round the axis of their carrier at its rate, `orbit`, about `about`.
    """
    outlines: dict[int, np.ndarray] = {}
    carrier = {body: gearset.members[CARRIER] for gearset in case.sets for body in gearset.bodies}
    turning = [body.sense * float(body.ratio) for body in case.bodies]
    gears: list[Mapping[str, Any]] = []
    for gear, part in zip(case.gears, placed_parts(case, COARSE), strict=False):
        shape = part.shape
        assert isinstance(shape, GearShape)
        if id(shape) not in outlines:
            outlines[id(shape)] = _whole(shape)
        held = carrier.get(gear.body)
        gears.append(
            {
                "name": gear.name,
                "body": case.bodies[gear.body].name,
                "outline": outlines[id(shape)],
                "teeth": shape.teeth,
                "centre": [part.centre[0] / MILLIMETRE, part.centre[1] / MILLIMETRE],
                "angle": part.angle,
                "turn": turning[gear.body],
                "orbit": 0.0 if held is None else turning[held],
                "about": [each / MILLIMETRE for each in case.bodies[held].centre]
                if held is not None
                else None,
                "radius": shape.radius / MILLIMETRE,
                "internal": shape.internal,
                "plane": gear.plane,
                "fill": part.fill,
            }
        )
    meshes = [
        {
            "name": mesh.name,
            "driver": case.gears[mesh.gears[0]].name,
            "driven": case.gears[mesh.gears[1]].name,
        }
        for mesh in case.meshes
    ]
    return {"gears": gears, "meshes": meshes}


def _whole(shape: GearShape) -> np.ndarray:
    """The outline of all teeth, closed, mm; its first tooth along x."""
    turned = 2.0 * np.pi / shape.teeth * np.arange(shape.teeth)
    cosine, sine = np.cos(turned)[:, None], np.sin(turned)[:, None]
    x, y = shape.tooth[:-1].T
    points = np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1).reshape(-1, 2)
    return np.concatenate([points, points[:1]]) / MILLIMETRE
