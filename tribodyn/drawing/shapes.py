"""Gears and shafts as bodies in space: the outline of a tooth, what it is swept along, where each stands.

Along z, in the right-handed axes of a train; the middle of a gear's face is at z = 0 of its own frame.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.drawing.modified import Modified, modified
from tribodyn.geometry.assembly import Assembly, half_angles
from tribodyn.geometry.body import ToothOutline, half_profile, tooth_outline
from tribodyn.geometry.drive import SIDES, BodyMass, Side, body_of, reference_radius
from tribodyn.geometry.modification import UNMODIFIED, FlankModification, Modifications
from tribodyn.numerics.elementary import tan
from tribodyn.numerics.shapes import Array, Float

#: Points along a flank from which their number is found, and the least.
_TRIAL, _LEAST = 40, 8
#: Least pieces of the arc of half a root and of a tip.
_ARC = 3


class GearShape(NamedTuple):
    """A gear without a hub: one tooth, repeated about the axis and swept along it, and what is inside."""

    #: points of one tooth on the exact curve, from the middle of a gap counter-clockwise to the middle of the
    #: next, m; its axis of symmetry is x
    tooth: Float[Array, "point 2"]
    corners: tuple[int, ...]  # numbers of its points in which the outline has an edge
    ends: tuple[int, ...]  # and of those in which fillets, flanks and tip begin and end
    teeth: int
    internal: bool  # whether the material is outside the outline
    radius: float  # of the bore, of an internal gear of its outside, m; 0: a solid gear
    width: float  # m
    twist: float  # of the outline along z, counter-clockwise seen from +z, rad/m: right-hand where > 0
    tolerance: float  # distance of chords from the curve, m
    modified: tuple[Modified, ...] = ()  # what turns its points
    web: tuple[float, float] = (0.0, 0.0)  # inner radius of the rim and thickness of the web, m; 0: a disc

    @property
    def inside(self) -> tuple[tuple[float, float], ...]:
        """Corners of half a section beside the bore, radius and z, m, upwards; of a ring its outside."""
        (rim, web), half = self.web, self.width / 2.0
        if not rim:
            return (self.radius, -half), (self.radius, half)
        lower = (rim, -half), (rim, -web / 2.0), (self.radius, -web / 2.0)
        return *lower, *((radius, -z) for radius, z in reversed(lower))

    def thinned(self, z: Float[Array, " height"]) -> Float[Array, "height point"]:
        """Rotation of its points by modifications, counter-clockwise, rad, at heights, m."""
        none = np.zeros((len(z), len(self.tooth)))
        return sum((each.turned(z) for each in self.modified), none)

    def section(self, z: Float[Array, " height"]) -> Float[Array, "height point 2"]:
        """The tooth at heights, m."""
        return turned_about(self.tooth, self.thinned(z) + self.twist * z[:, None])


class ShaftShape(NamedTuple):
    """A shaft of cylinders from z = 0 on, or a ring."""

    length: tuple[float, ...]  # this and the next two: of every section, m
    radius: tuple[float, ...]
    bore: tuple[float, ...]
    tolerance: float


class ModifiedFlank(NamedTuple):
    """What is taken off a flank of a gear, and the mesh in which it works."""

    assembly: Assembly
    side: Side  # what the gear is in that mesh
    taken: FlankModification
    way: float  # +1: the start of its face is at the most negative z, −1: at the most positive


class PlacedPart(NamedTuple):
    """A part where it stands."""

    name: str
    shape: GearShape | ShaftShape  # one object for equal parts
    centre: tuple[float, float, float]  # of its own frame, m
    angle: float  # of its own x axis, counter-clockwise, rad
    fill: str  # "pinion", "gear", "ring", "shaft" or "bearing"
    turns: float = 0.0  # counter-clockwise for each turn of the first body; of a planet in space, not its pin
    orbits: float = 0.0  # of its centre about an axis, a planet's
    axis: tuple[float, float] = (0.0, 0.0)  # that axis, m


def gear_shape(
    assembly: Assembly,
    side: Side,
    tolerance: float,
    flanks: tuple[ModifiedFlank | None, ModifiedFlank | None] = (None, None),
    stated: BodyMass = BodyMass(),
) -> GearShape:
    """A gear of a pair of plain numbers; chords leave the outline by half the tolerance (m) at most.

    The other half is left to what the helix adds. `flanks`: at the lower and the upper angles of a tooth. A
    body is a rim with a web where both are `stated`.
    """
    body, tooth = body_of(assembly.drive, side), assembly.tooth(side)
    allowed = tolerance / 2.0
    trial = tooth_outline(tooth, 2 * _TRIAL + 1, 2 * _TRIAL + 1)
    flank, fillet = (
        _points(np.stack(curve, axis=-1), allowed)
        for curve in ((trial.flank_x, trial.flank_y), (trial.fillet_x, trial.fillet_y))
    )
    some = [each for each in flanks if each is not None]
    while any(_sag_of_flank(each, tooth_outline(tooth, 2 * flank - 1, fillet)) > allowed for each in some):
        flank += flank // 2
    shape = tooth_outline(tooth, flank, fillet)
    land = abs(float(np.pi / body.teeth - shape.root_half_angle)), abs(float(shape.root_radius))
    top = 2.0 * float(np.arcsin(shape.flank_y[-1] / abs(shape.tip_radius))), abs(float(shape.tip_radius))
    root, tip = (max(_ARC, pieces_of_arc(*arc, allowed)) for arc in (land, top))
    radius, angle = np.abs(half_profile(shape, body.teeth, root, 0))
    across = np.linspace(-angle[-1], angle[-1], tip + 1)[1:-1]
    radius = np.concatenate([radius, np.full(tip - 1, radius[-1]), radius[::-1]])
    angle = np.concatenate([-angle, across, angle[::-1]])
    ends = [root, root + fillet - 1, root + fillet + flank - 2]
    edges = ends[1:] if tooth.overrun > 0.0 else ends[2:]
    pinion_twist = float(tan(assembly.drive.helix_angle) / reference_radius(assembly.drive, "pinion"))
    ratio = float(assembly.drive.pinion.teeth / assembly.drive.gear.teeth)
    bore, rim = abs(float(body.bore_radius)), float(shape.root_radius) - (stated.rim or np.inf)
    return GearShape(
        tooth=np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1),
        corners=tuple(sorted(edges + [len(radius) - 1 - end for end in edges])),
        ends=tuple(sorted(ends + [len(radius) - 1 - end for end in ends])),
        teeth=abs(round(float(body.teeth))),
        internal=bool(body.teeth < 0),
        radius=bore,
        width=float(body.face_width),
        twist=pinion_twist if side == "pinion" else -pinion_twist * ratio,
        tolerance=tolerance,
        modified=tuple(
            _of_outline(_modified(each, shape), root, tip, upper)
            for upper, each in enumerate(flanks)
            if each is not None
        ),
        web=(rim, stated.web) if stated.web and rim > bore else (0.0, 0.0),
    )


def _modified(flank: ModifiedFlank, shape: ToothOutline) -> Modified:
    return modified(flank.assembly, flank.side, flank.taken, shape, flank.way)


def _of_outline(half: Modified, root: int, tip: int, upper: int) -> Modified:
    """Turns of the points of a whole tooth, by those of a half: its land goes from one end to the other."""

    def whole(turned: Float[Array, " point"]) -> Float[Array, " point"]:
        land = turned[-1] * np.linspace(1.0, 0.0, tip + 1)[1:-1]
        other = np.zeros(root + len(turned))
        lower = np.concatenate([np.zeros(root), turned, land, other])
        return -lower[::-1] if upper else lower

    return half._replace(
        over_profile=whole(half.over_profile),
        along_face=whole(half.along_face),
        at_the_end=whole(half.at_the_end),
    )


def _sag_of_flank(flank: ModifiedFlank, shape: ToothOutline) -> float:
    """By how much chords over every other point leave a flank, m."""
    turned = _modified(flank, shape).over_profile[len(shape.fillet_x) - 1 :]
    points = np.stack([shape.flank_x, shape.flank_y], axis=-1)
    return _sag(turned_about(points, -turned[None])[0])


def turned_about(
    points: Float[Array, "point 2"], angle: Float[Array, "height point"]
) -> Float[Array, "height point 2"]:
    """Points turned about the axis, each by its own angle, rad."""
    cosine, sine = np.cos(angle), np.sin(angle)
    x, y = points.T
    return np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=-1)


def pieces_of_arc(angle: float, radius: float, allowed: float) -> int:
    """Number of chords of an arc (rad, m) that leave it by so much at most, m."""
    return max(1, int(np.ceil(angle / (2.0 * np.arccos(max(1.0 - allowed / radius, 0.0))))))


def _points(curve: Float[Array, "point 2"], allowed: float) -> int:
    """Number of points of a curve whose chords leave it by so much at most; the trial has an odd number."""
    return max(_LEAST, 1 + int(np.ceil(_TRIAL * np.sqrt(_sag(curve) / allowed))))


def _sag(curve: Float[Array, "point 2"]) -> float:
    """By how much chords over every other point leave a curve at most, m."""
    start, middle, end = curve[:-1:2], curve[1::2], curve[2::2]
    (x, y), (u, v) = (end - start).T, (middle - start).T
    across = np.abs(x * v - y * u) / np.maximum(np.hypot(x, y), 1e-30)
    return float(across.max())


def modified_flank(
    assembly: Assembly, side: Side, taken: FlankModification, way: float
) -> ModifiedFlank | None:
    """A flank with what is taken off it; None where that is nothing. Teeth are alike: no pitch errors."""
    rest = taken._replace(pitch_error=(), both_flanks=False, profile_error=None)
    nothing = taken.profile_error is None and rest == FlankModification()
    return None if nothing else ModifiedFlank(assembly, side, taken, way)


def parts_of_pair(
    assembly: Assembly,
    tolerance: float,
    modifications: Modifications = UNMODIFIED,
    stated: tuple[BodyMass, BodyMass] = (BodyMass(), BodyMass()),
) -> list[PlacedPart]:
    """The gears of a pair while teeth touch at the pitch point; y from the pinion's axis to the gear's."""
    apart = float(assembly.path.pinion_pitch_radius + assembly.path.gear_pitch_radius)
    ring = {side for side in SIDES if body_of(assembly.drive, side).teeth < 0}
    parts = []
    for side, body, half, upwards in zip(SIDES, stated, half_angles(assembly), (1.0, -1.0), strict=True):
        direction = np.pi / 2.0 * (-upwards if side in ring else upwards) + half
        turns = -1.0 if side == "pinion" else float(assembly.drive.pinion.teeth / assembly.drive.gear.teeth)
        taken = getattr(modifications, side)
        front = modified_flank(assembly, side, taken, 1.0)
        flanks = front, front if taken.both_flanks else None
        if pushes_above(side, turns):
            flanks = flanks[1], flanks[0]
        shape = gear_shape(assembly, side, tolerance, flanks, body)
        centre = (0.0, 0.0 if side == "pinion" else apart, 0.0)
        fill = "ring" if side in ring else side
        parts.append(PlacedPart(side, shape, centre, float(direction), fill, turns))
    return parts


def pushes_above(side: Side, turns: float) -> bool:
    """Whether the driving flank of a gear that turns (counter-clockwise > 0) is at a tooth's upper angles.

    That in front of a tooth that drives, that behind one that is driven.
    """
    return (turns > 0.0) == (side == "pinion")
