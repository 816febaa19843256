"""Whether a drive can be made and can run: one clear message for the first rule that it breaks."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from tribodyn.errors import InputError
from tribodyn.geometry.assembly import (
    Assembly,
    flank_angle_at_tip,
    lowest_contact_radius,
    lowest_contact_speed,
    mate_of,
    tip_clearance,
    tip_corner_gap,
)
from tribodyn.geometry.backlash import normal_backlash
from tribodyn.geometry.drive import SIDES, Drive, GearBody, Side, body_of, internal_side, tip_circle_radius
from tribodyn.geometry.families import Family
from tribodyn.geometry.helix import as_written, from_written, overlap_ratio
from tribodyn.geometry.limits.limits import (
    check_cutter,
    check_outside,
    rack_without_flank,
    tip_in_base_circle,
    tips_collide,
)
from tribodyn.geometry.limits.sizes import advice, boundary, check_sizes, millimetres, replaced, require
from tribodyn.geometry.tooth import flank_point, thickness_half_angle

# An overlap below this share of the module is the chord error of the fillet's points.
_OVERLAP_TOLERANCE = 1e-5
# Overlap of back flanks, in modules, that is rounding.
_ROUNDING = 1e-9


def check(family: Family, drive: Drive) -> Assembly:
    """Put a drive together, or refuse one that cannot be made or cannot run.

    Sizes; the family's own rules; for each body root and bore, corners of the rack, undercut, pointed tip;
    for the pair tip clearance, contact ratio, interference. Plain numbers only; messages give lengths in mm.

    Raises InputError, which names the key, the rule and, where known, a value that obeys it.
    """
    check_path(family, drive)
    with np.errstate(all="ignore"):
        assembly = Assembly(family, drive)
        for side in SIDES:
            _check_root(assembly, side)
            _check_rack_corners(assembly, side)
            _check_tip(assembly, side)
        _check_backlash(assembly)
        for side in SIDES:
            _check_clearance(assembly, side)
        _check_contact_ratio(assembly)
        for side in SIDES:
            _keep_tip(assembly, side, _interference, mate_of(side))
        if (ring := internal_side(drive)) is not None:
            _keep_tip(assembly, ring, tips_collide)
            _keep_tip(assembly, ring, rack_without_flank, mate_of(ring))
    return assembly


def check_path(family: Family, drive: Drive) -> None:
    """Refuse sizes that cannot be, and what makes no path of contact of the family; the first of `check`."""
    with np.errstate(all="ignore"):
        check_sizes(as_written(family, drive), family.pressure_angle)
        _check_centre_distance(family, drive)
        family.check(drive)


def _check_centre_distance(family: Family, drive: Drive) -> None:
    if drive.centre_distance is None:
        return
    length = drive.centre_distance
    outwards = drive.pinion.teeth + drive.gear.teeth > 0  # that of an internal pair is negative
    require("centre_distance", length, length > 0 if outwards else length < 0, "must be greater than zero")
    if not family.involute:
        rule = f"teeth of the family {family.name} are conjugate at one centre distance only"
        remedy = "leave centre_distance out, or use involutes, which mesh at any"
        raise InputError("drive.centre_distance", millimetres(length), rule, remedy)


def _check_backlash(assembly: Assembly) -> None:
    overlap = -normal_backlash(assembly)
    if not overlap <= _ROUNDING * assembly.drive.module:
        thicker = max(SIDES, key=lambda side: body_of(assembly.drive, side).thickness_allowance)
        allowance = _written(assembly, thicker).thickness_allowance
        raise InputError(
            f"drive.{thicker}.thickness_allowance",
            f"{1e6 * allowance:.4g} um",
            f"the teeth overlap by {1e6 * overlap:.4g} um along the normal",
            "use a negative allowance" + (" or a larger centre distance" if assembly.family.involute else ""),
        )


def _check_root(assembly: Assembly, side: Side) -> None:
    body, root = _written(assembly, side), assembly.tooth(side).root_radius
    if not root * body.teeth > 0:
        rule = "the teeth would be cut past the axis"
        raise InputError(f"drive.{side}.dedendum", body.dedendum, rule, "use a smaller one or more teeth")
    if body.teeth < 0:
        check_outside(assembly, side)
    if not body.bore_radius < root:
        rule = f"the bore reaches the root circle, whose radius is {millimetres(root)}"
        raise InputError(f"drive.{side}.bore_radius", millimetres(body.bore_radius), rule, "use less")


def _written(assembly: Assembly, side: Side) -> GearBody:
    """One body with the numbers of its keys, without the last digits' rounding of a helical one."""
    body = body_of(as_written(assembly.family, assembly.drive), side)
    if body is body_of(assembly.drive, side):
        return body
    return GearBody(*(None if value is None else float(f"{value:.12g}") for value in body))


def _changed(assembly: Assembly, side: Side, **changes: float) -> Assembly:
    """Put the drive together with some numbers of one body changed, as its keys have them."""
    family = assembly.family
    changed = replaced(as_written(family, assembly.drive), side, **changes)
    return Assembly(family, from_written(family, changed))


