"""Rules that tie several keys of a drive together: what contradicts, what needs what, which run knows it."""

from collections.abc import Iterator
from math import asin, degrees, pi, sin
from typing import NamedTuple

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.geometry.families import FAMILIES
from tribodyn.geometry.modification import (
    Misalignment,
    Modifications,
    broken_flank_rules,
    shown_count,
    shown_length,
    too_few_slices,
    uneven_teeth,
    vary_along_lead,
)
from tribodyn.input.messages import outside
from tribodyn.input.tables.gears.model_files import (
    DriveTable,
    Gear,
    Hand,
    Material,
    MisalignmentTable,
    flank_of,
)
from tribodyn.input.tables.gears.quality import broken_quality_rules, helix_allowance
from tribodyn.input.tables.gears.tooth_data import (
    broken_tooth_rules,
    hand_of_mate,
    modules_of,
    shape_errors,
)
from tribodyn.standards.metals import VICKERS

#: Slices along the face where nothing is said and anything varies along it.
SLICES = 21


def modifications_of(drive: DriveTable, misalignment: MisalignmentTable) -> Modifications:
    """Return what is taken off the flanks of a drive, and how its axes stand."""
    stand = Misalignment(misalignment.in_plane, misalignment.out_of_plane)
    if misalignment.from_quality:
        opened = misalignment.from_quality * helix_allowance(drive)
        stand = stand._replace(in_plane=stand.in_plane + opened)
    pinion, gear = (flank_of(gear.modification, drive.module) for gear in (drive.pinion, drive.gear))
    return Modifications(pinion, gear, stand)


def slices_of(number: int | None, modifications: Modifications, helical: bool = False) -> int:
    """Return the number of slices along the face."""
    return number or (SLICES if helical or vary_along_lead(modifications) else 1)


class Face(NamedTuple):
    """What a scenario says of the flanks along and across the face."""

    drive: DriveTable
    misalignment: MisalignmentTable
    slices: int | None
    slice_coupling: bool
    on_shafts: bool = False  # whether drawn shafts or matrices let the gears tilt


def broken_modification_rules(drive: DriveTable) -> Iterator[InputError]:
    """Go through what contradicts in the modifications of both gears."""
    for name in ("pinion", "gear"):
        gear = getattr(drive, name)
        table = gear.modification
        yield from broken_flank_rules(name, flank_of(table, drive.module), gear.teeth, gear.face_width)
        for part in ("lead_relief_start", "lead_relief_end", "lead_unmodified"):
            if table.crowning is not None and (value := getattr(table, part)):
                key = f"drive.{name}.modification.{part}"
                rule = "contradicts crowning, which gives the whole shape of the lead"
                yield InputError(key, shown_length(value), rule, "give the one or the other")


def broken_slice_rules(face: Face) -> Iterator[InputError]:
    """Go through the rules of a run that knows modifications: slices enough for what varies."""
    varies = bool(face.drive.helix_angle) or face.on_shafts
    varies = varies or vary_along_lead(modifications_of(face.drive, face.misalignment))
    if face.slices is not None and (broken := too_few_slices(face.slices, varies)):
        yield broken


def broken_face_rules(face: Face, compliance: str, *, every_tooth: bool = False) -> Iterator[InputError]:
    """Go through the rules of a run in slices or with a face that is even; `every_tooth`: they may differ."""
    if compliance == "fem" or face.drive.helix_angle:
        yield from broken_slice_rules(face)
        if not every_tooth:
            yield from uneven_teeth(modifications_of(face.drive, face.misalignment))
    else:
        remedy = 'leave it out, or write compliance = "fem"'
        for key, value in (*_modified(face.drive), *_deviations(face)):
            if not (every_tooth and key.endswith(".pitch_errors")):
                yield InputError(key, value, f'contradicts compliance = "{compliance}"', remedy)


