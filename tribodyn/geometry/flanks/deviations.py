"""Samples of the deviations that gears of a tolerance class have, and what they take off the flanks.

A deviation is normally distributed about zero; its tolerance is three standard deviations, never exceeded.
"""

from typing import NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.flanks.modification import FlankModification, Misalignment, Modifications
from tribodyn.numerics.curve import Table
from tribodyn.numerics.shapes import Array, Float

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
    given = np.asarray(flank.pitch_error) if len(flank.pitch_error) else 0.0
    return flank._replace(pitch_error=tuple(float(error) for error in pitch + given))