def _check_rack_corners(assembly: Assembly, side: Side) -> None:
    def fits(**changes: float) -> bool:
        tooth = _changed(assembly, side, **changes).tooth(side)
        return bool(tooth.corner_x <= tooth.corner_limit)

    if fits():
        return
    body = _written(assembly, side)
    maximum = boundary(lambda value: fits(fillet_radius=value), body.fillet_radius, 0.0)
    if maximum is not None:
        rule = "the rounded corners of the rack's tip overlap"
        raise InputError(
            f"drive.{side}.fillet_radius", body.fillet_radius, rule, f"use at most {maximum:.7g}"
        )
    rule = "the rack's flanks meet before they reach its tip"
    maximum = boundary(lambda value: fits(dedendum=value), body.dedendum, body.fillet_radius)
    remedy = advice(maximum, "at most", "use a smaller pressure angle")
    raise InputError(f"drive.{side}.dedendum", body.dedendum, rule, remedy)


def _without_undercut(assembly: Assembly, side: Side) -> InputError | None:
    """Error of an undercut flank that leaves too little of the path, with what would do; None: it is not."""
    if not assembly.shortened(side):
        return None
    body, tooth = _written(assembly, side), assembly.tooth(side)

    def sound(shift: float) -> bool:
        return bool(_changed(assembly, side, profile_shift=shift).tooth(side).overrun <= 0)

    def enough(shift: float) -> bool:
        pair = _changed(assembly, side, profile_shift=shift)
        return bool(pair.contact_ratio + overlap_ratio(pair) >= 1)

    whole = assembly.contact_ratio_between(*assembly.tip_limits)
    rule = (
        f"the rack undercuts the flank up to the radius {millimetres(tooth.form_radius)}, which leaves a "
        f"contact ratio of {assembly.contact_ratio:.3f} of {whole:.3f}"
    )
    otherwise = "use more teeth, a larger pressure angle or a smaller dedendum"
    if assembly.family.parameters:
        otherwise = "use more teeth, another shape of the path or a smaller dedendum"
    if assembly.family.shiftable:
        shift = body.profile_shift
        minimum = boundary(sound, shift, shift + 2)
        if minimum is not None:  # less will do where enough of the path is left
            minimum = boundary(enough, shift, minimum) if enough(minimum) else None
        return InputError(f"drive.{side}.profile_shift", shift, rule, advice(minimum, "at least", otherwise))
    return InputError(f"drive.{side}.dedendum", body.dedendum, rule, otherwise)


def _check_tip(assembly: Assembly, side: Side) -> None:
    tooth, body = assembly.tooth(side), _written(assembly, side)

    def thickness(pair: Assembly) -> float:
        cut = pair.tooth(side)
        return 2 * float(flank_point(cut, cut.tip_distance)[1])

    if not tooth.tip_radius > tooth.form_radius:
        rule = (
            f"nothing is left of the flank, which begins at the radius {millimetres(abs(tooth.form_radius))}"
        )
        raise InputError(*_tip_key(assembly, side), rule, "use a higher tooth")
    if body.teeth < 0:
        _keep_tip(assembly, side, tip_in_base_circle)
        check_cutter(assembly, side)
    if thickness(assembly) > 0:
        _check_rounding(assembly, side)
        return
    rule = f"the tip is pointed (thickness {millimetres(thickness(assembly))})"
    if body.tip_radius is None and assembly.family.shiftable and body.profile_shift > 0:

        def blunt(shift: float) -> bool:
            return thickness(_changed(assembly, side, profile_shift=shift)) > 0

        maximum = boundary(blunt, body.profile_shift, 0.0)
        if maximum is not None:
            key = f"drive.{side}.profile_shift"
            raise InputError(key, body.profile_shift, rule, f"use at most {maximum:.7g}")
    _refuse_tip(assembly, side, rule, lambda pair: thickness(pair) > 0)


def _check_rounding(assembly: Assembly, side: Side) -> None:
    """Refuse roundings of both edges of a tip that meet: along it each takes its height over the cosine."""
    drive, body = assembly.drive, body_of(assembly.drive, side)
    sine, cosine = flank_angle_at_tip(assembly.family, drive, side)
    outer = tip_circle_radius(drive, side)
    half = outer * thickness_half_angle(assembly.tooth(side), outer)
    if body.tip_break / cosine > half:
        rule, height = "the rounded edges of the tip meet", body.tip_break / (1.0 - sine)
        remedy = f"use at most {millimetres(half * cosine / (1.0 - sine))}"
        raise InputError(f"drive.{side}.tip_rounding", millimetres(height), rule, remedy)


def _tip_key(assembly: Assembly, side: Side) -> tuple[str, Any]:
    """Key and value of what sets the tip circle."""
    body = _written(assembly, side)
    if body.tip_radius is None:
        return f"drive.{side}.addendum", body.addendum
    return f"drive.{side}.tip_radius", millimetres(abs(body.tip_radius))


