"""The teeth of a gear as a drawing gives them: rack, radii, thickness by any measure, the family's shape.

Internal gears are written without signs; their bodies have those of ISO 21771.
"""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.geometry.drive import PROFILES, GearBody, Side
from tribodyn.geometry.families import FAMILIES, Family
from tribodyn.geometry.gauges import Gauge, Involute, allowance_of_pins, allowance_of_span, over_pins, span
from tribodyn.geometry.limits.sizes import broken_internal_sizes
from tribodyn.input.specific_keys import Owner, own_key_errors, own_values
from tribodyn.input.tables.gears.model_files import DriveTable, Gear, Hand
from tribodyn.standards.allowances import CODES, broken_code, thickness_allowances

#: Teeth of the cutter where none are given, at most half the gear's, and rim outside the root circle,
#: modules: choices; the first a common size, the second near a rim that bends little.
USUAL_CUTTER, USUAL_RIM = 20, 3.0
_CUTTER = ("cutter_teeth", "cutter_profile_shift", "cutter_addendum", "cutter_rounding")
_OF_INTERNAL = ("outer_diameter", "pins", *_CUTTER)


def shift_of(gear: Gear) -> float:
    """Profile shift, in modules, positive where it makes the tooth thicker (ISO 21771)."""
    return gear.profile_shift if gear.profile_shift_of == "tooth" else -gear.profile_shift


def rim_radius(body: GearBody, module: Any) -> Any:
    """Minus the outer radius (m) of an internal gear that gives none; `module` in m."""
    return module * (body.teeth / 2 + body.profile_shift - body.dedendum - USUAL_RIM)


def internal_body(gear: Gear, external: GearBody, module: float) -> GearBody:
    """The body of an internal gear, from one of the same numbers without signs; `module` in m."""
    rounding = external.fillet_radius if gear.cutter_rounding is None else gear.cutter_rounding
    body = external._replace(teeth=-external.teeth, profile_shift=shift_of(gear))
    return body._replace(
        fillet_radius=rounding,
        bore_radius=rim_radius(body, module) if gear.outer_diameter is None else -gear.outer_diameter / 2,
        tip_radius=None if external.tip_radius is None else -external.tip_radius,
        cutter_teeth=_cutter_teeth(gear),
        cutter_shift=gear.cutter_profile_shift or 0.0,
        cutter_addendum=gear.cutter_addendum,
        pins=None if gear.rim == "fixed" else float(gear.pins or 0),
    )


