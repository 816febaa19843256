"""What gauges measure of an involute's tooth thickness: span over teeth, dimension over pins or balls.

In the normal section, as drawings have it (ISO 21771). Cylindrical pins of helical gears measure as balls do
where the number of teeth is even, less where it is odd.
"""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import Drive, Side, body_of
from tribodyn.geometry.families.involute import inverse_involute, involute_function
from tribodyn.geometry.helix import normal_section


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


def over_rollers(gear: Involute, pin_diameter: float, allowance: float = 0.0) -> float:
    """Dimension M over two cylindrical pins in opposite gaps, between parallel anvils that both bear along.

    Of an even number of teeth, and of spur gears, it is that of `over_pins`. Of an odd number the pins of
    helical gears lie askew, and slide along their gaps until M is least:

    M = D_M + d_K min_λ [cos λ + (λ − λ_0) sin λ]/√(1 + tan² β_K sin² λ), λ_0 = π/(2 z), tan β_K = tan β d_K/d

    the common normal of two straight lines that touch the helices of the pins' centres, d_K = d_b/cos α_K, at
    λ from the anvils' normal. Some 10 µm less than over balls. NaN for helices near 45° and beyond, where no
    M is least.
    """
    if not gear.helix_angle or round(gear.teeth) % 2 == 0:
        return over_pins(gear, pin_diameter, allowance)
    from scipy.optimize import minimize_scalar

    centre = gear.base_diameter / math.cos(_pin_angle(gear, pin_diameter, allowance))
    pitch = gear.module / math.cos(gear.helix_angle) * gear.teeth
    slope, aside = math.tan(gear.helix_angle) * centre / pitch, math.pi / (2 * gear.teeth)
    if not slope * slope < _STEEPEST:
        return math.nan

    def apart(angle: float) -> float:
        across = math.cos(angle) + (angle - aside) * math.sin(angle)
        return across / math.hypot(1.0, slope * math.sin(angle))

    most = 2.0 * aside / (1.0 - slope * slope)  # twice where it is least, to the first order
    least = minimize_scalar(apart, bounds=(0.0, most), method="bounded", options={"xatol": 1e-9})
    return centre * float(least.fun) + pin_diameter


#: tan² β_K up to which pins askew come to rest.
_STEEPEST = 0.8

Quantity = tuple[float | str, str]

#: Pin over normal module where none is given and it measures: the usual wire of external spur gears (Van
#: Keuren), and of internal ones.
USUAL_PIN, USUAL_INTERNAL_PIN = 1.728, 1.44
#: Pins over normal module that are looked through for one that measures, nearest to the usual one first, and
#: by how much of the module it must stand out of the tip circle.
_PINS, _OUT = tuple(n / 100.0 for n in range(80, 401)), 0.05


class Gauge(NamedTuple):
    """What a tooth thickness is measured with; None: usual."""

    span_teeth: int | None = None
    pin_diameter: float | None = None  # m
    tolerance: float = 0.0  # of the tooth thickness, m: half of it on either side of its mean


def involute_of(drive: Drive, side: Side) -> tuple[Involute, float]:
    """One gear of an involute drive in its normal section, and its A_sn, m."""
    written = normal_section(drive)
    body = body_of(written, side)
    numbers = written.module, written.pressure_angle, body.teeth, body.profile_shift, drive.helix_angle
    return Involute(*map(float, numbers)), float(body.thickness_allowance)


def thickness_lines(assembly: Assembly, side: Side, gauge: Gauge = Gauge()) -> dict[str, Quantity]:
    """Deviation of the tooth thickness and, of involutes, what gauges measure.

    Where no span or pin measures the teeth, or the given one does not, that is said in the dimension's place.
    """
    if not assembly.family.involute:
        deviation = 1e3 * float(body_of(assembly.drive, side).thickness_allowance)
        return {"deviation of tooth thickness": (deviation, "mm")}
    _, allowance = involute_of(assembly.drive, side)
    lines: dict[str, Quantity] = {"deviation of tooth thickness": (1e3 * allowance, "mm")}
    return lines | _span_lines(assembly, side, gauge) | _pin_lines(assembly, side, gauge)


