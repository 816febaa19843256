"""The oscillator's branches beyond the ends of their stable parts: what is measured and recorded of them."""

from typing import Any, NamedTuple

import numpy as np

from tribodyn.numerics.variable import Variable
from tribodyn.solve.branch.family import KINDS
from tribodyn.solve.branch.unstable import UnstableBranch
from tribodyn.studies.backlash_oscillator.motion import (
    FREE,
    INTEGRAL,
    MAXIMUM,
    MINIMUM,
    SQUARE,
    OscillatorMap,
)
from tribodyn.studies.sweeping import ends

#: Scale of the unstable motions.
SCALE = Variable(("unstable",), "1", "number of the unstable motion, those of a branch in its order")

_MOTION, _END = ("unstable",), ("end",)
VARIABLES: dict[str, Variable] = {
    "unstable_end": Variable(_MOTION, "1", "number of the end beyond which the branch goes on", "<i4", 0),
    "unstable_frequency": Variable(_MOTION, "1", "frequency of the excitation of an unstable motion"),
    "unstable_period": Variable(_MOTION, "1", "periods of the excitation in one of the motion", "<i4", 0),
    "unstable_rms_displacement": Variable(
        _MOTION, "1", "root mean square of its displacement about the mean, in half backlashes"
    ),
    "unstable_peak_to_peak_displacement": Variable(
        _MOTION, "1", "peak to peak of its displacement, in half backlashes"
    ),
    "unstable_contact_loss_fraction": Variable(_MOTION, "1", "share of the time without contact"),
    "unstable_multiplier_modulus": Variable(
        _MOTION, "1", "maximum modulus of its Floquet multipliers, above 1"
    ),
    "unstable_multiplier_angle": Variable(_MOTION, "rad", "angle of that multiplier"),
    "unstable_residual": Variable(_MOTION, "1", "change of displacement and velocity over one period"),
    "unstable_section_displacement": Variable(
        _MOTION, "1", "its displacement at the maximum excitation, in half backlashes"
    ),
    "unstable_section_velocity": Variable(_MOTION, "1", "velocity there"),
    "end_unstable_finish": ends.kind_variable(
        _END, "how the branch beyond stops being unstable; none: it leaves the range, or is lost"
    ),
    "end_unstable_finish_frequency": Variable(_END, "1", "frequency at which it stops being unstable"),
}


class Beyond(NamedTuple):
    """A branch beyond the end of its stable part.

    Attributes
    ----------
    end : place of that end in `Response.ends`
    rms, peak_to_peak, free : (P,), of its motions, as in `Response`
    """

    end: int
    branch: UnstableBranch
    rms: np.ndarray
    peak_to_peak: np.ndarray
    free: np.ndarray


def measured(end: int, branch: UnstableBranch, oscillator: OscillatorMap) -> Beyond:
    """A branch with the figures of its motions.

    Parameters
    ----------
    oscillator : at the branch's frequencies
    """
    figures = oscillator.figures(branch.states, np.arange(len(branch.values)), branch.period)
    duration = branch.period * 2.0 * np.pi / branch.values
    mean = figures[:, INTEGRAL] / duration
    rms = np.sqrt(np.maximum(figures[:, SQUARE] / duration - mean * mean, 0.0))
    return Beyond(end, branch, rms, figures[:, MAXIMUM] - figures[:, MINIMUM], figures[:, FREE] / duration)


def rows_of(beyond: Beyond) -> list[dict[str, Any]]:
    """Rows of the record, one for every motion."""
    branch = beyond.branch
    return [
        {
            "unstable_end": beyond.end + 1,
            "unstable_frequency": branch.values[i],
            "unstable_period": branch.period,
            "unstable_rms_displacement": beyond.rms[i],
            "unstable_peak_to_peak_displacement": beyond.peak_to_peak[i],
            "unstable_contact_loss_fraction": beyond.free[i],
            "unstable_multiplier_modulus": abs(orbit.multipliers[0]),
            "unstable_multiplier_angle": np.angle(orbit.multipliers[0]),
            "unstable_residual": orbit.residual,
            "unstable_section_displacement": orbit.state[0],
            "unstable_section_velocity": orbit.state[1],
        }
        for i, orbit in enumerate(branch.orbits)
    ]


def finish_row(beyond: Beyond) -> dict[str, Any]:
    """What the row of the end says of the branch beyond it."""
    finish = beyond.branch.finish
    if finish is None:
        return {}
    return {
        "end_unstable_finish": 1 + KINDS.index(finish.kind),
        "end_unstable_finish_frequency": finish.value,
    }


def described(beyond: Beyond) -> str:
    """A branch in words, for the summary."""
    branch, finish = beyond.branch, beyond.branch.finish
    goes = "no end in the range" if finish is None else f"{finish.kind} at {finish.value:.6g}"
    return (
        f"period {branch.period} between {np.min(branch.values):.6g} and {np.max(branch.values):.6g}, "
        f"multiplier at most {np.max(np.abs(branch.multipliers)):.4g}: {goes}"
    )
