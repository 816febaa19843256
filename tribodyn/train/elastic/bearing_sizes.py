"""Rolling elements of a bearing of which the catalogue gives bore, outside diameter and static rating.

ISO 76 rates the static load by Hertz: the most loaded of Z elements has 5 F/(Z cos α) and a pressure of its
raceways that leaves 1/10 000 of its diameter as a dent. With the elements' diameter by usual proportions the
number of balls, or the length of rollers, follows from C_0: what the stiffness depends on most.
"""

import math
from typing import NamedTuple

from tribodyn.train.elastic.rolling_bearing import BallRow, RollerRow, contact_pressure

#: Contact pressure, Pa, at which ISO 76 rates the static load: balls, self-aligning ones, rollers.
STATIC_PRESSURE, _SELF_ALIGNING_PRESSURE, _ROLLER_PRESSURE = 4200e6, 4600e6, 4000e6
#: Diameter of balls and rollers over (D − d)/2, by type; share of the pitch circle that rollers fill. Usual
#: proportions: of bearings whose inside is published (docs/shafts.md compares them); of self-aligning balls,
#: tapered and toroidal rollers assumed.
PROPORTIONS = {
    "deep-groove-ball": 0.60,
    "angular-contact-ball": 0.60,
    "four-point-contact-ball": 0.60,
    "self-aligning-ball": 0.44,
    "cylindrical-roller": 0.54,
    "tapered-roller": 0.50,
    "spherical-roller": 0.52,
    "toroidal-roller": 0.50,
}
#: The same of needle rollers, assumed.
NEEDLE = 0.4
_FILLED = {
    "cylindrical-roller": 0.8,
    "tapered-roller": 0.9,
    "spherical-roller": 0.83,
    "toroidal-roller": 0.9,
}


class ElementSizes(NamedTuple):
    """Rolling elements of one row; m."""

    elements: int
    diameter: float
    pitch_diameter: float
    length: float | None  # of rollers


def static_pressure(row: BallRow | RollerRow) -> float:
    """Pressure at which ISO 76 rates the static load, Pa."""
    if isinstance(row, RollerRow):
        return _ROLLER_PRESSURE
    return _SELF_ALIGNING_PRESSURE if row.aligning else STATIC_PRESSURE


def static_rating(row: BallRow | RollerRow) -> float:
    """C_0 of a row by ISO 76, N, from Hertz's contact in place of its table of f_0."""
    of_unit = contact_pressure(row, 1.0)
    exponent = 2.0 if isinstance(row, RollerRow) else 3.0
    load = (static_pressure(row) / of_unit) ** exponent
    return float(load * row.elements * math.cos(row.contact_angle) / 5.0)


def estimated(
    kind: str, bore: float, outside: float, rating: float, contact_angle: float, rows: int
) -> ElementSizes:
    """Estimate the elements of each of so many rows from d, D (m) and C_0 of all rows (N)."""
    pitch = (bore + outside) / 2.0
    diameter = PROPORTIONS[kind] * (outside - bore) / 2.0
    if kind not in _FILLED:
        one = BallRow(1, diameter, pitch, contact_angle=contact_angle, aligning=kind == "self-aligning-ball")
        return ElementSizes(max(round(rating / rows / static_rating(one)), 1), diameter, pitch, None)
    elements = round(_FILLED[kind] * math.pi / math.asin(diameter / pitch))
    of_length = static_rating(RollerRow(elements, diameter, 1.0, pitch, contact_angle=contact_angle))
    return ElementSizes(elements, diameter, pitch, rating / rows / of_length)