def _span_lines(assembly: Assembly, side: Side, gauge: Gauge) -> dict[str, Quantity]:
    """Span over teeth, of internal gears over gaps.

    The formulas of external teeth give that negative, with 1 less the number of gaps for that of teeth.
    """
    gear, allowance = involute_of(assembly.drive, side)
    internal = gear.teeth < 0
    width = float(body_of(assembly.drive, side).face_width)

    def touches(count: int) -> bool:
        diameter = span_contact_diameter(gear, span(gear, count, allowance))
        return _on_flank(assembly, side, -diameter if internal else diameter)

    def fits(count: int) -> bool:
        return span_width(gear, abs(span(gear, count, allowance))) < width

    if gauge.span_teeth is not None:
        count = 1 - gauge.span_teeth if internal else gauge.span_teeth
        counts = [count] if touches(count) else []
    else:
        nominal = usual_span_teeth(gear)
        around = sorted(range(nominal - 3, nominal + 4), key=lambda each: abs(each - nominal))
        counts = [each for each in around if (each < 1) == internal and touches(each)]
        counts = [each for each in counts if fits(each)] or counts
    what, of = ("gaps", "span over gaps") if internal else ("teeth", "span")
    if not counts:
        which_number = "of so many" if gauge.span_teeth is not None else "of any number"
        return {of: (f"none: anvils over {what} {which_number} do not touch the flanks", "")}
    count, sign = counts[0], -1.0 if internal else 1.0
    name = of if fits(count) else f"{of} that the face is too narrow to measure"
    lines = {f"{what} of the span": (1.0 - count if internal else float(count), "")}
    lines |= _with_limits(name, lambda deviation: sign * span(gear, count, deviation), allowance, gauge)
    if gear.helix_angle:
        needed = span_width(gear, abs(span(gear, count, allowance)))
        lines["face width that the span needs"] = 1e3 * needed, "mm"
    return lines


def _pin_lines(assembly: Assembly, side: Side, gauge: Gauge) -> dict[str, Quantity]:
    """Dimension over pins, of internal gears between them, of helical gears over balls and pins."""
    gear, allowance = involute_of(assembly.drive, side)
    internal, helical = gear.teeth < 0, gear.helix_angle != 0.0
    one, several = ("ball", "balls") if helical else ("pin", "pins")
    name = f"dimension {'between' if internal else 'over'} {several}"
    sign, pin = -1.0 if internal else 1.0, gauge.pin_diameter
    if pin is None:
        pin = usual_pin(assembly, side)
        if pin is None:
            return {name: ("none: no pin touches the flanks and stands out of the tip circle", "")}
    elif why := pin_fails(assembly, side, pin):
        return {f"{one} diameter": (1e3 * pin, "mm"), name: (f"none: {why}", "")}
    lines = {f"{one} diameter": (1e3 * pin, "mm")}
    lines |= _with_limits(name, lambda deviation: sign * over_pins(gear, pin, deviation), allowance, gauge)
    if helical and not internal and math.isfinite(over_rollers(gear, pin, allowance)):
        over = "dimension over cylindrical pins"
        lines |= _with_limits(over, lambda deviation: over_rollers(gear, pin, deviation), allowance, gauge)
    return lines


def _with_limits(
    name: str, of: Callable[[float], float], allowance: float, gauge: Gauge
) -> dict[str, Quantity]:
    """A dimension at the mean tooth thickness and, where that has a tolerance, its limits."""
    lines: dict[str, Quantity] = {name: (1e3 * of(allowance), "mm")}
    if gauge.tolerance:
        ends = sorted(of(allowance + side * gauge.tolerance / 2) for side in (-1.0, 1.0))
        for end, each in zip(("least", "most"), ends, strict=True):
            lines[f"{name}, {end}"] = 1e3 * each, "mm"
    return lines


def usual_pin(assembly: Assembly, side: Side) -> float | None:
    """Diameter of a pin or ball that measures the teeth, m: the usual one, or next to it; None: none does."""
    gear, _ = involute_of(assembly.drive, side)
    nominal = USUAL_INTERNAL_PIN if gear.teeth < 0 else USUAL_PIN
    for pin in (nominal, *sorted(_PINS, key=lambda each: abs(each - nominal))):
        if not pin_fails(assembly, side, pin * gear.module, _OUT * gear.module):
            return pin * gear.module
    return None


def pin_fails(assembly: Assembly, side: Side, pin_diameter: float, out: float = 0.0) -> str:
    """Why pins or balls do not measure the teeth: they miss the flanks or do not stand out; "": they do.

    `out` is by how much they must stand out of the tip circle, m.
    """
    gear, allowance = involute_of(assembly.drive, side)
    if not _on_flank(assembly, side, pin_contact_diameter(gear, pin_diameter, allowance)):
        return "such pins do not touch the flanks"
    tooth = assembly.tooth(side)
    centre = gear.base_diameter / math.cos(_pin_angle(gear, pin_diameter, allowance)) / 2
    if centre + pin_diameter / 2 <= float(tooth.tip_radius) + out:
        return "such pins do not stand out of the tip circle"
    if centre - pin_diameter / 2 <= float(tooth.root_radius):
        return "such pins touch the root"
    return ""


def _on_flank(assembly: Assembly, side: Side, diameter: Any) -> bool:
    tooth = assembly.tooth(side)
    radius = float(diameter) / 2
    return math.isfinite(radius) and bool(tooth.form_radius <= radius <= tooth.tip_radius)
