"""What is taken off the flanks on purpose or by error, drawn at random too, and how the axes deviate; SI.

Lengths are along the normal of the flank, positive where material is missing. z is the place along the axis,
from the middle of the faces; `start` is at the most negative z, `end` at the most positive.
`sharing.flank_gap` makes the gap between two flanks of it.

A sampled deviation is normally distributed about zero; its tolerance is three standard deviations, never
exceeded.
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.assembly import Assembly
from tribodyn.numerics.curve import Table
from tribodyn.numerics.shapes import Array, Float

#: Minimum number of slices where anything varies along the face.
MINIMUM_SLICES = 3


class Relief(NamedTuple):
    """Relief of one end of the profile: amount × (1 − distance/length)^exponent from that end inwards.

    The ends are those of the path of contact: the pinion's tip meets at its end, the gear's at its beginning.
    """

    amount: float = 0.0  # material missing at the end of the active profile, m along the normal
    #: how far it reaches from that end, m along the line of action (|Δr|, the roll length of an involute)
    length: float = 0.0
    exponent: float = 1.0  # 1: linear, 2: parabolic


class LeadRelief(NamedTuple):
    """Relief along the face: parabola, straight part, parabola (Jia et al., y1, y2, y3); crowning."""

    #: start, end: material missing at both ends of the face, m along the normal
    start: float = 0.0
    end: float = 0.0
    unmodified: float = 0.0  # length of the straight part, m
    #: material missing at both ends of a parabola over the whole face, m; adds to the relief
    crowning: float = 0.0
    #: material missing at the end of the face more than at its start, linear between, m; 0 in the middle
    slope: float = 0.0


class FlankModification(NamedTuple):
    """How the flanks of one gear differ from the family's: the driving flanks, or both."""

    tip: Relief = Relief()
    root: Relief = Relief()
    lead: LeadRelief = LeadRelief()
    #: twist: material missing at the tip at the end of the face and at the root at its start, added in the
    #: other corners, m along the normal; linear over roll and face
    bias: float = 0.0
    #: material missing along the normal over the pinion's roll angle from the pitch point (rad, m)
    profile_error: Table | None = None
    #: one per tooth in the order in which they enter, m along the normal, material missing > 0; empty: none
    pitch_error: tuple[float, ...] = ()
    #: whether the back flanks have the same reliefs and profile error; otherwise they are unmodified
    both_flanks: bool = False


class Misalignment(NamedTuple):
    """Angles between the axes, rad: the gear's against the pinion's, which meet at z = 0.

    Against the plane of action at the pitch point, not, as in ISO/TR 10064-3, as inclination f_Σδ (in the
    common plane of the axes) and skew f_Σβ (across it): of two such angles, positive where the gear stands
    off towards +y (away from the pinion) and +x at z > 0,

        in_plane = skew cos α_w + inclination sin α_w,  out_of_plane = inclination cos α_w − skew sin α_w.
    """

    in_plane: float = 0.0  # within the plane of action: the gap grows by this times z
    out_of_plane: float = 0.0  # perpendicular to it; of second order only, for an involute


def misalignment_of_tilts(tilts: Iterable[Sequence[float]], pressure_angle: float) -> Misalignment:
    """How gears stand by the tilts of both about x and y, rad; y is from the pinion's centre to the gear's.

    `pressure_angle` of the transverse section at the pitch point, rad.
    """
    pinion, gear = tilts
    skew, inclination = gear[1] - pinion[1], pinion[0] - gear[0]
    cosine, sine = math.cos(pressure_angle), math.sin(pressure_angle)
    return Misalignment(skew * cosine + inclination * sine, inclination * cosine - skew * sine)


class Modifications(NamedTuple):
    """Flanks of both gears, and how their axes stand."""

    pinion: FlankModification = FlankModification()
    gear: FlankModification = FlankModification()
    misalignment: Misalignment = Misalignment()


UNMODIFIED = Modifications()


