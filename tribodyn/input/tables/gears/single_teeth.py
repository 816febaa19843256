"""What single teeth have of their own, errors and damage, as keys and tables have it; and studies without."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import inf, pi
from typing import Annotated, Literal, NamedTuple

import numpy as np
from pydantic import Field

from tribodyn.errors import InputError
from tribodyn.geometry.drive import SIDES, Side
from tribodyn.geometry.modification import Limits, shown_count, shown_length
from tribodyn.input import units
from tribodyn.input.quantity import (
    Column,
    Columns,
    Draws,
    InUnit,
    Number,
    Positive,
    Table,
    Text,
    csv_file,
    written,
)
from tribodyn.input.tables.gears.model_files import DriveTable, FlankErrors, Gear
from tribodyn.input.tables.gears.quality import tolerances_of
from tribodyn.mesh.table import MeshData
from tribodyn.mesh.teeth.damage.gear import Damage, DamagedTeeth
from tribodyn.mesh.teeth.damage.patch import BrokenTip, MissingMap, Patch, Scuffing, Spall
from tribodyn.mesh.teeth.damage.root_crack import RootCrack
from tribodyn.mesh.teeth.deviations import (
    FormulaErrors,
    MeasuredFlanks,
    PitchErrors,
    RunOut,
    ToothSample,
    formula_value,
)
from tribodyn.mesh.teeth.fields import CARRYING, LEADING, TRAILING, OwnFields, OwnTeeth
from tribodyn.numerics.curve import FormulaError
from tribodyn.standards.flank_tolerances import FlankTolerances

#: Error of a tooth over the module, at most.
LARGEST = 0.25
#: Keys with tables of errors.
_TABLES = "tooth_errors", "tooth_errors_back"

ToothSampleNumber = Annotated[int, Field(strict=True, ge=0, le=2**31 - 1), Draws()] | None


#: Flanks with which a gear carries in its meshes, one or both.
Carrying = tuple[int, ...]
BOTH_FLANKS: Carrying = (LEADING, TRAILING)
#: Of a pair: the pinion drives.
OF_PAIR: tuple[Carrying, Carrying] = (CARRYING["pinion"],), (CARRYING["gear"],)


def own_teeth_of(
    drive: DriveTable,
    sample: int | None,
    numbers: tuple[int, int] = (0, 1),
    carrying: tuple[Carrying, Carrying] = OF_PAIR,
) -> tuple[OwnTeeth, OwnTeeth]:
    """Return what teeth of pinion and gear have of their own; the drive has passed its rules.

    `numbers` are those of the gears in a train, in all meshes of one the same: samples are drawn by them.
    """
    allowed = zip(SIDES, numbers, carrying, tolerances_of(drive), strict=True)
    one, two = (tuple(_of_gear(drive, *each, sample)) for each in allowed)
    return one, two


def _of_gear(
    drive: DriveTable,
    side: str,
    number: int,
    carrying: Carrying,
    allowed: FlankTolerances | None,
    sample: int | None,
) -> Iterator[OwnFields]:
    gear: Gear = getattr(drive, side)
    table = gear.modification
    # a tooth that is out of place is so on both flanks: of an idler the one that drives counts
    placed, flanks = min(carrying), BOTH_FLANKS if table.both_flanks else carrying
    if gear.eccentricity or gear.wobble:
        angles = gear.eccentricity_angle, gear.wobble_angle
        yield RunOut(gear.teeth, gear.eccentricity, angles[0], gear.wobble, angles[1], gear.face_width)
    if table.pitch_errors:
        yield PitchErrors(tuple(table.pitch_errors), placed)
    back = table.tooth_errors_back
    if table.tooth_errors is not None:
        yield measured(table.tooth_errors, flanks if back is None else (placed,))
    if back is not None:
        yield measured(back, tuple(flank for flank in BOTH_FLANKS if flank != placed))
    if table.tooth_formula is not None:
        yield FormulaErrors(table.tooth_formula, gear.teeth, gear.face_width, flanks)
    if sample is not None and allowed is not None:
        limits = Limits(*(getattr(allowed, name) for name in Limits._fields))
        yield ToothSample(limits, gear.teeth, sample, number, gear.face_width, placed)


def measured(table: FlankErrors, flanks: Carrying) -> MeasuredFlanks:
    """Return measured flanks of the rows of a table, which are complete."""
    tooth, height, face, error = table.in_si()
    teeth, heights, faces = (np.unique(column) for column in (tooth, height, face))
    errors = np.empty((len(teeth), len(heights), len(faces)))
    index = tuple(np.searchsorted(*pair) for pair in ((teeth, tooth), (heights, height), (faces, face)))
    errors[index] = error
    return MeasuredFlanks(tuple(int(number) - 1 for number in teeth), heights, faces, errors, flanks)


def differing(drive: DriveTable) -> Iterator[tuple[str, str]]:
    """Go through the keys by which teeth of a drive differ, pitch errors apart, and the values as shown."""
    for side in SIDES:
        gear = getattr(drive, side)
        if gear.eccentricity:
            yield f"drive.{side}.eccentricity", shown_length(gear.eccentricity)
        if gear.wobble:
            yield f"drive.{side}.wobble", f"{gear.wobble:.3g} rad"
        for key in _TABLES:
            if getattr(gear.modification, key) is not None:
                yield f"drive.{side}.modification.{key}", "a table"
        if gear.modification.tooth_formula is not None:
            yield f"drive.{side}.modification.tooth_formula", f'"{gear.modification.tooth_formula}"'


def teeth_alike(drive: DriveTable) -> Iterator[InputError]:
    """Refuse what makes teeth differ, in a study that takes all of them alike."""
    yield from _idle_angles(drive)
    for key, value in differing(drive):
        rule = "the study takes all teeth of a gear alike"
        yield InputError(key, value, rule, "leave it out, or run the pair over time")


def _idle_angles(drive: DriveTable) -> Iterator[InputError]:
    """Refuse directions of what is not there."""
    for side in SIDES:
        gear: Gear = getattr(drive, side)
        for angle, of in (("eccentricity_angle", "eccentricity"), ("wobble_angle", "wobble")):
            if getattr(gear, angle) and not getattr(gear, of):
                rule, remedy = f"has no effect without {of}", f"add {of}, or leave it out"
                yield InputError(f"drive.{side}.{angle}", f"{getattr(gear, angle):.4g} rad", rule, remedy)


def broken_own_teeth(drive: DriveTable, sample: int | None) -> Iterator[InputError]:
    """Go through what is wrong with what single teeth have of their own."""
    yield from _idle_angles(drive)
    for side in SIDES:
        gear: Gear = getattr(drive, side)
        table, key = gear.modification, f"drive.{side}.modification"
        if gear.internal and gear.wobble:
            rule, shown = "internal pairs are even along the face", f"{gear.wobble:.3g} rad"
            yield InputError(f"drive.{side}.wobble", shown, rule, "leave it out")
        for name in _TABLES:
            if (errors := getattr(table, name)) is not None:
                yield from _broken_table(f"{key}.{name}", errors, gear)
        if table.both_flanks and table.tooth_errors_back is not None:
            rule, remedy = "contradicts both_flanks = true", "leave one of them out"
            yield InputError(f"{key}.tooth_errors_back", "a table", rule, remedy)
        if table.tooth_formula is not None:
            yield from _broken_formula(f"{key}.tooth_formula", table.tooth_formula, gear, drive.module)
        for name, size in _sizes(gear):
            if size > LARGEST * drive.module:
                rule = (
                    f"more than a quarter of the module, {shown_length(LARGEST * drive.module)}, is no error"
                )
                yield InputError(f"drive.{side}.{name}", shown_length(size), rule, "check the unit")
    if sample is not None and None in tolerances_of(drive):
        rule = "is taken from the tolerances of both gears, and they have no quality"
        yield InputError("mesh.tooth_sample", sample, rule, "add quality = 6 to [drive]")


def _sizes(gear: Gear) -> Iterator[tuple[str, float]]:
    """Keys of errors that are lengths, and how large these are, m."""
    table = gear.modification
    yield "eccentricity", gear.eccentricity
    yield "wobble", gear.wobble * gear.face_width / 2.0
    yield "modification.pitch_errors", max(map(abs, table.pitch_errors), default=0.0)
    for name in _TABLES:
        if (errors := getattr(table, name)) is not None:
            yield f"modification.{name}", float(np.max(np.abs(errors.in_si()[3])))


def _broken_formula(key: str, formula: str, gear: Gear, module: float) -> Iterator[InputError]:
    """Refuse what is no formula of every tooth, or of errors that are none."""
    height, face = np.linspace(0.0, 1.0, 201), np.linspace(-0.5, 0.5, 21)[:, None]
    try:
        values = [formula_value(formula, tooth, gear.teeth, height, face) for tooth in range(gear.teeth)]
    except FormulaError as error:
        remedy = 'write micrometres over i, z, h and f, such as "3*sin(2*pi*i/z)"'
        yield InputError(key, f'"{formula}"', str(error), remedy)
        return
    size = 1e-6 * float(np.max(np.abs(values)))
    if size > LARGEST * module:
        rule = f"reaches {1e3 * size:.3g} mm: more than a quarter of the module is no error"
        yield InputError(key, f'"{formula}"', rule, "write micrometres")


def _broken_table(key: str, table: FlankErrors, gear: Gear) -> Iterator[InputError]:
    tooth, height, face, _ = table.in_si()
    sizes = [len(np.unique(column)) for column in (tooth, height, face)]
    if not np.all((tooth >= 1) & (tooth <= gear.teeth) & (tooth == np.round(tooth))):
        wrong = tooth[(tooth < 1) | (tooth > gear.teeth) | (tooth != np.round(tooth))][0]
        rule = f"the gear has teeth 1 to {gear.teeth}"
        yield InputError(key, f"tooth {wrong:g}", rule, "number the teeth in the order in which they mesh")
    elif not np.all((height >= 0.0) & (height <= 1.0)):
        rule = "height runs from 0 at the root's end of the path of contact to 1 at the tip's"
        yield InputError(key, f"height {height[(height < 0.0) | (height > 1.0)][0]:g}", rule, "scale it")
    elif not np.all(np.abs(face) <= gear.face_width / 2.0 * (1.0 + 1e-9)):
        rule = f"face is the place from the middle of the face, which is {1e3 * gear.face_width:g} mm wide"
        yield InputError(key, f"face {1e3 * np.max(np.abs(face)):g} mm", rule, "measure from the middle")
    elif len(tooth) != int(np.prod(sizes)) or len(set(zip(tooth, height, face, strict=True))) != len(tooth):
        rule = f"{len(tooth)} points, not one for each of {shown_count(sizes[0])} of tooth, " + (
            f"{sizes[1]} of height and {sizes[2]} of face"
        )
        yield InputError(key, None, rule, "measure every tooth at the same heights and places on the face")


def with_own_teeth(mesh: MeshData, teeth: tuple[OwnTeeth, OwnTeeth]) -> MeshData:
    """Return a mesh whose teeth differ by what they have of their own, and no longer by pitch errors."""
    modifications = mesh.modifications
    pinion, gear = (getattr(modifications, side)._replace(pitch_error=()) for side in SIDES)
    early = sum(each.early for gear in teeth for each in gear)
    return replace(mesh, modifications=modifications._replace(pinion=pinion, gear=gear), early=early)


#: Damaged teeth of a scenario, at most.
MOST_DAMAGE = 200

_Length = Annotated[float, InUnit(units.positive(units.LENGTH), "2 mm")]
_FLANKS = {"leading": LEADING, "trailing": TRAILING}
_ENDS = {"+z": 1, "-z": -1}
#: Width over which a patch begins, where none is given, m.
EDGE = 0.2e-3


class MissingTable(Columns):
    """Missing material over a flank: at every height (0 at the root's end of the path, 1 at the tip's)."""

    height: Annotated[Column, units.NUMBER]
    face: Annotated[Column, units.LENGTH]
    depth: Annotated[Column, units.DEVIATION]


class DamageTable(Table):
    """Damage of one tooth."""

    gear: Text = Field(examples=["pinion"])
    tooth: Annotated[int, Field(strict=True)] = Field(examples=[5])
    kind: Literal["crack", "spall", "pit", "broken-tip", "scuffing"]
    flank: Literal["leading", "trailing"] | None = None
    depth: _Length | None = None
    angle: Annotated[float, InUnit(units.positive(units.ANGLE_KIND), "60 deg")] | None = None
    tangent: Annotated[float, InUnit(units.positive(units.ANGLE_KIND), "30 deg")] | None = None
    deepest: Literal["+z", "-z"] | None = None
    height: Number | None = None
    radius: _Length | None = None
    length: _Length | None = None
    width: _Length | None = None
    face: Annotated[float, InUnit(units.LENGTH, "0 mm")] = written("0 mm")
    diameter: _Length | None = None
    shape: Literal["rectangle", "ellipse"] | None = None
    edge: _Length | None = None
    factor: Positive | None = None
    map: Annotated[MissingTable, csv_file("height", "face", "depth")] | None = None


Damages = Annotated[tuple[DamageTable, ...], Field(max_length=MOST_DAMAGE)]


class GearPlace(NamedTuple):
    """A gear that can be damaged: the pairs that it belongs to, and what it is in each; the first counts."""

    pairs: tuple[tuple[DriveTable, Side], ...]

    @property
    def table(self) -> Gear:
        """The gear as it is written."""
        drive, side = self.pairs[0]
        return getattr(drive, side)

    def flank(self, table: DamageTable) -> int:
        """The damaged flank."""
        if table.flank is not None:
            return _FLANKS[table.flank]
        return CARRYING[self.pairs[0][1]]

    def touched(self, flank: int) -> tuple[DriveTable, Side]:
        """A pair in which the flank carries; the first one where none does."""
        return next((pair for pair in self.pairs if CARRYING[pair[1]] == flank), self.pairs[0])


def damage_of(tables: Sequence[DamageTable], gear: GearPlace) -> tuple[OwnFields, ...]:
    """What teeth of a gear have by these tables, which are its own and have passed the rules."""
    if not tables:
        return ()
    return (DamagedTeeth(tuple(_damage(table, gear.flank(table)) for table in tables)),)


def _damage(table: DamageTable, flank: int) -> Damage:
    tooth, width = table.tooth - 1, inf if table.width is None else table.width
    edge = EDGE if table.edge is None else table.edge
    if table.kind == "crack":
        deepest = _ENDS.get(table.deepest or "", 0)
        return RootCrack(tooth, flank, table.depth or 0.0, *angles_of(table), table.face, width, deepest)
    if table.kind == "broken-tip":
        return BrokenTip(tooth, table.height, table.radius, table.face, width, edge)
    if table.map is not None:
        return _mapped(table.map, tooth, flank)
    if table.kind == "pit":
        size = table.diameter or 0.0
        patch = Patch(table.height, table.radius, size, table.face, size, edge, "ellipse")
        return Spall(tooth, flank, patch, table.depth or 0.0)
    shape = table.shape or "rectangle"
    patch = Patch(table.height, table.radius, table.length or 0.0, table.face, width, edge, shape)
    if table.kind == "scuffing":
        return Scuffing(tooth, flank, patch, table.factor or 1.0)
    return Spall(tooth, flank, patch, table.depth or 0.0)


def angles_of(table: DamageTable) -> tuple[float, float]:
    """Angles of a crack, and of the fillet where it starts, to the tooth's axis, rad."""
    tangent = pi / 6 if table.tangent is None else table.tangent
    return pi / 2 - tangent if table.angle is None else table.angle, tangent


def _mapped(table: MissingTable, tooth: int, flank: int) -> MissingMap:
    height, face, depth = table.in_si()
    heights, faces = np.unique(height), np.unique(face)
    missing = np.empty((len(heights), len(faces)))
    missing[np.searchsorted(heights, height), np.searchsorted(faces, face)] = depth
    return MissingMap(tooth, flank, heights, faces, missing)
