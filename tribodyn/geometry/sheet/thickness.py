"""Tooth thickness of involute gears as it is measured: over a span of teeth, over two pins (ISO 21771).

Lengths in m. Every measure is a closed form of base diameter d_b = m z cos α and of the deviation A_sn of the
tooth thickness on the reference circle from m (π/2 + 2 x tan α).
"""

import math
from typing import NamedTuple

from tribodyn.geometry.families.involute import inverse_involute, involute_function


class Involute(NamedTuple):
    """A spur gear as its tooth thickness needs it: module m, pressure angle rad, teeth, profile shift."""

    module: float
    pressure_angle: float
    teeth: float
    profile_shift: float

    @property
    def base_diameter(self) -> float:
        """d_b, m."""
        return self.module * self.teeth * math.cos(self.pressure_angle)


def span(gear: Involute, span_teeth: int, allowance: float = 0.0) -> float:
    """W_k over k teeth: m cos α [π (k − 1/2) + z inv α + 2 x tan α] + A_sn cos α."""
    alpha = gear.pressure_angle
    turns = math.pi * (span_teeth - 0.5) + gear.teeth * float(involute_function(alpha))
    nominal = gear.module * (turns + 2 * gear.profile_shift * math.tan(alpha))
    return (nominal + allowance) * math.cos(alpha)


def allowance_of_span(gear: Involute, span_teeth: int, measured: float) -> float:
    """A_sn of a measured span: the inverse of `span`."""
    return (measured - span(gear, span_teeth)) / math.cos(gear.pressure_angle)


def usual_span_teeth(gear: Involute) -> int:
    """Number of teeth k at which the anvils touch nearest to the circle d + 2 x m."""
    alpha = gear.pressure_angle
    middle = gear.module * (gear.teeth + 2 * gear.profile_shift)
    chord = math.sqrt(max(middle**2 - gear.base_diameter**2, 0.0)) / (gear.module * math.cos(alpha))
    turns = gear.teeth * float(involute_function(alpha)) + 2 * gear.profile_shift * math.tan(alpha)
    return max(round((chord - turns) / math.pi + 0.5), 1)


def span_contact_diameter(gear: Involute, measured: float) -> float:
    """Diameter of the circle on which the anvils touch the flanks, symmetrically: √(d_b² + W_k²)."""
    return math.hypot(gear.base_diameter, measured)


def over_pins(gear: Involute, pin_diameter: float, allowance: float = 0.0) -> float:
    """Dimension M over two pins of diameter D_M in opposite gaps.

    M = d_b/cos α_K + D_M with inv α_K = inv α + D_M/(m z cos α) − (π/2 − 2 x tan α − A_sn/m)/z; for an odd
    number of teeth d_b is taken times cos(π/(2 z)). NaN for pins so thin that they drop between the flanks.
    """
    centre = gear.base_diameter / math.cos(_pin_angle(gear, pin_diameter, allowance))
    return centre * _opposite(gear) + pin_diameter


def allowance_of_pins(gear: Involute, pin_diameter: float, measured: float) -> float:
    """A_sn of a measured dimension over pins: the inverse of `over_pins`; NaN where no gear has it."""
    cosine = gear.base_diameter * _opposite(gear) / (measured - pin_diameter)
    if not 0.0 < cosine <= 1.0:
        return math.nan
    opened = float(involute_function(math.acos(cosine)))
    return gear.module * gear.teeth * (opened - _pin_involute(gear, pin_diameter, 0.0))


def pin_contact_diameter(gear: Involute, pin_diameter: float, allowance: float = 0.0) -> float:
    """Diameter of the circle on which the pins touch the flanks: tan α_y = tan α_K − D_M/d_b."""
    tangent = math.tan(_pin_angle(gear, pin_diameter, allowance)) - pin_diameter / gear.base_diameter
    return gear.base_diameter * math.hypot(1.0, tangent)


def _pin_angle(gear: Involute, pin_diameter: float, allowance: float) -> float:
    """α_K; NaN for pins that touch no involute: they drop between the flanks."""
    involute = _pin_involute(gear, pin_diameter, allowance)
    return float(inverse_involute(involute)) if involute > 0.0 else math.nan


def _pin_involute(gear: Involute, pin_diameter: float, allowance: float) -> float:
    gap = math.pi / 2 - 2 * gear.profile_shift * math.tan(gear.pressure_angle) - allowance / gear.module
    opened = float(involute_function(gear.pressure_angle)) + pin_diameter / gear.base_diameter
    return opened - gap / gear.teeth


def _opposite(gear: Involute) -> float:
    """Share of the diameter that opposite gaps stand apart: 1 for an even number of teeth."""
    return 1.0 if round(gear.teeth) % 2 == 0 else math.cos(math.pi / (2 * gear.teeth))
