"""What moves on a page: teeth that roll through mesh, and the bodies of a mechanism with their loads."""

from collections.abc import Mapping, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np

from tribodyn.post.cycles import along_path, in_the_middle, outside_of
from tribodyn.post.page.data import packed
from tribodyn.record.reader import Record

#: The dataset that says which pairs carry load.
LOAD = "normal_load"
#: Positions of the gears that are kept, evenly over the run.
MOST_FRAMES = 6000
#: Positions over a mesh cycle of gears that turn by themselves.
FRAMES_OF_A_CYCLE = 120


def rolling_teeth(record: Record) -> dict[str, Any] | None:
    """Outlines about their own axes, and for every frame roll angle, contact points and directions of load.

    All in metres and radians from the pitch point, x along the pitch tangent, y along the line of centres to
    the gear's. The pinion stands turned by −roll about (0, −r_p), the gear by roll r_p/r_g about (0, r_g).
    None for a record without outlines, or without a rotation.
    """
    if not {"geometry", "mesh_cycle"} <= set(record.groups):
        return None
    shape, cycle = record.geometry, record.mesh_cycle
    if not {"pinion_outline", "gear_outline", "path_of_contact"} <= set(shape):
        return None
    tabulated = {"phase", "signed_distance", "pressure_angle"} <= set(cycle)
    places = _of_the_table(record, cycle) if tabulated else _of_the_roll_angles(record, shape, cycle)
    if places is None or not len(places.roll):
        return None
    frames, kept = kept_frames(len(places.roll), MOST_FRAMES)
    return {"frames": kept} | _teeth(shape, _Places(*(values[frames] for values in places)))


def turning_teeth(shape: Mapping[str, Any], pinion_teeth: float) -> dict[str, Any]:
    """The same over one mesh cycle of gears of which no motion is known, by `geometry_arrays`."""
    radius = float(shape["pinion_pitch_radius"])
    distance, angle, roll = along_path(np.asarray(shape["path_of_contact"]), radius)
    pitch = 2.0 * np.pi / pinion_teeth
    phase = np.linspace(0.0, 1.0, FRAMES_OF_A_CYCLE, endpoint=False)[:, None]
    turned = roll[0] + pitch * (phase + np.arange(int(np.ceil((roll[-1] - roll[0]) / pitch))))
    place = np.where(turned <= roll[-1], np.interp(turned, roll, distance), np.nan)
    slope = np.interp(turned, roll, angle)
    places = _Places(turned[:, 0], place * np.cos(slope), place * np.sin(slope), slope)
    return {"frames": None, "turning": True} | _teeth(shape, places)


def key_rolls(start: float, end: float, pitch: float) -> dict[str, float]:
    """Roll angles (rad) of the key points in order: B_g, C_p, P, C_g, B_p as Liu & Ni name them.

    From `start` to `end` of contact with `pitch` between pairs, < 0 of an internal pinion; C_p and C_g only
    where one and two pairs alternate.
    """
    rolls = {"B_g": start, "P": 0.0, "B_p": end}
    if 1.0 < (end - start) / pitch < 2.0:
        rolls |= {"C_p": end - pitch, "C_g": start + pitch}
    return dict(sorted(rolls.items(), key=lambda item: item[1] / pitch))


class _Places(NamedTuple):
    """Roll angle of the pinion over the samples; contact point (NaN: no contact) and α of every pair."""

    roll: np.ndarray
    x: np.ndarray
    y: np.ndarray
    angle: np.ndarray


def kept_frames(samples: int, most: int) -> tuple[np.ndarray, str | None]:
    """Samples that are kept, evenly over the run, and as the page reads them: None where all are."""
    frames = np.unique(np.linspace(0, samples - 1, min(samples, most)).round().astype(int))
    return frames, None if len(frames) == samples else packed(frames, "<u4")


def _teeth(shape: Mapping[str, Any], places: _Places) -> dict[str, Any]:
    """Gears and where their pairs touch, as the page reads them."""
    return {
        "roll": packed(places.roll, "<f8"),
        "pairs": places.x.shape[1],
        "x": packed(places.x),
        "y": packed(places.y),
        "alpha": packed(places.angle),
        "pinion": packed(shape["pinion_outline"]),
        "gear": packed(shape["gear_outline"]),
        "path": packed(shape["path_of_contact"]),
        "radii": [float(shape[f"{side}_pitch_radius"]) for side in ("pinion", "gear")],
        "outside": outside_of(shape),
    }