def _cutter_teeth(gear: Gear) -> float:
    return float(gear.cutter_teeth or min(USUAL_CUTTER, gear.teeth // 2))


def broken_internal_rules(drive: DriveTable) -> Iterator[InputError]:
    """Go through what contradicts an internal gear, and keys of one that is none."""
    for name, gear in (("pinion", drive.pinion), ("gear", drive.gear)):
        internal_keys = [key for key in _OF_INTERNAL if getattr(gear, key) is not None]
        internal_keys += ["profile_shift_of"] if gear.profile_shift_of == "gap" else []
        internal_keys += ["rim"] if gear.rim != "fixed" else []
        if internal_keys and not gear.internal:
            rule, remedy = "is of an internal gear", "add internal = true, or leave it out"
            yield InputError(f"drive.{name}.{internal_keys[0]}", rule=rule, remedy=remedy)
        if gear.internal and (gear.pins is None) == (gear.rim == "pins"):
            rule, remedy = "is of a rim on pins", 'write rim = "pins", or leave it out'
            if gear.pins is None:
                rule, remedy = 'rim = "pins" needs their number', "give pins"
            yield InputError(f"drive.{name}.pins", gear.pins, rule, remedy)
        for bore in ("bore_radius", "bore_diameter"):
            if gear.internal and getattr(gear, bore) is not None:
                remedy = "give outer_diameter in its place"
                yield InputError(f"drive.{name}.{bore}", rule="an internal gear has no bore", remedy=remedy)
    if drive.pinion.internal and drive.gear.internal:
        rule, remedy = "two internal gears cannot mesh", "make one of them external"
        yield InputError("drive.pinion.internal", "true", rule, remedy)
    side: Side = "pinion" if drive.pinion.internal else "gear"
    ring, mate = (drive.pinion, drive.gear) if side == "pinion" else (drive.gear, drive.pinion)
    if not ring.internal:
        return
    yield from broken_internal_sizes(side, ring.teeth, mate.teeth, _cutter_teeth(ring))


def internal_refused(drive: DriveTable) -> InputError:
    """Refuse an internal gear where a study has only external ones."""
    side = "gear" if drive.gear.internal else "pinion"
    rule = "this kind of study has external gears alone"
    remedy = "run the pair over time, study its efficiency, or describe an external gear"
    return InputError(f"drive.{side}.internal", "true", rule, remedy)


def driving_internal(drive: DriveTable) -> Iterator[InputError]:
    """Refuse an internal gear that drives, where a study takes the pinion to turn in it."""
    if drive.pinion.internal:
        rule, remedy = "of a pair the gear is internal, and the pinion turns in it", "make it [drive.gear]"
        yield InputError("drive.pinion.internal", "true", rule, f"{remedy}; a negative torque lets it drive")


def broken_internal_runs(scenario: Any) -> Iterator[InputError]:
    """Go through what a study that knows internal gears has no formula for; tables may be absent."""
    losses, temperature = getattr(scenario, "losses", None), getattr(scenario, "temperature", None)
    for name in ("churning", "windage"):
        if losses is not None and (law := getattr(losses, name)) is not None:
            rule = "is the loss of external gears that turn in free oil or air, and the gear is internal"
            yield InputError(f"losses.{name}", f'"{law}"', rule, "leave it out")
    if temperature is not None and temperature.model == "iso":
        rule = "is of external gears (ISO/TR 15144-1), and the gear is internal"
        yield InputError("temperature.model", '"iso"', rule, 'use "network", or leave the table out')


#: Heights and rounding where neither the gear nor a rack says them.
USUAL = PROFILES["ISO 53 C"]
#: Bore over reference diameter where none is given, a choice: a shaft of the gear's proportions.
USUAL_BORE = 0.4

THICKNESS_KEYS = (
    "thickness_allowance",
    "thickness_tolerance",
    "thickness_code",
    "span",
    "span_teeth",
    "over_pins",
    "pin_diameter",
)
_MEASURES = ("thickness_allowance", "thickness_code", "span", "over_pins")
_OTHER_HAND: dict[Hand, Hand] = {"right": "left", "left": "right"}
#: What each measure needs beside it.
_WITH = {"span": "span_teeth", "over_pins": "pin_diameter"}
_EXAMPLES = {"span_teeth": "4", "pin_diameter": '"5.25 mm"'}


def pressure_angle_of(drive: DriveTable) -> float | None:
    """Return the pressure angle, rad: given, or of the rack of an involute; None where neither says it."""
    rack = PROFILES.get(drive.rack or "")
    if drive.pressure_angle is None and rack is not None and FAMILIES[drive.family].involute:
        return rack.pressure_angle
    return drive.pressure_angle


def helix_of(drive: DriveTable) -> float:
    """Return the helix angle, rad: positive with a right-hand pinion, 0 of spur gears."""
    return (drive.helix_angle or 0.0) * (1.0 if pinion_hand(drive) == "right" else -1.0)


def pinion_hand(drive: DriveTable) -> Hand:
    """Return the hand of the pinion: the first that is said of it or of its mate, else right."""
    of_gear = drive.gear.hand and hand_of_mate(drive, drive.gear.hand)
    return drive.hand or drive.pinion.hand or of_gear or "right"


def hand_of_mate(drive: DriveTable, hand: Hand) -> Hand:
    """Return the hand of a gear whose mate has this one: the other, but with an internal gear the same."""
    return hand if drive.has_ring else _OTHER_HAND[hand]


def modules_of(drive: DriveTable) -> tuple[float, float]:
    """Return the normal and the transverse module, m."""
    stretch = math.cos(drive.helix_angle or 0.0)
    if drive.family in FAMILIES and FAMILIES[drive.family].involute:
        return drive.module, drive.module / stretch
    return drive.module * stretch, drive.module


def gear_body(drive: DriveTable, gear: Gear) -> GearBody:
    """Return one body of a drive that breaks no rule, as its keys have it; without its tip's rounding."""
    rack = PROFILES.get(drive.rack or "", USUAL)
    bore = _radius(gear, "bore")
    external = GearBody(
        teeth=float(gear.teeth),
        profile_shift=gear.profile_shift,
        addendum=rack.addendum if gear.addendum is None else gear.addendum,
        dedendum=rack.dedendum if gear.dedendum is None else gear.dedendum,
        fillet_radius=rack.fillet_radius if gear.fillet_radius is None else gear.fillet_radius,
        face_width=gear.face_width,
        bore_radius=USUAL_BORE * modules_of(drive)[1] * gear.teeth / 2 if bore is None else bore,
        tip_radius=_radius(gear, "tip"),
        thickness_allowance=_allowance(drive, gear),
    )
    return internal_body(gear, external, modules_of(drive)[1]) if gear.internal else external


def gauge_of(drive: DriveTable, gear: Gear) -> Gauge:
    """Return what a gear's tooth thickness is measured with."""
    upper, lower = _limits(drive, gear)
    return Gauge(gear.span_teeth, gear.pin_diameter, upper - lower)


def gives_thickness(gear: Gear) -> bool:
    """Whether a gear says its tooth thickness."""
    return any(getattr(gear, name) is not None for name in _MEASURES)


def broken_tooth_rules(drive: DriveTable) -> Iterator[InputError]:
    """Go through what contradicts or is missing in rack, radii and tooth thicknesses."""
    if drive.rack is not None and drive.rack not in PROFILES:
        yield unknown_name("drive.rack", drive.rack, PROFILES, "rack profile")
    for name, gear in (("pinion", drive.pinion), ("gear", drive.gear)):
        for what in ("bore", "tip"):
            if getattr(gear, f"{what}_radius") is not None and getattr(gear, f"{what}_diameter") is not None:
                key, diameter = f"drive.{name}.{what}_diameter", _shown(gear, f"{what}_diameter")
                rule, remedy = f"contradicts {what}_radius, which says the same", "leave one of them out"
                yield InputError(key, diameter, rule, remedy)
        if gear.tip_diameter is not None and gear.addendum is not None:
            rule, remedy = "contradicts tip_diameter, which takes its place", "leave one of them out"
            yield InputError(f"drive.{name}.addendum", gear.addendum, rule, remedy)
        yield from _broken_thickness(drive, f"drive.{name}", gear)
    grade, teeth = drive.centre_distance_grade, drive.family
    if grade is not None and teeth in FAMILIES and not FAMILIES[teeth].involute:
        rule = f"teeth of the family {teeth} mesh at one distance only"
        yield InputError("drive.centre_distance_grade", grade, rule, "leave it out, it is for involutes")
    yield from broken_internal_rules(drive)
    yield from _broken_roughness(drive)


def _broken_roughness(drive: DriveTable) -> Iterator[InputError]:
    if drive.mean_roughness is not None:
        return
    lacking = [name for name in ("pinion", "gear") if getattr(drive, name).mean_roughness is None]
    if drive.roughness is not None and len(lacking) == 1:
        rule = "missing: that of one gear has no effect beside drive.roughness, which is of both flanks"
        remedy = "add it, or leave out that of the other gear"
        yield InputError(f"drive.{lacking[0]}.mean_roughness", rule=rule, remedy=remedy)
    elif drive.roughness is None and lacking:
        key = "drive.roughness" if len(lacking) == 2 else f"drive.{lacking[0]}.mean_roughness"
        both = 'or to [drive] roughness = "0.3 um", composite rms of both flanks'
        yield InputError(key, rule="missing", remedy=f'add mean_roughness = "0.8 um", Ra, {both}')


def _broken_thickness(drive: DriveTable, key: str, gear: Gear) -> Iterator[InputError]:
    measures = [name for name in _MEASURES if getattr(gear, name) is not None]
    for name in measures[1:]:
        rule = f"gives the tooth thickness, as {measures[0]} does"
        yield InputError(f"{key}.{name}", _shown(gear, name), rule, "leave one of them out")
    for measure, other in _WITH.items():
        if getattr(gear, measure) is not None and getattr(gear, other) is None:
            remedy = f"add that of the measurement, such as {other} = {_EXAMPLES[other]}"
            yield InputError(f"{key}.{other}", rule=f"missing: {measure} needs it", remedy=remedy)
    if gear.thickness_code is not None and gear.thickness_code not in CODES:
        yield broken_code(f"{key}.thickness_code", quoted(gear.thickness_code))
    if gear.thickness_tolerance is not None and gear.thickness_code is not None:
        rule, shown = "contradicts thickness_code, which has it", _shown(gear, "thickness_tolerance")
        yield InputError(f"{key}.thickness_tolerance", shown, rule, "leave one of them out")
    elif gear.thickness_tolerance is not None and gear.thickness_allowance is None:
        rule, remedy = "missing: thickness_tolerance is below it", 'add thickness_allowance = "-60 um"'
        yield InputError(f"{key}.thickness_allowance", None, rule, remedy)
    measured = measures and measures[0] in _WITH
    if measured and drive.family in FAMILIES and not FAMILIES[drive.family].involute:
        shown = _shown(gear, measures[0])
        rule = f"teeth of the family {drive.family} have no measure over a span or pins in closed form"
        yield InputError(f"{key}.{measures[0]}", shown, rule, "give thickness_allowance in its place")
    elif measured and pressure_angle_of(drive) is not None and getattr(gear, _WITH[measures[0]]) is not None:
        yield from _impossible_measure(drive, key, gear, measures[0])


def _impossible_measure(drive: DriveTable, key: str, gear: Gear, measure: str) -> Iterator[InputError]:
    """Refuse a measured tooth thickness that is far from the nominal one: another k or pin is meant."""
    involute = _involute(drive, gear)
    allowance = _allowance(drive, gear)
    if abs(allowance) <= 0.5 * drive.module:  # not where it is NaN
        return
    if measure == "span":
        count = gear.span_teeth or 1
        count, what = (1 - count, "gaps") if gear.internal else (count, "teeth")
        length, over = abs(span(involute, count)), f"{gear.span_teeth} {what}"
    else:
        length, over = abs(over_pins(involute, gear.pin_diameter or 0.0)), "these pins"
    says = f"one of nominal thickness measures {1e3 * length:.6g} mm over {over}"
    if math.isnan(length):
        says = "these pins drop between teeth of nominal thickness"
    rule = f"leaves no such tooth: {says}"
    remedy = f"check it, {_WITH[measure]} and profile_shift"
    yield InputError(f"{key}.{measure}", _shown(gear, measure), rule, remedy)


def _allowance(drive: DriveTable, gear: Gear) -> float:
    """Mean deviation of the tooth thickness, m."""
    sign = -1.0 if gear.internal else 1.0
    if gear.span is not None and gear.span_teeth is not None:
        count = 1 - gear.span_teeth if gear.internal else gear.span_teeth  # of gaps
        return allowance_of_span(_involute(drive, gear), count, sign * gear.span)
    if gear.over_pins is not None and gear.pin_diameter is not None:
        return allowance_of_pins(_involute(drive, gear), gear.pin_diameter, sign * gear.over_pins)
    return sum(_limits(drive, gear)) / 2.0


def _limits(drive: DriveTable, gear: Gear) -> tuple[float, float]:
    """A_sne and A_sni, m, of a gear that is not measured; an unknown code, which a rule refuses, is none."""
    if gear.thickness_code in CODES:
        return thickness_allowances(gear.thickness_code, modules_of(drive)[1] * gear.teeth)
    upper = gear.thickness_allowance or 0.0
    return upper, upper - (gear.thickness_tolerance or 0.0)


def _involute(drive: DriveTable, gear: Gear) -> Involute:
    angle = pressure_angle_of(drive)
    return Involute(
        drive.module,
        math.nan if angle is None else angle,
        -float(gear.teeth) if gear.internal else float(gear.teeth),
        shift_of(gear),
        drive.helix_angle or 0.0,
    )


def _radius(gear: Gear, what: str) -> float | None:
    diameter = getattr(gear, f"{what}_diameter")
    return getattr(gear, f"{what}_radius") if diameter is None else diameter / 2.0


def _shown(gear: Gear, name: str) -> str:
    value = getattr(gear, name)
    if isinstance(value, str):
        return quoted(value)
    return f"{1e6 * value:.4g} um" if abs(value) < 1e-3 else f"{1e3 * value:.6g} mm"


TABLE = "drive.shape"


def shape_of(drive: DriveTable, family: Family) -> Any:
    """Return the family's shape in SI units; raises the first of `shape_errors`."""
    if family.shape is None:
        return ()
    values = own_values(Owner(TABLE, "family", family.parameters), drive.shape or {})
    return family.shape(**{key.name: values.get(key.name, key.default) for key in family.parameters})


def shape_errors(drive: DriveTable, family: Family) -> list[InputError]:
    """Return what is wrong with the keys that depend on the family: ``pressure_angle`` and ``shape``."""
    errors = []
    if family.pressure_angle and drive.pressure_angle is None and not (family.involute and drive.rack):
        remedy = 'add pressure_angle = "20 deg"' + (', or rack = "ISO 53 A"' if family.involute else "")
        errors.append(InputError("drive.pressure_angle", None, "missing", remedy))
    if not family.pressure_angle and drive.pressure_angle is not None:
        rule = f'contradicts family = "{family.name}", whose shape alone gives the pressure angle'
        shown = f"{np.degrees(drive.pressure_angle):.4g} deg"
        errors.append(InputError("drive.pressure_angle", shown, rule, "leave it out"))
    return errors + own_key_errors(Owner(TABLE, "family", family.parameters), drive.shape or {})
