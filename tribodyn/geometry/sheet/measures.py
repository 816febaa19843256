"""What a gear pair's sheet says of backlash and of measured tooth thickness, in the engineer's units."""

import math
from typing import Any, NamedTuple

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.backlash import circumferential_backlash, normal_backlash
from tribodyn.geometry.drive import Side, body_of
from tribodyn.geometry.families.involute import tight_centre_distance
from tribodyn.geometry.sheet.thickness import (
    Involute,
    over_pins,
    pin_contact_diameter,
    span,
    span_contact_diameter,
    usual_span_teeth,
)

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
