"""What a gear pair's sheet says of backlash and of measured tooth thickness, in the engineer's units."""

import math
from typing import Any, NamedTuple

from tribodyn.geometry.assembly import Assembly, circumferential_backlash, normal_backlash
from tribodyn.geometry.drive import Side, body_of
from tribodyn.geometry.families.involute import inverse_involute, involute_function, tight_centre_distance


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


Quantity = tuple[float, str]

#: Pin over module where none is given: the usual wire of external spur gears (Van Keuren).
USUAL_PIN = 1.728


class Gauge(NamedTuple):
    """What a tooth thickness is measured with: teeth of the span, diameter of the pins, m; None: usual."""

    span_teeth: int | None = None
    pin_diameter: float | None = None


def backlash_lines(assembly: Assembly) -> dict[str, Quantity]:
    """Backlash of the pair and, of involutes, the centre distance at which it has none."""
    lines: dict[str, Quantity] = {}
    if assembly.family.involute:
        lines["centre distance without backlash"] = 1e3 * float(tight_centre_distance(assembly.drive)), "mm"
    rounding = 1e-12 * float(assembly.drive.module)
    for name, backlash in (
        ("normal backlash", normal_backlash(assembly)),
        ("circumferential backlash", circumferential_backlash(assembly)),
    ):
        lines[name] = 1e3 * (float(backlash) if abs(backlash) > 1e3 * rounding else 0.0), "mm"
    return lines


def thickness_lines(assembly: Assembly, side: Side, gauge: Gauge = Gauge()) -> dict[str, Quantity]:
    """Deviation of the tooth thickness and, of involutes, what gauges measure that touch on the flank."""
    drive, body = assembly.drive, body_of(assembly.drive, side)
    lines: dict[str, Quantity] = {
        "deviation of tooth thickness": (1e3 * float(body.thickness_allowance), "mm")
    }
    if not assembly.family.involute:
        return lines
    numbers = map(float, (drive.module, drive.pressure_angle, body.teeth, body.profile_shift))
    gear, allowance = Involute(*numbers), float(body.thickness_allowance)
    count = usual_span_teeth(gear) if gauge.span_teeth is None else gauge.span_teeth
    measured = span(gear, count, allowance)
    if _on_flank(assembly, side, span_contact_diameter(gear, measured)):
        lines |= {"teeth of the span": (float(count), ""), "span": (1e3 * measured, "mm")}
    pin = USUAL_PIN * gear.module if gauge.pin_diameter is None else gauge.pin_diameter
    if _on_flank(assembly, side, pin_contact_diameter(gear, pin, allowance)):
        lines |= {
            "pin diameter": (1e3 * pin, "mm"),
            "dimension over pins": (1e3 * over_pins(gear, pin, allowance), "mm"),
        }
    return lines


def _on_flank(assembly: Assembly, side: Side, diameter: Any) -> bool:
    tooth = assembly.tooth(side)
    radius = float(diameter) / 2
    return math.isfinite(radius) and bool(tooth.form_radius <= radius <= tooth.tip_radius)
