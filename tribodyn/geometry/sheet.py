"""The geometry of a drive in the engineer's quantities and units, measured tooth thickness included."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.geometry.assembly import (
    Assembly,
    circumferential_backlash,
    lowest_contact_radius,
    normal_backlash,
    tip_clearance,
)
from tribodyn.geometry.drive import SIDES, Side, body_of, reference_radius, tip_circle_radius
from tribodyn.geometry.families.involute import inverse_involute, involute_function, tight_centre_distance
from tribodyn.geometry.path import kinematics
from tribodyn.geometry.tooth import flank_point, thickness_half_angle


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
    """What a tooth thickness is measured with; None: usual."""

    span_teeth: int | None = None
    pin_diameter: float | None = None  # m


def backlash_lines(assembly: Assembly) -> dict[str, Quantity]:
    """Backlash of the pair and, of involutes, the centre distance at which it has none."""
    lines: dict[str, Quantity] = {}
    if assembly.family.involute:
        lines["centre distance without backlash"] = 1e3 * float(tight_centre_distance(assembly.drive)), "mm"
    rounding = 1e-9 * float(assembly.drive.module)
    for name, backlash in (
        ("normal backlash", normal_backlash(assembly)),
        ("circumferential backlash", circumferential_backlash(assembly)),
    ):
        lines[name] = 1e3 * (float(backlash) if abs(backlash) > rounding else 0.0), "mm"
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


_SAMPLES = 400


def geometry_sheet(
    assembly: Assembly,
    masses: Sequence[tuple[float, float]] | None = None,
    gauges: tuple[Gauge, Gauge] = (Gauge(), Gauge()),
) -> dict[str, Any]:
    """Summarise a drive that has passed `checks.check`; lengths in mm, angles in degrees.

    Name -> (value, unit) for the pair, in reading order, and under "pinion" and "gear" the same for each
    body. Masses (kg) and inertias (kg m²) of pinion and gear stand there where they are given.
    """
    path, drive = assembly.path, assembly.drive
    ends = {"start of contact": assembly.r_start, "pitch point": 0.0, "end of contact": assembly.r_end}
    places = {name: kinematics(path, r) for name, r in ends.items()}
    operating = {"operating pressure angle": _degrees(places["pitch point"].pressure_angle)}
    operating = operating if assembly.family.involute else {}
    pitch_angle = 2 * math.pi / drive.pinion.teeth
    pair: dict[str, Any] = {
        "module": _millimetres(drive.module),
        "gear ratio": (float(drive.gear.teeth / drive.pinion.teeth), ""),
        "centre distance": _millimetres(path.pinion_pitch_radius + path.gear_pitch_radius),
        **operating,
        **backlash_lines(assembly),
        "pressure angle of the rack on its rolling line": _degrees(assembly.pinion.path.pressure_angle(0.0)),
        "contact ratio": (assembly.contact_ratio, ""),
        "approach contact ratio": (-assembly.roll_limits[0] / pitch_angle, ""),
        "recess contact ratio": (assembly.roll_limits[1] / pitch_angle, ""),
        "start of contact from pitch point": _millimetres(assembly.r_start),
        "end of contact from pitch point": _millimetres(assembly.r_end),
        **{f"pressure angle at {name}": _degrees(at.pressure_angle) for name, at in places.items()},
        **{
            f"equivalent radius at {name}": _millimetres(1 / at.relative_curvature)
            for name, at in places.items()
        },
    }
    sliding = _sliding(assembly)
    pair |= sliding.pop("pair")
    for number, side in enumerate(SIDES):
        tooth, body = assembly.tooth(side), body_of(drive, side)
        working = assembly.path_of(side).pinion_pitch_radius
        rounded = {"tip form diameter": _millimetres(2 * tooth.tip_radius)}
        pair[side] = {
            "teeth": (float(body.teeth), ""),
            "profile shift": (float(body.profile_shift), ""),
            "reference diameter": _millimetres(2 * reference_radius(drive, side)),
            "working pitch diameter": _millimetres(2 * working),
            **_base_diameter(assembly, side),
            "tip diameter": _millimetres(2 * tip_circle_radius(drive, side)),
            **(rounded if body.tip_break > 0 else {}),
            "lowest contact diameter": _millimetres(2 * lowest_contact_radius(assembly, side)),
            "form diameter": _millimetres(2 * tooth.form_radius),
            "active flank above form circle": _millimetres(
                lowest_contact_radius(assembly, side) - tooth.form_radius
            ),
            "undercut margin": _millimetres(-tooth.overrun),
            "undercut by the rack": (float(tooth.overrun > 0), ""),
            "root diameter": _millimetres(2 * tooth.root_radius),
            "bore diameter": _millimetres(2 * body.bore_radius),
            "face width": _millimetres(body.face_width),
            "tooth thickness on working pitch circle": _millimetres(
                2 * working * thickness_half_angle(tooth, working)
            ),
            "tip thickness": _millimetres(2 * flank_point(tooth, tooth.tip_distance)[1]),
            "tip clearance": _millimetres(tip_clearance(assembly, side)),
            **thickness_lines(assembly, side, gauges[number]),
            **sliding[side],
        }
        if masses is not None:
            mass, inertia = masses[number]
            pair[side] |= {"mass": (float(mass), "kg"), "moment of inertia": (1e6 * float(inertia), "kg mm²")}
    return pair


def specific_sliding_max(assembly: Assembly) -> float:
    """Largest magnitude of both flanks' specific sliding along the path of contact."""
    found = _sliding(assembly)
    ends = (f"{end} specific sliding" for end in ("minimum", "maximum"))
    return max(abs(found[side][end][0]) for end in ends for side in SIDES)


def _sliding(assembly: Assembly) -> dict[str, dict[str, Quantity]]:
    """Maximum sliding in approach and recess, and each flank's extremes of specific sliding.

    Sliding per rad of the pinion, so mm/rad times rad/s is mm/s. Specific sliding is the flank's speed less
    its mate's, over the flank's own: −∞ where a flank is touched at its point of zero velocity.
    """
    path = assembly.path
    # Without P, where both speeds of a cycloid vanish.
    approach = kinematics(path, assembly.r_start * np.linspace(1.0, 0.0, _SAMPLES, endpoint=False))
    recess = kinematics(path, assembly.r_end * np.linspace(1.0, 0.0, _SAMPLES, endpoint=False))
    result: dict[str, dict[str, Quantity]] = {
        "pair": {
            f"maximum sliding in {name}": (1e3 * float(np.abs(part.sliding).max()), "mm/rad")
            for name, part in (("approach", approach), ("recess", recess))
        }
    }
    for side, sign in zip(SIDES, (1.0, -1.0), strict=True):
        specific = np.concatenate(
            [sign * part.sliding / getattr(part, f"{side}_speed") for part in (approach, recess)]
        )
        result[side] = {
            "minimum specific sliding": (float(specific.min()), ""),
            "maximum specific sliding": (float(specific.max()), ""),
        }
    return result


def _base_diameter(assembly: Assembly, side: Side) -> dict[str, Quantity]:
    """Return the diameter of the base circle where there is one: where the normal load's arm is constant."""
    along = kinematics(assembly.path, np.linspace(assembly.r_start, assembly.r_end, 5))
    arm = getattr(along, f"{side}_normal_arm")
    return {"base diameter": _millimetres(2 * arm[0])} if np.ptp(arm) <= 1e-12 * arm[0] else {}


def _millimetres(length: Any) -> Quantity:
    return 1e3 * float(length), "mm"


def _degrees(angle: Any) -> Quantity:
    return math.degrees(float(angle)), "°"
