"""Drawn shafts with gears and bearings for a page, bent as they are at every moment of a run."""

import numpy as np

from tribodyn.post.page.solid import CarriedDisc, Solid
from tribodyn.record.reader import Record
from tribodyn.studies.motion.drivetrain.gear_positions import gear_outlines, poses
from tribodyn.studies.motion.drivetrain.shaft_lines import deflections, rounded_down

#: Largest displacement as drawn, as a share of the size of the gearbox.
_BENT = 0.06
#: Width over diameter of what a shaft carries besides gears, and that over the shaft's diameter.
_FLAT, _WIDER = 0.25, 1.7

#: Width, radii of tip, root and bore, m.
_Sizes = tuple[float, float, float, float]


def deflected_gearbox(record: Record) -> Solid | None:
    """The shafts of a record; None where it does not have their bending at every moment."""
    parts = record.geometry
    if "station_follows" not in parts:
        return None
    moved = deflections(record)
    place = np.column_stack([parts[f"station_{name}"] for name in ("shaft", "centre", "z")])
    radii = np.column_stack([parts[f"section_{name}"] for name in ("shaft", "start", "end", "diameter")]) * [
        1.0,
        1.0,
        1.0,
        0.5,
    ]
    seats = []
    for shaft, z in zip(parts["seat_shaft"], parts["seat_z"], strict=True):
        x, y = place[place[:, 0] == shaft][0, 1:3]
        seats.append((x, y, z, _radius(radii, float(shaft), float(z))))
    discs = _discs(record, place, radii)
    carried = np.zeros((len(moved), 0, 3))
    if "seat_spot" in parts:
        spot = np.asarray(parts["seat_spot"], int)
        carried = np.where((spot >= 0)[:, None], deflections(record, "housing")[:, spot], 0.0)
    size = float(np.hypot(np.ptp(place[:, 3]), np.max(np.ptp(place[:, 1:3], axis=0))))
    largest = float(np.max(np.abs(moved)))
    return Solid(
        place,
        moved,
        radii,
        discs,
        np.array(seats),
        np.stack([record["bearing_force_x"], record["bearing_force_y"]], axis=-1),
        carried,
        rounded_down(_BENT * size / largest) if largest > 0.0 else 1.0,
    )


def _radius(radii: np.ndarray, shaft: float, z: float) -> float:
    """Largest radius of a shaft at z."""
    number, start, end, radius = radii.T
    return float(np.max(radius[(number == shaft) & (start <= z) & (z <= end)]))


def _discs(record: Record, place: np.ndarray, radii: np.ndarray) -> list[CarriedDisc]:
    parts = record.geometry
    z_of = dict(zip(np.asarray(parts["carried_body"], int).tolist(), parts["carried_z"], strict=True))
    turned, twists = poses(record)[..., 2], _twists(record)
    in_space = np.stack([record[name] for name in ("x", "y", "z", "tilt_x", "tilt_y")], axis=-1)

    def disc(
        body: int, name: str, sizes: _Sizes, teeth: int = 0, twist: float = 0.0, tooth: float = 0.0
    ) -> CarriedDisc:
        first = parts["sense"][body] == parts["sense"][0]
        fill = "ring" if not teeth else "pinion" if first else "gear"
        pose = np.column_stack([in_space[:, body], turned[body]])
        centre = (float(parts["centre"][body][0]), float(parts["centre"][body][1]))
        return CarriedDisc(name, float(z_of[body]), *sizes, teeth, twist, tooth, centre, fill, pose)

    def shaft_of(body: int) -> float:
        return float(place[np.argmin(np.hypot(*(place[:, 1:3] - parts["centre"][body]).T)), 0])

    found, toothed = [], set()
    for gear in gear_outlines(record):
        if gear.body not in z_of:
            continue
        toothed.add(gear.body)
        reach = np.hypot(*gear.outline[np.all(np.isfinite(gear.outline), axis=1)].T)
        tip, root = (gear.outside, gear.outside) if gear.internal else (gear.tip_radius, float(np.min(reach)))
        shaft = shaft_of(gear.body)
        bore = min(abs(gear.bore_radius), _radius(radii, shaft, float(z_of[gear.body])))
        sizes = float(parts["face_width"][gear.number]), tip, root, bore
        teeth, slope = twists[gear.number]
        twist = slope * sizes[0] / abs(gear.pitch_radius)
        tooth = float(parts["tooth_direction"][gear.number])
        teeth = 0 if gear.internal else teeth
        found.append(disc(gear.body, gear.name, sizes, teeth, twist, tooth))
    for body in z_of:
        if body not in toothed:
            radius = _WIDER * _radius(radii, shaft_of(body), float(z_of[body]))
            sizes = 2.0 * _FLAT * radius, radius, radius, 0.0
            found.append(disc(body, str(record["body"][body]), sizes))
    return found


def _twists(record: Record) -> dict[int, tuple[int, float]]:
    """Teeth of every gear, and the slope of its helix on the pitch circle, positive where right-handed.

    A mesh pushes its driver against its motion and, a right-handed one that turns counter-clockwise seen from
    +z, along +z.
    """
    parts, found = record.geometry, dict[int, tuple[int, float]]()
    axial = record.over_meshes("axial_force") if "axial_force" in record else None
    for m, mesh in enumerate(record.meshes):
        cycle = record.of_mesh(mesh, "mesh_cycle")
        driver, driven = (int(np.atleast_1d(parts[f"{end}_gear"])[m]) for end in ("driver", "driven"))
        along = 0.0 if axial is None else float(np.nan_to_num(np.mean(axial[:, m])))
        slope = float(cycle["pitch_slope"] * np.sign(along) * parts["sense"][int(parts["gear_body"][driver])])
        teeth = float(cycle["pinion_teeth"])
        ratio = float(cycle["gear_pitch_radius"] / cycle["pinion_pitch_radius"])
        found.setdefault(driver, (round(teeth), slope))
        found.setdefault(driven, (round(abs(teeth * ratio)), -slope))
    return found