def back_flanks(modifications: Modifications, pressure_angle: float) -> Modifications:
    """Return the back flanks as driving ones of the world mirrored about the plane of the axes.

    Pitch errors stay out: they place a tooth, and that of its back flank is another. Inclined axes open the
    driving and the back flanks alike, skew axes open the ones and close the others, so that `Misalignment`
    changes by the angle 2 α_w between the planes of action; α_w (rad) is that at the pitch point.
    """
    within, across = modifications.misalignment
    cosine, sine = math.cos(2.0 * pressure_angle), math.sin(2.0 * pressure_angle)
    misalignment = Misalignment(across * sine - within * cosine, within * sine + across * cosine)
    pinion, gear = (
        flank._replace(pitch_error=()) if flank.both_flanks else FlankModification()
        for flank in (modifications.pinion, modifications.gear)
    )
    return Modifications(pinion, gear, misalignment)


def turned_round(modifications: Modifications) -> Modifications:
    """The same looked at from the other end face, z the other way round."""
    pinion, gear = (
        flank._replace(
            lead=flank.lead._replace(start=flank.lead.end, end=flank.lead.start, slope=-flank.lead.slope),
            bias=-flank.bias,
        )
        for flank in (modifications.pinion, modifications.gear)
    )
    within, across = modifications.misalignment
    return Modifications(pinion, gear, Misalignment(-within, -across))


def vary_along_lead(modifications: Modifications) -> bool:
    """Whether anything differs from place to place along the face."""
    both = (modifications.pinion, modifications.gear)
    return any(modifications.misalignment) or any(
        flank.lead.start or flank.lead.end or flank.lead.crowning or flank.lead.slope or flank.bias
        for flank in both
    )


def too_few_slices(slices: int, varies: bool) -> InputError | None:
    """Return what is wrong with a number of slices of the face, over which something `varies`; else None."""
    if slices >= MINIMUM_SLICES or not (varies or slices > 1):
        return None
    rule = "too few for what varies along the face" if varies else "neither one slice nor enough of them"
    return InputError("mesh.slices", slices, rule, f"use at least {MINIMUM_SLICES}, or leave it out for 21")


def broken_flank_rules(
    side: str, flank: FlankModification, teeth: int, face_width: float
) -> Iterator[InputError]:
    """Go through what contradicts in the modification of one gear, whatever the shape of its teeth."""
    key = f"drive.{side}.modification."
    for name, relief in (("tip_relief", flank.tip), ("root_relief", flank.root)):
        if relief.amount and not relief.length:
            yield InputError(
                key + name,
                shown_length(relief.amount),
                "nothing says how far it reaches",
                f'add {name}_length = "3 mm", along the line of action',
            )
    lead, width = flank.lead, shown_length(face_width)
    rule = None
    if not 0.0 <= lead.unmodified <= face_width:
        rule = f"longer than the face of {width}" if lead.unmodified > 0.0 else "negative"
    elif lead.unmodified == face_width and (lead.start or lead.end):
        rule = f"leaves nothing of the face of {width} to the relief"
    if rule:
        unmodified = shown_length(lead.unmodified)
        yield InputError(key + "lead_unmodified", unmodified, rule, "use less than the face width")
    if flank.pitch_error and len(flank.pitch_error) != abs(teeth):
        yield InputError(
            key + "pitch_errors",
            shown_count(len(flank.pitch_error)),
            f"the gear has {abs(teeth)} teeth",
            "give one value per tooth",
        )


def uneven_teeth(modifications: Modifications) -> Iterator[InputError]:
    """Go through what differs from tooth to tooth, for a run in which one mesh cycle stands for all teeth."""
    for side in ("pinion", "gear"):
        if errors := getattr(modifications, side).pitch_error:
            yield InputError(
                f"drive.{side}.modification.pitch_errors",
                shown_count(len(errors)),
                "the run repeats one mesh cycle, in which all teeth are alike",
                "leave it out, or use a load contact study",
            )


def shown_length(value: float) -> str:
    """Write a length of `value` m with a unit that suits its size."""
    return f"{value * 1e6:g} um" if value < 1e-3 else f"{value * 1e3:g} mm"


def shown_count(count: int) -> str:
    """Write a number of values."""
    return f"{count} value{'s' if count != 1 else ''}"


#: Standard deviations from the mean to the tolerance.
SPREAD = 3.0
#: Waves of a form deviation over the path of contact, at most.
MOST_WAVES = 3
_POINTS = 65


class Limits(NamedTuple):
    """Tolerances of one gear, m: single and total pitch, profile slope and form, slope of the helix."""

    single_pitch: float
    total_pitch: float
    profile_slope: float
    profile_form: float
    helix_slope: float


