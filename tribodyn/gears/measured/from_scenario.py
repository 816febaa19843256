"""Deviations of a gear's teeth in a scenario, as a measuring machine would find them.

Whatever teeth have of their own counts: errors, formulas, samples, pitch, run-out. Eccentricity is in the
readings of runout too.
"""

import math

import numpy as np

from tribodyn.errors import InputError
from tribodyn.exchange.measured_gear import HELIX, PROFILE, FlankTrace, MeasuredGear
from tribodyn.gears.measured.mounted_gear import MountedGear
from tribodyn.gears.measured.to_scenario import NOTHING
from tribodyn.mesh.teeth.deviations import (
    FormulaErrors,
    MeasuredFlanks,
    PitchErrors,
    RunOut,
    ToothSample,
)
from tribodyn.numerics.shapes import Array, Float

_DEVIATIONS = (RunOut, PitchErrors, ToothSample, MeasuredFlanks, FormulaErrors)
#: Points over height and face where deviations are no table.
_HEIGHTS, _FACES = 33, 9


def measured_of(gear: MountedGear, datum: str) -> MeasuredGear:
    """A gear as it would be measured; InputError where its teeth have nothing of their own."""
    nominal = gear.nominal
    if nominal.internal:
        raise InputError(
            gear.key, gear.name, "is internal, and rings are not written", "name an external gear"
        )
    own = [each for each in gear.own if isinstance(each, _DEVIATIONS)]
    if not own:
        keys = "tooth_errors, tooth_formula, pitch_errors, eccentricity or mesh.tooth_sample"
        rule = "its teeth have no deviations of their own"
        raise InputError(gear.key, gear.name, rule, f"give it some: {keys}")
    remarks = () if len(own) == len(gear.own) else ("not written: damage",)
    traces: list[FlankTrace] = []
    index: dict[str, Float[Array, " tooth"]] = {}
    for flank in sorted(gear.flanks, key=lambda each: each not in gear.carrying):
        of_flank, placed = _flank(gear, flank, own, datum)
        traces += of_flank
        if placed is not None:
            index[gear.side(flank, datum)] = placed
    diameter = 2.0 * gear.reference_radius
    return MeasuredGear(
        nominal, tuple(traces), index, _radial(gear, own, datum), diameter, gear.name, remarks
    )


def _radial(gear: MountedGear, own: list, datum: str) -> Float[Array, " gap"] | None:
    """Readings of runout; None of a gear on its axis."""
    run_out = next((each for each in own if isinstance(each, RunOut) and each.eccentricity), None)
    if run_out is None:
        return None
    angle = run_out.eccentricity_angle if gear.clockwise(datum) else -run_out.eccentricity_angle
    gaps = (2.0 * np.arange(gear.teeth) + 1.0) * math.pi / gear.teeth
    return run_out.eccentricity * np.cos(gaps - angle)


def _flank(
    gear: MountedGear, flank: int, own: list, datum: str
) -> tuple[list[FlankTrace], Float[Array, " tooth"] | None]:
    """Traces and pitch of one flank of all teeth; none, None where there is nothing."""
    heights, faces = _grid(gear, flank, own)
    circle = gear.measuring_height(flank, None)
    along = np.concatenate((heights, [circle]))
    across = np.concatenate((faces, [0.0]))
    places = gear.flanks[flank].places(along, across)
    lacking = np.zeros((gear.teeth, len(along), len(across)))
    for tooth in range(gear.teeth):
        for each in own:
            if (fields := each.fields(tooth, flank, places)) is not None:
                lacking[tooth] += fields.gap.T
    if not np.any(np.abs(lacking) > NOTHING):
        return [], None
    at_circle = lacking[:, -1, -1]
    shape = lacking - at_circle[:, None, None]
    back = np.array([gear.tooth(number, datum) for number in range(1, gear.teeth + 1)])
    arc = at_circle[back] / gear.behind(flank, datum) * gear.reference_radius / gear.base_radius
    if not np.any(np.abs(shape) > NOTHING):
        return [], arc
    side = gear.side(flank, datum)
    low, high = gear.flanks[flank].roll_lengths(gear.base_radius)
    roll, distance = low + heights * (high - low), gear.from_datum(faces, datum)
    middle = float(gear.from_datum(np.zeros(1), datum)[0])
    traces = []
    separable = _separable(shape)
    for number, tooth in enumerate(back, start=1):
        deviation = -shape[tooth] / gear.lean
        if separable:
            traces.append(FlankTrace(PROFILE, number, side, roll, deviation[:-1, -1], middle))
            if len(faces) > 1:
                of_helix = 2.0 * gear.reference_radius
                traces.append(FlankTrace(HELIX, number, side, distance, deviation[-1, :-1], of_helix))
        else:
            traces += [
                FlankTrace(PROFILE, number, side, roll, deviation[:-1, k], float(distance[k]))
                for k in range(len(faces))
            ]
    return traces, arc


def _separable(shape: Float[Array, "tooth height face"]) -> bool:
    """Whether one profile and one helix of every tooth, which stand last, add up to its flank."""
    rest = shape - shape[:, -1:, :] - shape[:, :, -1:]
    return bool(np.max(np.abs(rest)) < 1e3 * NOTHING)


def _grid(gear: MountedGear, flank: int, own: list) -> tuple[Float[Array, " height"], Float[Array, " face"]]:
    """Heights and places along the face at which the flank is measured."""
    tables = [each for each in own if isinstance(each, MeasuredFlanks) and flank in each.flanks]
    height = [each.height for each in tables]
    face = [each.face for each in tables]
    half = gear.face_width / 2.0
    run_outs = [each for each in own if isinstance(each, RunOut)]
    drawn = any(isinstance(each, (ToothSample, FormulaErrors)) for each in own)
    if drawn or (run_outs and not tables):
        height.append(np.linspace(0.0, 1.0, _HEIGHTS))
    uneven = any(each.wobble or (each.eccentricity and gear.nominal.helix_angle) for each in run_outs)
    if drawn or (uneven and not tables):
        face.append(np.linspace(-half, half, _FACES))
    circle = gear.measuring_height(flank, None)
    heights = np.unique(np.round(np.concatenate((*height, [0.0, circle, 1.0])), 12))
    faces = np.unique(np.round(np.concatenate(face), 12)) if face else np.zeros(1)
    return heights, np.unique(np.append(faces, 0.0)) if len(faces) > 1 else np.zeros(1)