def _refuse_tip(
    assembly: Assembly, side: Side, rule: str, is_valid: Callable[[Assembly], bool], otherwise: str = ""
) -> None:
    """Refuse a tip circle that is too large, naming the largest usable one above the form circle."""
    body = _written(assembly, side)

    def usable_at(size: float) -> bool:
        changes = {"addendum": size} if body.tip_radius is None else {"tip_radius": size / 1e3}
        return is_valid(_changed(assembly, side, **changes))

    if body.tip_radius is None:
        usable, unit = boundary(usable_at, body.addendum, 0.0), ""
    else:
        smallest = 1e3 * assembly.tooth(side).form_radius
        usable, unit = boundary(usable_at, 1e3 * body.tip_radius, smallest), " mm"
    inwards = body.teeth < 0 and body.tip_radius is not None  # its key is the radius without sign
    smaller, most = ("larger", "least") if inwards else ("smaller", "most")
    remedy = f"use a {smaller} one" if usable is None else f"use at {most} {abs(usable):.7g}{unit}"
    raise InputError(*_tip_key(assembly, side), rule, remedy + otherwise)


def _keep_tip(
    assembly: Assembly, side: Side, broken: Callable[[Assembly, Side], str], tip: Side | None = None
) -> None:
    """Refuse a tip, that of `side` or another, with which a rule of `side` is broken."""
    if rule := broken(assembly, side):
        otherwise = _smaller_fillet(assembly, side, broken) if tip else ""
        _refuse_tip(assembly, tip or side, rule, lambda pair: not broken(pair, side), otherwise)


def _smaller_fillet(assembly: Assembly, side: Side, broken: Callable[[Assembly, Side], str]) -> str:
    """What to write otherwise where the mate's tip meets a fillet: a smaller one leaves more of the flank."""
    body = _written(assembly, side)
    if body.teeth < 0:
        return ""
    changed = partial(_changed, assembly, side)
    usable = boundary(lambda value: not broken(changed(fillet_radius=value), side), body.fillet_radius, 0.0)
    return "" if usable is None else f", or drive.{side}.fillet_radius of at most {usable:.4g}"


def _check_clearance(assembly: Assembly, side: Side) -> None:
    clearance = tip_clearance(assembly, side)
    if not clearance > 0:
        rule = f"the tip reaches {millimetres(-clearance)} below the root circle of the {mate_of(side)}"
        _refuse_tip(assembly, side, rule, lambda pair: tip_clearance(pair, side) > 0)


def _check_contact_ratio(assembly: Assembly) -> None:
    ratio, overlap = assembly.contact_ratio, float(overlap_ratio(assembly))
    if not ratio + overlap >= 1:
        for side in SIDES:
            if error := _without_undercut(assembly, side):
                raise error
        of = f"total contact ratio is {ratio + overlap:.3f}" if overlap else f"contact ratio is {ratio:.3f}"
        rule = f"the {of}, so that a pair parts before the next one touches"
        remedy = "use larger addenda, more teeth or a smaller pressure angle"
        distance = assembly.drive.centre_distance
        if (
            distance is not None
            and distance > 0
            and (usable := _usable_centre_distance(assembly, distance)) is not None
        ):
            remedy = f"use at most {usable:.7g} mm, or larger addenda"
            raise InputError("drive.centre_distance", millimetres(distance), rule, remedy)
        raise InputError(*_tip_key(assembly, "pinion"), rule, remedy)


def _usable_centre_distance(assembly: Assembly, wanted: float) -> float | None:
    """Largest centre distance, mm, at which a pair touches before the last one parts; None: not by that."""
    drive = assembly.drive

    def carries(distance: float) -> bool:
        apart = drive._replace(centre_distance=1e-3 * distance)
        moved = Assembly(assembly.family, apart)
        return bool(moved.contact_ratio + overlap_ratio(moved) >= 1)

    reference = 0.5e3 * float(drive.module * (drive.pinion.teeth + drive.gear.teeth))
    return boundary(carries, 1e3 * wanted, reference)


def _interference(assembly: Assembly, side: Side) -> str:
    """Say how the mate's tip meets this body below its flank, or nothing."""
    tooth = assembly.tooth(side)
    form, contact = tooth.form_radius, lowest_contact_radius(assembly, side)
    undercut = bool(tooth.overrun > 0)  # the rack has made room for tips that reach as deep as its own
    if not undercut and not lowest_contact_speed(assembly, side) > 0:
        return f"the tip reaches past the end of any flank of the {side}"
    if not undercut and not contact >= form:
        return (
            f"the tip touches the {side} at the radius {millimetres(abs(contact))}, in the fillet: "
            f"the flank begins at {millimetres(abs(form))}"
        )
    gap = tip_corner_gap(assembly, side)
    if gap < -_OVERLAP_TOLERANCE * assembly.drive.module:
        return f"the corner of the tip cuts {millimetres(-gap)} into the fillet of the {side}"
    return ""
