"""Where the gears of a recorded train and the contacts between them are, in x and y of the train.

Bodies of a planetary set are recorded in the frame of their carrier; here all are in that of the housing.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.post.cycles import mesh_phases
from tribodyn.record.reader import Record
from tribodyn.studies.motion.drivetrain.carried_sets import carriers, driver_of, place_of, sets_of
from tribodyn.train.positions import frame_of

#: What a gear is in the pair of a mesh, and which way that pair rolls it about its axis in the pair's frame.
_ENDS = (("driver_gear", "pinion", -1.0), ("driven_gear", "gear", 1.0))


#: Room between planes beside each other, as a share of the width of the one before.
_GAP = 0.06
_CIRCLE = np.stack([np.cos(_TURN := np.linspace(0.0, 2.0 * np.pi, 361)), np.sin(_TURN)], axis=-1)


class GearOutline(NamedTuple):
    """A gear as it stands where the angle of its body is 0."""

    name: str
    number: int  # along the axis of gears
    body: int
    outline: Float[Array, "point 2"]  # about its axis, m
    #: tip_radius, pitch_radius, bore_radius: m; of a gear of several meshes the pitch circle in the first;
    #: negative of an internal gear, whose outline is its hole and whose bore its outside
    tip_radius: float
    pitch_radius: float
    bore_radius: float

    @property
    def internal(self) -> bool:
        """Whether its teeth point inwards."""
        return self.tip_radius < 0.0

    @property
    def outside(self) -> float:
        """Largest radius, m."""
        return -self.bore_radius if self.internal else self.tip_radius

    @property
    def edges(self) -> list[Float[Array, "point 2"]]:
        """Closed lines between which its material is, about its axis, m."""
        if self.bore_radius == 0.0:
            return [self.outline]
        return [self.outline, self.bore_radius * _CIRCLE]


def gear_outlines(record: Record) -> list[GearOutline]:
    """The gears of a train, the largest first, so that a small one beside it stays in sight."""
    places, names = record.geometry, record["gear"]
    outlines: dict[int, GearOutline] = {}
    for m, mesh in enumerate(record.meshes):
        shape, cycle = record.of_mesh(mesh, "geometry"), record.of_mesh(mesh, "mesh_cycle")
        frame = np.array(_frame(record, m))
        pitch = 2.0 * np.pi / cycle["pinion_teeth"]
        roll = cycle["roll_start"] + place_of(record, "phase", m) * pitch
        for end, side, way in _ENDS:
            gear = int(place_of(record, end, m))
            if gear in outlines:
                continue
            radius = float(shape[f"{side}_pitch_radius"])
            turned = way * roll * float(shape["pinion_pitch_radius"]) / radius
            about = np.array([[np.cos(turned), np.sin(turned)], [-np.sin(turned), np.cos(turned)]])
            outlines[gear] = GearOutline(
                str(names[gear]),
                gear,
                int(places["gear_body"][gear]),
                np.asarray(shape[f"{side}_outline"]) @ about @ frame,
                float(shape[f"{side}_tip_radius"]),
                radius,
                float(shape[f"{side}_bore_radius"]),
            )
    return sorted(outlines.values(), key=lambda gear: -gear.outside)


def poses(record: Record) -> Float[Array, "body time 3"]:
    """Centre (m) and rotation (rad, counter-clockwise) of every body."""
    places = record.geometry
    moved = np.stack([record.over_bodies("x"), record.over_bodies("y")], axis=-1)
    moved = np.nan_to_num(moved) + places["centre"]
    turned = places["sense"] * record.over_bodies("angle")
    for body, carrier in enumerate(carriers(record)):
        if carrier >= 0:
            frame = places["carried"][body] * record["reference_angle"]
            moved[:, body] = _carried(moved[:, body], places["centre"][carrier], frame)
    return np.swapaxes(np.concatenate([moved, turned[..., None]], axis=-1), 0, 1)


def gear_poses(record: Record) -> Float[Array, "gear time 3"]:
    """The same of every gear, the planes of a train with planetary sets beside each other."""
    bodies = np.asarray(record.geometry["gear_body"], int)
    gear_pose = poses(record)[bodies]
    gear_pose[..., :2] += shifts(record)[:, None]
    return gear_pose


def shifts(record: Record) -> Float[Array, "gear 2"]:
    """By how much every gear is drawn beside its place, m: where there are planetary sets, a plane by itself.

    Sets on one axis would cover each other. The planes stand in x, in the order of the meshes.
    """
    places = record.geometry
    shift = np.zeros((len(places["gear_body"]), 2))
    planes, right = np.asarray(places.get("plane", [0]), int), None
    if not np.any(carriers(record) >= 0) or len(set(planes.tolist())) == 1:
        return shift
    x, _, radius = reaches(record).T
    for plane in dict.fromkeys(int(planes[int(gear)]) for gear in np.atleast_1d(places["driver_gear"])):
        of_plane = planes == plane
        low, high = np.min((x - radius)[of_plane]), np.max((x + radius)[of_plane])
        right = low if right is None else right
        shift[of_plane, 0] = right - low
        right += (1.0 + _GAP) * (high - low)
    return shift


def reaches(record: Record) -> Float[Array, "gear 3"]:
    """Centre and radius (m) of the circle that every gear stays in, of one that is carried about its axis."""
    carried, centre = carriers(record), record.geometry["centre"]
    circles = np.zeros((len(record["gear"]), 3))
    for gear in gear_outlines(record):
        axis = centre[carried[gear.body] if carried[gear.body] >= 0 else gear.body]
        circles[gear.number] = *axis, gear.outside + float(np.hypot(*(centre[gear.body] - axis)))
    return circles


def axes_of(record: Record, sample: int) -> Float[Array, "body 2"]:
    """Axis of every body without load, m, the planes beside each other as `gear_poses` has them."""
    places, shift_of = record.geometry, shifts(record)
    axes, turned = np.array(places["centre"]), record["reference_angle"][sample]
    shift = np.zeros_like(axes)
    for gear in reversed(range(len(shift_of))):
        shift[int(places["gear_body"][gear])] = shift_of[gear]
    for gearset in sets_of(record):
        shift[gearset.carrier] = shift[gearset.planets[0]]
    for body, carrier in enumerate(carriers(record)):
        if carrier >= 0:
            axes[body] = _carried(axes[body], places["centre"][carrier], places["carried"][body] * turned)
    return axes + shift


def mesh_turns(record: Record, m: int) -> Float[Array, " time"]:
    """By how much the frame of a mesh has turned with its carrier, rad, counter-clockwise."""
    carried, driver = record.geometry.get("carried"), driver_of(record, m)
    return (0.0 if carried is None else float(carried[driver])) * record["reference_angle"]


def _axis(record: Record, m: int) -> Float[Array, "2"]:
    """About what a mesh turns, m."""
    body = driver_of(record, m)
    carrier = carriers(record)[body]
    return record.geometry["centre"][carrier if carrier >= 0 else body]


def _carried(
    points: Float[Array, "time 2"], axis: Float[Array, "2"], turned: Float[Array, " time"]
) -> Float[Array, "time 2"]:
    """Points (m) turned about an axis, counter-clockwise."""
    (x, y), cosine, sine = np.moveaxis(points - axis, -1, 0), np.cos(turned), np.sin(turned)
    return axis + np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)


def contacts(record: Record, displaced: bool = True) -> Float[Array, "time mesh pair 3"]:
    """Place (m) of every pair's contact, and direction (rad) of its load on the driven gear.

    On the driver's flank where that is displaced and turned by the load, or on both as they are without it.
    NaN where a pair carries no load.
    """
    places = record.geometry
    mirrored = np.where(np.array(record.pairs) > 1, -1.0, 1.0)  # of back flanks, about the line of centres
    load = record.over_meshes("normal_load")
    points = np.full((*load.shape, 3), np.nan)
    shift_of, stand = shifts(record), poses(record)
    for m, mesh in enumerate(record.meshes):
        along, across = (np.array(direction) for direction in _frame(record, m))
        body = driver_of(record, m)
        pitch_point = record.of_mesh(mesh, "geometry")["pinion_pitch_radius"] * across
        angle = record.over_meshes("pressure_angle")[:, m]
        normal = (mirrored * np.cos(angle))[..., None] * along + np.sin(angle)[..., None] * across
        turned = mesh_turns(record, m)
        centre = _carried(places["centre"][body], _axis(record, m), turned)
        if displaced:
            rolled = 2.0 * np.pi / record.of_mesh(mesh, "mesh_cycle")["pinion_teeth"] * _sense(record, m)
            turned = stand[body, :, 2] - rolled * (mesh_phases(record)[:, m] - place_of(record, "phase", m))
            centre = stand[body, :, :2]
        turned = turned[:, None]
        contact = pitch_point + record.over_meshes("signed_distance")[:, m, :, None] * normal
        points[:, m, :, :2] = _carried(contact, np.zeros(2), turned) + centre[:, None]
        points[:, m, :, :2] += shift_of[int(place_of(record, "driver_gear", m))]
        points[:, m, :, 2] = np.arctan2(normal[..., 1], normal[..., 0]) + turned
    return np.where(load[..., None] > 0.0, points, np.nan)


def _frame(record: Record, m: int) -> tuple[tuple[float, float], tuple[float, float]]:
    """Directions along and across of a mesh, while its carrier has not turned."""
    return frame_of(place_of(record, "azimuth", m), _sense(record, m))


def _sense(record: Record, m: int) -> int:
    """Sense in which the driver of a mesh turns; the other one of an internal gear."""
    radius = record.of_mesh(record.meshes[m], "geometry")["pinion_pitch_radius"]
    return int(record.geometry["sense"][driver_of(record, m)] * np.sign(radius))


def mesh_reach(record: Record, m: int, turned: float = 0.0) -> tuple[tuple[float, float], float]:
    """Pitch point of a mesh, m, and half the width of a square about it that shows its path of contact.

    `turned` is the angle of its carrier, rad.
    """
    places = record.geometry
    shape = record.of_mesh(record.meshes[m], "geometry")
    point = places["centre"][driver_of(record, m)] + shape["pinion_pitch_radius"] * np.array(
        _frame(record, m)[1]
    )
    x, y = (
        _carried(point, _axis(record, m), np.array(turned))
        + shifts(record)[int(place_of(record, "driver_gear", m))]
    )
    return (float(x), float(y)), 1.8 * float(np.abs(shape["path_of_contact"]).max())
