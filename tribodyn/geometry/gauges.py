"""What gauges measure of an involute's tooth thickness: span over teeth, dimension over pins or balls.

In the normal section, as drawings have it (ISO 21771); the pins of helical teeth are balls, or touch as balls
do where the number of teeth is even.
"""

import math
from typing import Any, NamedTuple

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import Drive, Side, body_of
from tribodyn.geometry.families.involute import inverse_involute, involute_function
from tribodyn.geometry.rack_section import normal_section


class Involute(NamedTuple):
    """A gear as its tooth thickness needs it: m_n (m), α_n (rad), teeth, x, β (rad, of either hand)."""

    module: float
    pressure_angle: float
    teeth: float
    profile_shift: float
    helix_angle: float = 0.0

    @property
    def transverse_angle(self) -> float:
        """α_t, rad."""
        if not self.helix_angle:  # to the last digit
            return self.pressure_angle
        return math.atan(math.tan(self.pressure_angle) / math.cos(self.helix_angle))

    @property
    def base_diameter(self) -> float:
        """d_b, m."""
        return self.module / math.cos(self.helix_angle) * self.teeth * math.cos(self.transverse_angle)

    @property
    def base_helix_angle(self) -> float:
        """β_b, rad: sin β_b = sin β cos α_n."""
        return math.asin(math.sin(abs(self.helix_angle)) * math.cos(self.pressure_angle))

    @property
    def virtual_teeth(self) -> float:
        """z_n = z/(cos² β_b cos β), of the spur gear that the normal section resembles."""
        return self.teeth / (math.cos(self.base_helix_angle) ** 2 * math.cos(self.helix_angle))


def span(gear: Involute, span_teeth: int, allowance: float = 0.0) -> float:
    """W_k over k teeth: m_n cos α_n [π (k − 1/2) + z inv α_t + 2 x tan α_n] + A_sn cos α_n."""
    turns = math.pi * (span_teeth - 0.5) + gear.teeth * float(involute_function(gear.transverse_angle))
    nominal = gear.module * (turns + 2 * gear.profile_shift * math.tan(gear.pressure_angle))
    return (nominal + allowance) * math.cos(gear.pressure_angle)


def allowance_of_span(gear: Involute, span_teeth: int, measured: float) -> float:
    """A_sn of a measured span: the inverse of `span`."""
    return (measured - span(gear, span_teeth)) / math.cos(gear.pressure_angle)


def usual_span_teeth(gear: Involute) -> int:
    """Number of teeth k at which the anvils touch nearest to the circle d + 2 x m_n.

    Of an internal gear, whose W_k is negative and lies over gaps, 1 less the number of gaps.
    """
    alpha = gear.pressure_angle
    middle = gear.module * (gear.teeth / math.cos(gear.helix_angle) + 2 * gear.profile_shift)
    chord = math.sqrt(max(middle**2 - gear.base_diameter**2, 0.0)) / math.cos(gear.base_helix_angle)
    turns = gear.teeth * float(involute_function(gear.transverse_angle))
    turns += 2 * gear.profile_shift * math.tan(alpha)
    if gear.teeth < 0:
        return min(round((-chord / (gear.module * math.cos(alpha)) - turns) / math.pi + 0.5), 0)
    return max(round((chord / (gear.module * math.cos(alpha)) - turns) / math.pi + 0.5), 1)


def span_contact_diameter(gear: Involute, measured: float) -> float:
    """Diameter on which the anvils touch the flanks, symmetrically: √(d_b² + (W_k cos β_b)²)."""
    return math.hypot(gear.base_diameter, measured * math.cos(gear.base_helix_angle))


def span_width(gear: Involute, measured: float) -> float:
    """Face width (m) that the anvils' touching points are apart along the axis: W_k sin β_b."""
    return measured * math.sin(gear.base_helix_angle)