def _modified(drive: DriveTable) -> Iterator[tuple[str, str | None]]:
    """Keys of everything that modifies the flanks, pitch errors last, and the values as they are shown."""
    tables = {
        f"drive.{name}.modification": gear.modification
        for name, gear in (("pinion", drive.pinion), ("gear", drive.gear))
    }
    for key, table in tables.items():
        for relief in (
            "tip_relief",
            "root_relief",
            "lead_relief_start",
            "lead_relief_end",
            "crowning",
            "helix_slope",
            "bias",
        ):
            if amount := getattr(table, relief):
                yield f"{key}.{relief}", shown_length(amount)
        if table.profile_error is not None:
            yield f"{key}.profile_error", None
    for key, table in tables.items():
        if table.pitch_errors:
            yield f"{key}.pitch_errors", shown_count(len(table.pitch_errors))


def _deviations(face: Face) -> Iterator[tuple[str, str | None]]:
    """Keys of what stands askew or in slices, and the values as they are shown."""
    if share := face.misalignment.from_quality:
        yield "mesh.misalignment.from_quality", f"{share:g}"
    for name, angle in face.misalignment.model_dump(exclude={"from_quality"}).items():
        if angle:
            yield f"mesh.misalignment.{name}", f"{degrees(angle) * 60:g} arcmin"
    if face.slices is not None:
        yield "mesh.slices", str(face.slices)
    if not face.slice_coupling:
        yield "mesh.slice_coupling", "false"


#: Helix angle up to which gears are cylindrical gears of parallel axes in practice, and the overlap ratio.
STEEPEST, MOST_OVERLAP = 60.0, 10.0


def broken_helix_rules(drive: DriveTable) -> Iterator[InputError]:
    """Go through what is wrong with the helix: its angle, its hands, and teeth that it lays over the face."""
    yield from _broken_hands(drive)
    if not drive.helix_angle:
        return
    key, beta = "drive.helix_angle", degrees(drive.helix_angle)
    shown = f"{beta:.6g} deg"
    if beta < 0.0:
        remedy = f'write helix_angle = "{-beta:.6g} deg" and hand = "left", the hand of the pinion'
        yield InputError(key, shown, "must not be negative: the hand gives the direction", remedy)
    elif beta > STEEPEST:
        rule = "must be 60 deg at most: beyond, a transverse section says little of the teeth"
        yield InputError(key, shown, rule, 'use 8 to 35 deg, as in helix_angle = "20 deg"')
    else:
        width = min(drive.pinion.face_width, drive.gear.face_width)
        module, _ = modules_of(drive)
        most = MOST_OVERLAP * pi * module / width
        if (ratio := sin(drive.helix_angle) * width / (pi * module)) > MOST_OVERLAP:
            rule = f"gives an overlap ratio of {ratio:.4g} over the common face of {shown_length(width)}"
            remedy = f"keep it to {MOST_OVERLAP:g}: at most {degrees(asin(most)):.4g} deg, or a smaller face"
            yield InputError(key, shown, rule, remedy)


def _broken_hands(drive: DriveTable) -> Iterator[InputError]:
    """Hands without a helix, and hands that contradict each other."""
    of_parts: dict[str, Hand | None] = {
        "hand": drive.hand,
        "pinion.hand": drive.pinion.hand,
        "gear.hand": drive.gear.hand,
    }
    hands = [
        (f"drive.{part}", hand, hand if part != "gear.hand" else hand_of_mate(drive, hand))
        for part, hand in of_parts.items()
        if hand is not None
    ]
    if hands and not drive.helix_angle:
        key, hand, _ = hands[0]
        remedy = 'add helix_angle = "20 deg" to [drive], or leave it out'
        yield InputError(key, quoted(hand), "is the hand of a helix, and the gears are spur gears", remedy)
        return
    for key, hand, of_pinion in hands[1:]:
        if of_pinion != hands[0][2]:
            have = "an internal gear has the hand of its mate"
            have = have if drive.has_ring else "external gears have opposite hands"
            rule = f"contradicts {hands[0][0]} = {quoted(hands[0][1])}: {have}"
            right = "left" if hand == "right" else "right"
            yield InputError(key, quoted(hand), rule, f"write {quoted(right)}, or leave it out")


