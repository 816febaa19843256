"""A gear as it was measured: what files of measuring machines hold, by the words of ISO 21771 and ISO 1328-1.

Looked at from the datum face teeth are numbered clockwise from 1, and a tooth that points up has its right
flank on the right. Gap i is between tooth i and tooth i + 1. Lengths are in m, angles in rad. Deviations of
profile and helix are normal to the flank in the transverse section, positive where there is too much
material; those of pitch are along the arc, positive where the flank is clockwise of its place.
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from tribodyn.numerics.shapes import Array, Float

PROFILE, HELIX = "profile", "helix"
LEFT, RIGHT = "left", "right"
FLANKS = LEFT, RIGHT
#: Of what is measured, m or rad.
LARGEST = 1e3
#: What the place on a profile is.
ROLL_LENGTH, ROLL_ANGLE, DIAMETER = "roll length", "roll angle", "diameter"


class NominalGear(NamedTuple):
    """The gear as it was drawn, as far as a file says it."""

    teeth: int | None = None
    internal: bool | None = None
    module: float | None = None  # normal
    pressure_angle: float | None = None  # normal
    helix_angle: float | None = None  # magnitude
    hand: str | None = None  # "right", "left"
    profile_shift: float | None = None  # modules
    face_width: float | None = None
    tip_diameter: float | None = None


class FlankTrace(NamedTuple):
    """A profile or a helix of one flank."""

    kind: str  # `PROFILE`, `HELIX`
    tooth: int
    flank: str  # `LEFT`, `RIGHT`
    place: Float[Array, " point"]  # of a profile as `over` says, of a helix the distance from the datum face
    deviation: Float[Array, " point"]
    #: where it was taken: of a profile the distance from the datum face, of a helix the diameter; None: in
    #: mid-face, on the measuring circle
    at: float | None = None
    evaluated: tuple[float, float] | None = None  # places between which it is evaluated
    over: str = ROLL_LENGTH

    def over_roll_length(self, base_radius: float) -> "FlankTrace":
        """The trace over length of roll, on an involute of a base circle (m); a helix as it is."""
        if self.kind == HELIX or self.over == ROLL_LENGTH:
            return self

        def length(place: Float[Array, " point"]) -> Float[Array, " point"]:
            if self.over == ROLL_ANGLE:
                return base_radius * place
            return np.sqrt(np.maximum((place / 2.0) ** 2 - base_radius**2, 0.0))

        ends = None if self.evaluated is None else length(np.array(self.evaluated))
        evaluated = None if ends is None else (float(ends[0]), float(ends[1]))
        return self._replace(place=length(self.place), evaluated=evaluated, over=ROLL_LENGTH)


class MeasuredGear(NamedTuple):
    """All that was measured of a gear."""

    nominal: NominalGear = NominalGear()
    traces: tuple[FlankTrace, ...] = ()
    #: cumulative pitch deviations F_pi by flank
    pitch: Mapping[str, Float[Array, " tooth"]] = MappingProxyType({})
    radial: Float[Array, " gap"] | None = None  # readings of runout, positive outwards
    diameter: float | None = None  # measuring circle of pitch; None: the reference circle
    name: str = ""
    remarks: tuple[str, ...] = ()  # what was not used, and what was assumed

    def traces_of(self, kind: str, flank: str) -> list[FlankTrace]:
        """Profiles or helices of a flank, as the file has them."""
        return [trace for trace in self.traces if (trace.kind, trace.flank) == (kind, flank)]

    def beside(self, other: "MeasuredGear") -> "MeasuredGear":
        """What two files say of one gear; the second is asked where the first says nothing."""
        said = {name: value for name, value in self.nominal._asdict().items() if value is not None}
        nominal = other.nominal._replace(**said)
        return MeasuredGear(
            nominal,
            self.traces + other.traces,
            {**other.pitch, **self.pitch},
            other.radial if self.radial is None else self.radial,
            other.diameter if self.diameter is None else self.diameter,
            self.name or other.name,
            self.remarks + other.remarks,
        )


def index_of_single(single: Float[Array, " tooth"]) -> Float[Array, " tooth"]:
    """Index deviations of single pitch deviations; what does not close round the gear is spread evenly."""
    return np.cumsum(single - np.mean(single))