def over_pins(gear: Involute, pin_diameter: float, allowance: float = 0.0) -> float:
    """Dimension M over two pins, or balls of helical teeth, of diameter D_M in opposite gaps.

    M = d_b/cos α_K + D_M with inv α_K = inv α_t + D_M/(m_n z cos α_n) − (π/2 − 2 x tan α_n − A_sn/m_n)/z;
    for an odd number of teeth d_b is taken times cos(π/(2 z)). NaN for pins so thin that they drop between
    the flanks.
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
    """Diameter on which the pins touch the flanks: tan α_y = tan α_K − D_M cos β_b/d_b."""
    reach = pin_diameter * math.cos(gear.base_helix_angle) / gear.base_diameter
    tangent = math.tan(_pin_angle(gear, pin_diameter, allowance)) - reach
    return gear.base_diameter * math.hypot(1.0, tangent)


def _pin_angle(gear: Involute, pin_diameter: float, allowance: float) -> float:
    """α_K; NaN for pins that touch no involute: they drop between the flanks."""
    involute = _pin_involute(gear, pin_diameter, allowance)
    return float(inverse_involute(involute)) if involute > 0.0 else math.nan


def _pin_involute(gear: Involute, pin_diameter: float, allowance: float) -> float:
    gap = math.pi / 2 - 2 * gear.profile_shift * math.tan(gear.pressure_angle) - allowance / gear.module
    normal_base = gear.base_diameter * math.cos(gear.base_helix_angle)  # m_n z cos α_n
    opened = float(involute_function(gear.transverse_angle)) + pin_diameter / normal_base
    return opened - gap / gear.teeth


def _opposite(gear: Involute) -> float:
    """Share of the diameter that opposite gaps stand apart: 1 for an even number of teeth."""
    return 1.0 if round(gear.teeth) % 2 == 0 else math.cos(math.pi / (2 * gear.teeth))


Quantity = tuple[float | str, str]

#: Pin over normal module where none is given: the usual wire of external spur gears (Van Keuren).
USUAL_PIN = 1.728
#: The usual wire of internal spur gears (Van Keuren).
USUAL_INTERNAL_PIN = 1.44


class Gauge(NamedTuple):
    """What a tooth thickness is measured with; None: usual."""

    span_teeth: int | None = None
    pin_diameter: float | None = None  # m


def involute_of(drive: Drive, side: Side) -> tuple[Involute, float]:
    """One gear of an involute drive in its normal section, and its A_sn, m."""
    written = normal_section(drive)
    body = body_of(written, side)
    numbers = written.module, written.pressure_angle, body.teeth, body.profile_shift, drive.helix_angle
    return Involute(*map(float, numbers)), float(body.thickness_allowance)


def thickness_lines(assembly: Assembly, side: Side, gauge: Gauge = Gauge()) -> dict[str, Quantity]:
    """Deviation of the tooth thickness and, of involutes, what gauges measure that touch on the flank."""
    if not assembly.family.involute:
        deviation = 1e3 * float(body_of(assembly.drive, side).thickness_allowance)
        return {"deviation of tooth thickness": (deviation, "mm")}
    gear, allowance = involute_of(assembly.drive, side)
    lines: dict[str, Quantity] = {"deviation of tooth thickness": (1e3 * allowance, "mm")}
    helical = gear.helix_angle != 0.0
    if gear.teeth < 0:
        return lines | _internal_lines(assembly, side, gauge)
    count = usual_span_teeth(gear) if gauge.span_teeth is None else gauge.span_teeth
    measured = span(gear, count, allowance)
    if _on_flank(assembly, side, span_contact_diameter(gear, measured)):
        wide = span_width(gear, measured) < float(body_of(assembly.drive, side).face_width)
        name = "span" if wide else "span that the face is too narrow to measure"
        lines |= {"teeth of the span": (float(count), ""), name: (1e3 * measured, "mm")}
        if helical:
            lines["face width that the span needs"] = 1e3 * span_width(gear, measured), "mm"
    pin = USUAL_PIN * gear.module if gauge.pin_diameter is None else gauge.pin_diameter
    if _on_flank(assembly, side, pin_contact_diameter(gear, pin, allowance)):
        one, several = ("ball", "balls") if helical else ("pin", "pins")
        lines |= {
            f"{one} diameter": (1e3 * pin, "mm"),
            f"dimension over {several}": (1e3 * over_pins(gear, pin, allowance), "mm"),
        }
    return lines


def _internal_lines(assembly: Assembly, side: Side, gauge: Gauge) -> dict[str, Quantity]:
    """What gauges measure of internal spur teeth: the span over gaps, the dimension between pins.

    The formulas of external teeth give both negative, with 1 less the number of gaps for that of teeth.
    """
    gear, allowance = involute_of(assembly.drive, side)
    lines: dict[str, Quantity] = {}
    count = usual_span_teeth(gear) if gauge.span_teeth is None else 1 - gauge.span_teeth
    measured = span(gear, count, allowance)
    if _on_flank(assembly, side, -span_contact_diameter(gear, measured)):
        lines |= {"gaps of the span": (1.0 - count, ""), "span over gaps": (-1e3 * measured, "mm")}
    pin = USUAL_INTERNAL_PIN * gear.module if gauge.pin_diameter is None else gauge.pin_diameter
    if _on_flank(assembly, side, pin_contact_diameter(gear, pin, allowance)):
        between = -1e3 * over_pins(gear, pin, allowance)
        lines |= {"pin diameter": (1e3 * pin, "mm"), "dimension between pins": (between, "mm")}
    return lines


def _on_flank(assembly: Assembly, side: Side, diameter: Any) -> bool:
    tooth = assembly.tooth(side)
    radius = float(diameter) / 2
    return math.isfinite(radius) and bool(tooth.form_radius <= radius <= tooth.tip_radius)