def _of_the_table(record: Record, cycle: dict[str, Any]) -> _Places | None:
    """Places by the mesh cycle's table."""
    if "pinion_angle" in record:
        phase = np.asarray(record["pinion_angle"]) * cycle["pinion_teeth"] / (2.0 * np.pi)
    elif record.axis == "phase":
        phase = np.asarray(record["phase"])
    else:
        return None
    front = np.flatnonzero(np.asarray(cycle["side"]) > 0)

    def at_phase(name: str) -> np.ndarray:
        columns = in_the_middle(np.asarray(cycle[name])).T[front]
        return np.stack([np.interp(phase % 1.0, cycle["phase"], column) for column in columns], axis=1)

    touching = at_phase("share") > 0.0 if "share" in cycle else at_phase("in_contact") > 0.5
    distance = np.where(touching, at_phase("signed_distance"), np.nan)
    angle = at_phase("pressure_angle")
    roll = cycle["roll_start"] + phase * 2.0 * np.pi / cycle["pinion_teeth"]
    return _Places(roll, distance * np.cos(angle), distance * np.sin(angle), angle)


def _of_the_roll_angles(record: Record, shape: dict[str, Any], cycle: dict[str, Any]) -> _Places | None:
    """Places by the pairs' roll angles, where the path of contact leads them: dφ = dr/(r_p cos α).

    Beyond its ends a tip's corner touches: the gear's before them, the pinion's behind.
    """
    if not {"pinion_angle", "roll_angle", LOAD} <= set(record):
        return None
    distance, angle, roll = along_path(
        np.asarray(shape["path_of_contact"]), float(cycle["pinion_pitch_radius"])
    )
    rolled = np.asarray(record["roll_angle"])
    place = np.where(np.asarray(record[LOAD]) > 0.0, np.interp(rolled, roll, distance), np.nan)
    slope = np.interp(rolled, roll, angle)
    radii = float(cycle["pinion_pitch_radius"]), float(cycle["gear_pitch_radius"])
    before, behind = np.minimum(rolled - roll[0], 0.0), np.maximum(rolled - roll[-1], 0.0)
    x, y = place * np.cos(slope), place * np.sin(slope)
    x, y = _turned(x, y, -radii[0], -behind)
    x, y = _turned(x, y, radii[1], before * radii[0] / radii[1])
    return _Places(rolled[0, 0] + np.asarray(record["pinion_angle"]), x, y, slope)


def _turned(x: np.ndarray, y: np.ndarray, centre: float, by: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Points turned about an axis on the line of centres, anticlockwise."""
    c, s, along = np.cos(by), np.sin(by), y - centre
    return c * x - s * along, centre + s * x + c * along


#: Positions that are kept, evenly over the run, at least, and of all bodies and contacts together.
_MOST_POSES, _MOST_PLACES = 1500, 60_000


class Body(NamedTuple):
    """A body: its outline about its own centre, and where it is."""

    outline: np.ndarray  # (points, 2), m; NaN between closed lines that bound one area
    pose: np.ndarray  # (samples, 3); x and y of the centre, m, and rotation, rad, anticlockwise
    fill: Literal["pinion", "gear", "paper", "ring"]  # colour of the page; a ring is a line of `width`
    width: float = 0.0  # m
    opacity: float = 1.0  # of its area


class Sight(NamedTuple):
    """A part of a mechanism to look at."""

    label: str
    x: float  # middle, m
    y: float
    reach: float  # half of what is seen in height, m
    front: Sequence[int] = ()  # numbers of the bodies that lie in front then
    #: x and y (m) about which it turns with a body, and the number of that body; -1: it stands still
    turns: tuple[float, float, int] = (0.0, 0.0, -1)


class Mechanism(NamedTuple):
    """What a page shows of a mechanism, as a study describes it."""

    title: str  # heading of the section
    bodies: Sequence[Body]  # the one that lies in front comes last
    load: str  # dataset of the loads, by which arrows are as long; a curve for each contact
    contacts: np.ndarray  # (samples, contacts, 3); x, y, m, and direction of the load, rad
    reach: float  # half of what is seen in height, m
    longest: float  # length of the arrow of the largest load, m; shorter where less than `reach` is seen
    sights: Sequence[Sight] = ()  # to choose from; none: all of it


def mechanism_data(mechanism: Mechanism) -> dict[str, Any]:
    """A mechanism as the page reads it."""
    samples = len(mechanism.contacts)
    most = max(_MOST_POSES, _MOST_PLACES // (len(mechanism.bodies) + mechanism.contacts.shape[1]))
    frames, kept = kept_frames(samples, most)
    x, y, alpha = np.moveaxis(mechanism.contacts[frames], -1, 0)
    bodies = [
        body._asdict() | {"outline": packed(body.outline), "pose": packed(body.pose[frames])}
        for body in mechanism.bodies
    ]
    return {
        "frames": kept,
        "title": mechanism.title,
        "bodies": bodies,
        "pairs": x.shape[1],
        "x": packed(x),
        "y": packed(y),
        "alpha": packed(alpha),
        "reach": mechanism.reach,
        "longest": mechanism.longest,
        "sights": [sight._asdict() for sight in mechanism.sights],
    }