class Deviations(NamedTuple):
    """Deviations of one gear."""

    #: (teeth,), index deviations of the flanks, m, positive where material is missing
    pitch: Float[Array, " tooth"]
    single_pitch: float  # pitch deviation between the two teeth of it that are in mesh first, m
    slope: float  # material missing at the tip more than at the root, m
    form: float  # peak to valley of the form deviation, m
    waves: int
    phase: float  # of the form deviation over the path of contact
    helix: float  # material missing at the end of the face more than at its start, m


def sampled(limits: Limits, teeth: int, seed: int, gear: int) -> Deviations:
    """Draw the deviations of one gear; the same for the same seed and number of the gear."""
    random = np.random.default_rng([seed, gear])

    def drawn(tolerance: float) -> float:
        return tolerance * float(np.clip(random.standard_normal() / SPREAD, -1.0, 1.0))

    slope, form = drawn(limits.profile_slope), abs(drawn(limits.profile_form))
    helix = drawn(limits.helix_slope)
    waves, phase = int(random.integers(1, MOST_WAVES + 1)), float(random.uniform(0.0, 2.0 * np.pi))
    steps = np.array([drawn(limits.single_pitch) for _ in range(teeth)])
    steps -= steps.mean()
    pitch = np.cumsum(steps)
    pitch -= pitch.mean()
    # their sum may leave the tolerances, which a gear of the class does not
    excess = max(np.ptp(pitch) / limits.total_pitch, np.abs(steps).max() / limits.single_pitch, 1.0)
    return Deviations(pitch / excess, float(steps[0] / excess), slope, form, waves, phase, helix)


def profile_curve(assembly: Assembly, pinion: Deviations, gear: Deviations, base_pitch: bool) -> Table:
    """Material missing on both profiles over the pinion's roll angle (rad, m).

    With `base_pitch` the pitch deviations of a pair of teeth count as a deviation of base pitch, which opens
    or closes the flanks evenly along the path: so that one mesh cycle can stand for all teeth.
    """
    start, end = (float(limit) for limit in assembly.roll_limits)
    share = np.linspace(0.0, 1.0, _POINTS)
    total = np.zeros(_POINTS)
    # the pinion's root meets first, the gear's tip
    for flank, along in ((pinion, share), (gear, share[::-1])):
        total += flank.slope * (along - 0.5)
        total += flank.form / 2.0 * np.cos(2.0 * np.pi * flank.waves * along + flank.phase)
    roll = np.linspace(start, end, _POINTS)
    if base_pitch:
        cosine = float(np.cos(assembly.path.pressure_angle(0.0)))
        total += cosine * (pinion.single_pitch + gear.single_pitch) * (share - 0.5) * assembly.contact_ratio
    return roll, total


def deviating(
    modifications: Modifications, assembly: Assembly, pinion: Deviations, gear: Deviations, every_tooth: bool
) -> Modifications:
    """Add sampled deviations to what is taken off the flanks.

    Teeth differ by their pitch deviations if `every_tooth`; otherwise these count as in `profile_curve`.
    """
    curve = profile_curve(assembly, pinion, gear, base_pitch=not every_tooth)
    widths = float(assembly.drive.pinion.face_width), float(assembly.drive.gear.face_width)
    opened = pinion.helix / widths[0] + gear.helix / widths[1]
    stand = modifications.misalignment
    first, second = modifications.pinion, modifications.gear
    if every_tooth:
        first, second = _with_pitch(first, pinion.pitch), _with_pitch(second, gear.pitch)
    profile = first.profile_error
    first = first._replace(profile_error=curve if profile is None else summed(profile, curve))
    return Modifications(first, second, Misalignment(stand.in_plane + opened, stand.out_of_plane))


def summed(first: Table, second: Table) -> Table:
    """Sum of two curves at the points of both, each held constant beyond its ends."""
    at = np.unique(np.concatenate([first[0], second[0]]))
    return at, np.interp(at, *first) + np.interp(at, *second)


def _with_pitch(flank: FlankModification, pitch: Float[Array, " tooth"]) -> FlankModification:
    pitch_error = np.asarray(flank.pitch_error) if len(flank.pitch_error) else 0.0
    return flank._replace(pitch_error=tuple(float(error) for error in pitch + pitch_error))