def _broken_blank(key: str, gear: Gear) -> Iterator[InputError]:
    """A web without a rim to carry, or wider than the teeth."""
    if gear.web_thickness is None:
        return
    if gear.rim_thickness is None:
        remedy = 'add rim_thickness = "12 mm", under the teeth'
        yield InputError(f"{key}.rim_thickness", rule="missing: web_thickness needs it", remedy=remedy)
    if gear.web_thickness > gear.face_width:
        shown, rule = (
            f"{1e3 * gear.web_thickness:g} mm",
            "is wider than the teeth: such a body is a solid disc",
        )
        yield InputError(f"{key}.web_thickness", shown, rule, "leave it out, or write a smaller one")


def broken_drive_rules(drive: DriveTable) -> Iterator[InputError]:
    """Go through the rules that a drive breaks by itself."""
    for name in ("pinion", "gear"):
        gear = getattr(drive, name)
        if drive.material is None and gear.material is None:
            remedy = "give the name of a file in models/materials here, or drive.material for both gears"
            yield InputError(f"drive.{name}.material", rule="missing", remedy=remedy)
        yield from _broken_blank(f"drive.{name}", gear)
        if gear.material is not None:
            yield from _broken_case(drive, gear.material, f"drive.{name}.material")
    if drive.material is not None:
        yield from _broken_case(drive, drive.material, "drive.material")
    yield from broken_helix_rules(drive)
    yield from broken_tooth_rules(drive)
    yield from broken_modification_rules(drive)
    yield from broken_quality_rules(drive)
    if drive.family in FAMILIES:
        yield from shape_errors(drive, FAMILIES[drive.family])
    else:
        unknown = unknown_name(FAMILIES.key, drive.family, FAMILIES, FAMILIES.what)
        yield outside(unknown, drive.family, remedy=unknown.remedy) or unknown


def _broken_case(drive: DriveTable, material: Material, key: str) -> Iterator[InputError]:
    """Refuse a hardened case that a gear cannot have."""
    for each in ("case_depth", "core_hardness"):
        if getattr(material, each) is not None and material.treatment != "case-hardened":
            rule = "is of case-hardened teeth"
            remedy = 'write treatment = "case-hardened", or leave it out'
            yield InputError(f"{key}.{each}", rule=rule, remedy=remedy)
    if material.core_hardness is not None and material.core_hardness >= material.hardness:
        core, surface = (f"{one / VICKERS:.0f} HV" for one in (material.core_hardness, material.hardness))
        rule = f"is not below the surface's hardness, {surface}"
        yield InputError(f"{key}.core_hardness", core, rule, "usual are 320 to 400 HV")
    if material.case_depth is not None and material.case_depth >= (half := pi * drive.module / 4.0):
        rule = f"is deeper than half of a tooth, about {1e3 * half:.3g} mm"
        remedy = f"usual is 0.15 times the module, {150.0 * drive.module:.3g} mm"
        yield InputError(f"{key}.case_depth", shown_length(material.case_depth), rule, remedy)


def broken_part_rules(hertz: str, foundation: str, compliance: str) -> Iterator[InputError]:
    """Go through what contradicts between the parts of a compliance, contact and body, and the compliance."""
    for name, value, refused, part in (
        ("hertz", hertz, "load-dependent", "the Hertz contact"),
        ("foundation", foundation, "ring", "the gear bodies"),
    ):
        if value == refused and compliance != "energy":
            rule = f'contradicts compliance = "{compliance}", which contains {part}'
            remedy = f'leave {name} out, or write compliance = "energy"'
            yield InputError(f"mesh.{name}", f'"{value}"', rule, remedy)
