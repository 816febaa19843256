"""Where the flanks of a pair are pressed and where their depth is kept: positions, nodes, and between them.

The depth worn off a flank is kept at nodes over the roll angle at which a place of it is on the path of
contact, for both gears the same, and in slices over the face. Loads are found at positions of the mesh
cycle. Of spur gears the nodes are the positions of one pair on its path, both ends included; the slices of
helical pairs are late or early, and what is found at their positions is taken to the nodes linearly, and
back.

A tip's corner that touches a flank beyond the path of contact finds there what was worn off that flank on
the path. Corner contact itself wears nothing here: it would round the corner.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from tribodyn.compliance.sharing.held_flanks import HeldFlanks
from tribodyn.compliance.sharing.load_sharing import LoadedFlanks
from tribodyn.compliance.sharing.loaded_contact import face_shift, reach
from tribodyn.geometry.helix import normal_slope, pitch_slope, speed_share
from tribodyn.geometry.path import kinematics, pitch_point
from tribodyn.numerics.shapes import Array, Bool, Float, Int
from tribodyn.tribology.wear.law import specific_slip

# Corners are followed to a gap of so many deflections of a single pair: further than with new flanks.
_REACH = 4.0
# Share of a pitch by which a position counts as on the end of the path.
_AT_END = 1e-6


class Sliding(NamedTuple):
    """Kinematics at the positions for a pinion speed of 1 rad/s; (position, pair, slice or 1)."""

    pinion_speed: Float[Array, "position pair slice"]  # across the line of contact, m/rad
    gear_speed: Float[Array, "position pair slice"]
    sliding: Float[Array, "position pair slice"]  # |v_1 − v_2|, ≥ 0, m/rad
    #: slip path of the pinion's and the gear's flank per width of the contact, |v_1 − v_2|/|v_own|
    pinion_slip: Float[Array, "position pair slice"]
    gear_slip: Float[Array, "position pair slice"]


class WearPlaces(NamedTuple):
    """Positions of a mesh cycle, the pairs there, and the nodes of a flank."""

    held: HeldFlanks
    phase: Float[Array, " position"]  # mesh cycles since a pair entered its path in mid-face
    weight: Float[Array, " position"]  # of means over the mesh cycle; they sum to 1
    ages: Int[Array, " pair"]  # whole pitches since the pairs entered
    node: Float[Array, " node"]  # roll angles, rad, increasing, from the beginning of the path to its end
    on_path: Bool[Array, "position pair slice"]
    sliding: Sliding
    #: matrices from the nodes of pinion and gear to the positions, (slice or 1, position * pair, node)
    to_position: tuple[Float[Array, "slice sample node"], Float[Array, "slice sample node"]]
    to_node: Float[Array, "slice node sample"]  # and back; only positions on the path count
    #: width of every position along the roll of a pair, rad, so that sums over a pair's way are integrals
    along: Float[Array, "position pair slice"]
    #: area of the flanks of all teeth that a node stands for, pinion and gear, m²: times a depth along the
    #: normal the volume
    area: tuple[Float[Array, "node slice"], Float[Array, "node slice"]]
    #: length of a vanishing radius at the pitch point and its rate, as `contact_friction` takes them
    vanishing: tuple[float, float]


def places_of(flanks: LoadedFlanks, gear_torque: float, positions: int, early: float = 0.0) -> WearPlaces:
    """Lay out about so many positions in a mesh cycle, under the torque T_g > 0 (N m).

    A tooth may be `early` by so much against the next, m, beside its pitch error.
    """
    assembly = flanks.flexible.assembly
    (start, end), pitch = assembly.roll_limits, assembly.pitch_angle
    phase, weight = _phases((end - start) / pitch, positions)
    low, high = reach(flanks, gear_torque, _REACH, early)
    late = face_shift(flanks)
    first = math.floor((low - late - start) / pitch)
    last = math.ceil((high + late - start) / pitch) - 1
    ages = np.arange(last, first - 1, -1)
    roll = start + pitch * (phase[:, None] + ages)
    held = HeldFlanks(flanks, roll)
    close = _AT_END * pitch
    inside = roll[(roll >= start - close) & (roll <= end + close)]
    node = np.sort(np.clip(inside, start, end))
    at = flanks.rolls(roll)
    at = at if at.ndim == 3 else at[..., None]
    on_path = (at >= start - close) & (at <= end + close)
    geometry = held.faces.geometry
    rotations = [
        np.clip(np.nan_to_num(assembly.path.rotation(place)), start, end)
        for place in (geometry.pinion_place, geometry.gear_place)
    ]
    to_position = [_interpolation(node, _by_slice(rotation)) for rotation in rotations]
    to_node, along = _back(node, at, on_path)
    vanishing = pitch_point(assembly.path)
    return WearPlaces(
        held,
        phase,
        weight,
        ages,
        node,
        on_path,
        _sliding(flanks, held),
        (to_position[0], to_position[1]),
        to_node,
        along,
        _areas(flanks, node),
        (float(vanishing.length), float(vanishing.speed_per_radius)),
    )


def _phases(
    contact_ratio: float, positions: int
) -> tuple[Float[Array, " position"], Float[Array, " position"]]:
    """Phases between the entry of a pair and its leaving, both included, and their weights."""
    leave, parts, begin = contact_ratio % 1.0, [], 0.0
    for end in (leave if leave < 1.0 - _AT_END else 1.0, 1.0):
        if end - begin > _AT_END:
            cells = max(2, round(positions * (end - begin)))
            parts.append(begin + (end - begin) * np.arange(cells) / cells)
            begin = end
    phase = np.concatenate(parts)
    steps = np.diff(phase, append=1.0)
    return phase, (steps + np.roll(steps, 1)) / 2.0


def _by_slice(values: Float[Array, "position pair slice"]) -> Float[Array, "slice sample"]:
    return np.moveaxis(values, -1, 0).reshape(values.shape[-1], -1)


def _interpolation(
    node: Float[Array, " node"], at: Float[Array, "slice sample"]
) -> Float[Array, "slice sample node"]:
    """Linear between the nodes."""
    cell = np.clip(np.searchsorted(node, at, side="right") - 1, 0, len(node) - 2)
    beyond = (at - node[cell]) / (node[cell + 1] - node[cell])
    matrix = np.zeros((*at.shape, len(node)))
    np.put_along_axis(matrix, cell[..., None], (1.0 - beyond)[..., None], axis=-1)
    np.put_along_axis(matrix, cell[..., None] + 1, beyond[..., None], axis=-1)
    return matrix


def _back(
    node: Float[Array, " node"], roll: Float[Array, "position pair slice"], on_path: Bool[Array, "..."]
) -> tuple[Float[Array, "slice node sample"], Float[Array, "position pair slice"]]:
    """Matrices from positions on the path to nodes, linear beyond the last ones, and `WearPlaces.along`."""
    every, inside = _by_slice(roll), _by_slice(on_path)
    matrix, along = np.zeros((len(every), len(node), every.shape[1])), np.zeros(every.shape)
    for number, (at, mask) in enumerate(zip(every, inside, strict=True)):
        chosen = np.flatnonzero(mask)
        chosen = chosen[np.argsort(at[chosen], kind="stable")]
        covered = at[chosen]
        matrix[number][:, chosen] = _interpolation(covered, node[None])[0]
        edges = np.concatenate([node[:1], (covered[1:] + covered[:-1]) / 2.0, node[-1:]])
        along[number, chosen] = np.diff(edges)
    return matrix, np.moveaxis(along.reshape(-1, *roll.shape[:2]), 0, -1)


def _sliding(flanks: LoadedFlanks, held: HeldFlanks) -> Sliding:
    assembly, motion = flanks.flexible.assembly, held.faces.geometry.motion
    r = np.clip(motion.signed_distance, assembly.r_start, assembly.r_end)
    share = np.asarray(speed_share(pitch_slope(assembly), assembly.path, r))
    sliding = np.abs(motion.pinion_speed - motion.gear_speed)
    speeds = share * motion.pinion_speed, share * motion.gear_speed
    return Sliding(*speeds, sliding, specific_slip(speeds[0], sliding), specific_slip(speeds[1], sliding))


def _areas(flanks: LoadedFlanks, node: Float[Array, " node"]) -> tuple[Any, Any]:
    """Area of all flanks by node and slice: profile along v_own dφ, face along the axis, over cos β_n."""
    assembly = flanks.flexible.assembly
    r = assembly.path.signed_distance(node)
    motion = kinematics(assembly.path, r)
    steps = np.diff(node)
    width = np.concatenate([steps[:1], steps[1:] + steps[:-1], steps[-1:]]) / 2.0
    leaning = np.hypot(1.0, normal_slope(pitch_slope(assembly), motion.pressure_angle))
    face = flanks.flexible.width / flanks.slices * np.ones(flanks.slices)
    pinion, gear = (
        abs(float(teeth)) * (np.abs(speed) * width * leaning)[:, None] * face
        for teeth, speed in (
            (assembly.drive.pinion.teeth, motion.pinion_speed),
            (assembly.drive.gear.teeth, motion.gear_speed),
        )
    )
    return pinion, gear
