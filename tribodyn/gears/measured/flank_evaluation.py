"""Deviations of measured flanks by ISO 1328-1: profile, helix, pitch and runout as numbers, and their class.

Traces are deviations normal to the flank in the transverse section, positive where there is too much
material, over the length of roll or the place along the face. Written from knowledge, without the standard at
hand. Of the edition of 2013 the mean line, found in the evaluation range, is extended to the tip or over the
whole face; that of 1995 takes its slope over the evaluation range. Lengths are in m.
"""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.standards.flank_tolerances import (
    FlankTolerances,
    flank_tolerances,
    flank_tolerances_1995,
    rounded,
)

#: Share of the profile, from its root's end, that is evaluated where nothing is said (2013: L_α).
PROFILE_SHARE = 0.95
#: Of the face, left out at either end, but at most a module (2013: L_β).
HELIX_SHARE = 0.05
CLASSES = range(1, 12)


class TraceDeviations(NamedTuple):
    """Deviations of one trace, m."""

    slope: float  # f_H: rise of the mean line over the reference length, from root to tip, datum face to end
    form: float  # f_f: range about the mean line
    total: float  # F: range of the trace


def evaluation_range(begin: float, end: float, helix: bool, module: float) -> tuple[float, float]:
    """Range that is evaluated of a profile (root to tip) or of a helix from begin to end (m)."""
    length = end - begin
    if not helix:
        return begin, begin + PROFILE_SHARE * length
    left_out = min(HELIX_SHARE * abs(length), module) * math.copysign(1.0, length)
    return begin + left_out, end - left_out


def trace_deviations(
    place: Float[Array, " point"],
    deviation: Float[Array, " point"],
    evaluated: tuple[float, float],
    reference_length: float,
) -> TraceDeviations:
    """Deviations of a trace in its evaluation range, by the line of least squares in it.

    Ends of the range between points are interpolated. Fewer than three points: ValueError.
    """
    order = np.argsort(place)
    x, y = np.asarray(place)[order], np.asarray(deviation)[order]
    low, high = max(min(evaluated), x[0]), min(max(evaluated), x[-1])
    inside = (x > low) & (x < high)
    ends = np.interp([low, high], x, y)
    x = np.concatenate(([low], x[inside], [high]))
    y = np.concatenate((ends[:1], y[inside], ends[1:]))
    if len(x) < 3:
        raise ValueError("has fewer than three points in its evaluation range")
    # points weigh by the length that they stand for, so that uneven ones count as even ones
    weight = np.convolve(np.diff(x), [0.5, 0.5])
    mean_x, mean_y = np.average(x, weights=weight), np.average(y, weights=weight)
    rise = np.sum(weight * (x - mean_x) * (y - mean_y)) / np.sum(weight * (x - mean_x) ** 2)
    apart = y - mean_y - rise * (x - mean_x)
    return TraceDeviations(float(rise * reference_length), float(np.ptp(apart)), float(np.ptp(y)))


def pitch_deviations(index: Float[Array, " tooth"]) -> tuple[float, float]:
    """f_p, the largest single pitch deviation with its sign, and F_p, the range of the index, m."""
    single = index - np.roll(index, 1)
    return float(single[np.argmax(np.abs(single))]), float(np.ptp(index))


def eccentricity_of(radial: Float[Array, " gap"]) -> tuple[float, float]:
    """Eccentricity (m) and its direction (rad, from the first gap on) in radial readings of every gap.

    The first harmonic: r_i = e cos(2π i/z − φ).
    """
    harmonic = 2.0 * np.fft.rfft(radial)[1] / len(radial)
    return float(abs(harmonic)), float(-np.angle(harmonic))


class FoundClasses(NamedTuple):
    """Tolerance classes that deviations keep; None: not even the coarsest."""

    each: Mapping[str, int | None]  # by the names of `FlankTolerances`
    overall: int | None


def classes_reached(
    deviations: Mapping[str, float], module: float, diameter: float, face_width: float, edition: int = 2013
) -> FoundClasses:
    """The finest class of ISO 1328-1 that each deviation (m, by its tolerance's name) keeps, and all of them.

    `module` is the normal one, `diameter` that of the reference circle, m; tolerances as they are printed.
    """
    formulas = flank_tolerances if edition == 2013 else flank_tolerances_1995
    allowed: dict[int, FlankTolerances] = {
        number: formulas(number, module, diameter, face_width) for number in CLASSES
    }

    def finest(name: str, value: float) -> int | None:
        keeping = (n for n, limits in allowed.items() if abs(value) <= rounded(getattr(limits, name)) + 1e-12)
        return next(keeping, None)

    each = {name: finest(name, value) for name, value in deviations.items()}
    found = [number for number in each.values() if number is not None]
    return FoundClasses(each, max(found) if found and len(found) == len(each) else None)
