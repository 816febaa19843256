"""The keys of an internal gear: written without signs, its body with those of ISO 21771."""

from collections.abc import Iterator
from typing import Any

from tribodyn.errors import InputError
from tribodyn.geometry.drive import GearBody, Side
from tribodyn.geometry.limits.sizes import broken_internal_sizes
from tribodyn.input.tables.gears.model_files import DriveTable, Gear

#: Teeth of the cutter where none are given, at most half the gear's, and rim outside the root circle,
#: modules: choices; the first a common size, the second near a rim that bends little.
USUAL_CUTTER, USUAL_RIM = 20, 3.0
_OWN = (
    "outer_diameter",
    "pins",
    "cutter_teeth",
    "cutter_profile_shift",
    "cutter_addendum",
    "cutter_rounding",
)


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
        pins=_pins(gear),
    )


def _pins(gear: Gear) -> float | None:
    if gear.rim == "fixed":
        return None
    return float(gear.pins or 0)


def _cutter_teeth(gear: Gear) -> float:
    return float(gear.cutter_teeth or min(USUAL_CUTTER, gear.teeth // 2))


def broken_internal_rules(drive: DriveTable) -> Iterator[InputError]:
    """Go through what contradicts an internal gear, and keys of one that is none."""
    for name, gear in (("pinion", drive.pinion), ("gear", drive.gear)):
        internal_keys = [key for key in _OWN if getattr(gear, key) is not None]
        internal_keys += ["profile_shift_of"] if gear.profile_shift_of == "gap" else []
        internal_keys += ["rim"] if gear.rim != "fixed" else []
        if internal_keys and not gear.internal:
            rule, remedy = "is of an internal gear", "add internal = true, or leave it out"
            yield InputError(f"drive.{name}.{internal_keys[0]}", rule=rule, remedy=remedy)
        if gear.internal and (gear.pins is None) == (gear.rim == "pins"):
            rule, remedy = (
                ('rim = "pins" needs their number', "give pins")
                if gear.pins is None
                else ("is of a rim on pins", 'write rim = "pins", or leave it out')
            )
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
    if drive.helix_angle:
        rule, remedy = "helical internal gears are not modelled", "leave helix_angle out"
        yield InputError("drive.helix_angle", f"{drive.helix_angle:g} rad", rule, remedy)


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
