"""What scenarios of gears have in common: keys of their tables, rules, and the fields of a case."""

from collections.abc import Iterable, Iterator
from dataclasses import fields
from pathlib import Path
from typing import Annotated, Any, ClassVar

from pydantic import BeforeValidator

from tribodyn.compliance.foundation import Support
from tribodyn.dynamics.data import OperatingData
from tribodyn.errors import InputError, quoted
from tribodyn.gears.by_standard import quality_of
from tribodyn.gears.mesh_of_gearbox import Opened, with_every_pair, with_pair
from tribodyn.gears.rating.requested_losses import drawn_of_pair, requested_losses
from tribodyn.gears.supports import displaced, has_supports, supports_of
from tribodyn.geometry.drive import SIDES
from tribodyn.input.fields import Slices, head_of
from tribodyn.input.quantity import Switch, Table, defaults_written_out, model_file, written
from tribodyn.input.tables.bearings import Bearings, broken_bearing_rules
from tribodyn.input.tables.duty import SpectrumScenario, duty_of, unnamed_duty
from tribodyn.input.tables.gears.drive_data import masses_of, teeth_of
from tribodyn.input.tables.gears.drive_rules import (
    Face,
    broken_drive_rules,
    broken_face_rules,
    broken_part_rules,
    broken_slice_rules,
    modifications_of,
    slices_of,
)
from tribodyn.input.tables.gears.model_files import DriveTable, GearboxTable, MisalignmentTable
from tribodyn.input.tables.gears.quality import (
    DeviationSample,
    broken_sample_rules,
    error_with_sample,
    grade_of,
    tolerances_of,
    with_sample,
)
from tribodyn.input.tables.gears.single_teeth import broken_own_teeth, teeth_alike
from tribodyn.input.tables.gears.tooth_data import broken_internal_runs, internal_refused
from tribodyn.input.tables.laws import FilmTable, film_of, law_values
from tribodyn.input.tables.losses import LossesTable, broken_losses, broken_mesh_method
from tribodyn.input.tables.lubricant import Lubricant, broken_lubricant_rules, lubricant_of
from tribodyn.input.tables.shafts import Shafts, broken_shafts, drawn_shafts, listed
from tribodyn.input.tables.temperature import (
    GearboxTemperatureTable,
    TemperatureTable,
    broken_temperature_rules,
    oil_temperature_of,
    temperature_of,
)
from tribodyn.mesh.table import MeshData
from tribodyn.tribology.law import AUTO, FilmData, FrictionData

Oil = Annotated[Lubricant, model_file("lubricants")]
TemperatureKeys = TemperatureTable | None
GearboxTemperatureKeys = GearboxTemperatureTable | None
LossKeys = LossesTable | None
ShaftKeys = Shafts | None
#: Of studies of the teeth alone, which read matrices of it.
MatrixKeys = Annotated[Bearings | None, model_file("bearings")]
FilmKeys = FilmTable | None
FaceSlices = Annotated[Slices | None, BeforeValidator(lambda value: None if value == "auto" else value)]

#: Where a table [mesh] has no keys of misalignment, and neither does the drive's quality add any.
_ALIGNED = MisalignmentTable(from_quality=0.0)


class FaceTable(Table):
    """How the axes stand, and in how many slices the face is taken."""

    misalignment: MisalignmentTable = written({})
    slices: FaceSlices = None


class MeshTable(FaceTable):
    """How slices and gear bodies deflect, and which deviations the flanks have."""

    slice_coupling: Switch = True
    body: Support = "free"
    deviation_sample: DeviationSample | None = None


class GearScenario(SpectrumScenario):
    """A scenario of gears; each kind adds its tables."""

    #: whether the kind knows internal gears
    internal_gears: ClassVar[bool] = False
    #: whether [losses] may name a formula for meshes under load
    mesh_formulas: ClassVar[bool] = False
    #: whether it knows them where they drive, which a negative torque says
    driving_rings: ClassVar[bool] = True
    #: tables that `completed` fills, before the defaults of this kind
    COMPLETED_BY: ClassVar = {
        "gearbox": ("operating", "mesh", "lubricant", "film", "friction", "temperature")
    }
    kind: Any
    gearbox: GearboxTable | None = None
    drive: Annotated[DriveTable, model_file("drives")]

    @classmethod
    def completed(cls, data: dict[str, Any], referring: Path, opened: Opened) -> dict[str, Any]:
        """Its data with the pair of gears of its `gearbox`, if any; see `mesh_of_gearbox.with_pair`."""
        if "gearbox" not in data:
            return data
        return defaults_written_out(with_pair(data, cls, referring, opened), cls)

    @classmethod
    def of_every_mesh(
        cls, data: dict[str, Any], referring: Path, opened: Opened
    ) -> dict[str, dict[str, Any] | None]:
        """Data of every mesh of a `gearbox` that names none; see `mesh_of_gearbox.with_every_pair`."""
        if "gearbox" not in data:
            return {}
        knows = cls.internal_gears, cls.driving_rings
        every = with_every_pair(data, cls, referring, opened, driven_rings=knows[0], driving_rings=all(knows))
        return {mesh: each and defaults_written_out(each, cls) for mesh, each in every.items()}


def gear_fields(scenario: Any, toml: str, sha256: str, **own: Any) -> dict[str, Any]:
    """Return the fields of a `GearCase` for a scenario that has passed schema and rules.

    Fields of its `own` stand in place of its duty, `operating`, and of its `mesh` as `mesh_data` has it.
    """
    drive = scenario.drive
    gears = drive.pinion, drive.gear
    if "operating" not in own:
        duty = duty_of(scenario.operating, drive.pinion.teeth, drive.gear.teeth)
        own["operating"] = OperatingData(*duty)
    if "mesh" not in own:
        own["mesh"] = mesh_data(scenario)
    return {
        **head_of(scenario, toml, sha256),
        **teeth_of(drive),
        **own,
        "masses": masses_of(drive),
        "supports": supports_of(scenario),
        "quality": quality_of(
            [grade_of(drive, gear) for gear in gears], tolerances_of(drive), drive.quality_edition
        ),
    }


def oil_fields(scenario: Any) -> dict[str, Any]:
    """Return the further fields of a `LubricatedCase`; tables that the kind does not have count as absent.

    Where nothing is said of film and friction, the film law is the one nearest at the duty.
    """
    friction, film, fields_of_case = getattr(scenario, "friction", None), getattr(scenario, "film", None), {}
    if friction is not None:
        options = {name: getattr(friction, name) for name in type(friction).model_fields if name != "law"}
        fields_of_case["friction"] = FrictionData(friction.law, law_values(friction), **options)
    return fields_of_case | {
        "lubricant": lubricant_of(scenario.lubricant, oil_temperature_of(scenario)),
        "film": FilmData(AUTO) if film is None and friction is None else film_of(film),
        "temperature": temperature_of(getattr(scenario, "temperature", None)),
        "losses": requested_losses(scenario),
    }


def mesh_data(
    scenario: Any, *, every_tooth: bool = False, tilting: bool = False, error: Any = None, **own: Any
) -> MeshData:
    """Return what a scenario says of its mesh, by finite elements where it names no compliance.

    Its table [mesh] may lack any key. `every_tooth` is for studies that know teeth that differ, `tilting` for
    those whose gears tilt on their bearings by themselves, where the face is cut into slices; to `error`, a
    pair's transmission error over roll angle (rad, m), a sample of deviations adds; `own` are fields of
    `MeshData` that are not plain keys of the table. Drawn shafts add their misalignment to that of the
    scenario.
    """
    drive, mesh = scenario.drive, scenario.mesh
    modifications = modifications_of(drive, getattr(mesh, "misalignment", _ALIGNED))
    sample, slices = getattr(mesh, "deviation_sample", None), getattr(mesh, "slices", None)
    helical = bool(drive.helix_angle) and getattr(mesh, "compliance", "fem") == "fem"
    if _tilts_load_the_face(scenario):
        moved = displaced(modifications, supports_of(scenario))
        cut = slices_of(slices, moved, helical)
        if tilting and cut > 1:  # by which gears that tilt load the face
            slices = cut
        else:
            modifications = moved
    if getattr(mesh, "compliance", "fem") == "fem":
        modifications = with_sample(drive, modifications, sample, every_tooth=every_tooth, slices=slices)
    else:
        error = error_with_sample(drive, error, sample)
    given = {field.name for field in fields(MeshData)} & set(type(mesh).model_fields)
    values = {"compliance": "fem", "damping_ratio": 0.0} | {name: getattr(mesh, name) for name in given}
    values |= {"modifications": modifications, "slices": slices_of(slices, modifications, helical)}
    return MeshData(**values | {"error_table": error} | own)


def _tilts_load_the_face(scenario: Any) -> bool:
    """Whether the load along the face follows the tilts of the gears; internal spur pairs are even there."""
    drive = scenario.drive
    by_slices = getattr(scenario.mesh, "compliance", "fem") == "fem" and not drive.has_ring
    return by_slices or bool(drive.helix_angle)


def broken_film_keys(scenario: Any) -> Iterator[InputError]:
    """Refuse what says something of a film that is not there, in a scenario without a lubricant."""
    film_keys = {"operating.oil_temperature": scenario.operating.oil_temperature}
    film_keys |= {name: getattr(scenario, name, None) for name in ("film", "running_in")}
    remedy = 'add lubricant = "iso-vg-220-mineral", or leave it out'
    for key, value in film_keys.items():
        if value is not None:
            yield InputError(key, rule="without a lubricant there is no film", remedy=remedy)


#: Compliances that are given -> the key that gives them, and an example.
_GIVEN = {
    "constant": ("stiffness", '"2.8e8 N/m"'),
    "table": ("table", '"stiffness.csv", columns roll_angle and stiffness'),
}


def broken_stiffness_rules(mesh: Any, choices: Iterable[str] = tuple(_GIVEN)) -> Iterator[InputError]:
    """Go through what a table [mesh] lacks, or says twice, of a compliance that is given."""
    for choice in choices:
        name, example = _GIVEN[choice]
        present = getattr(mesh, name) is not None
        if mesh.compliance == choice and not present:
            rule = f'missing: compliance = "{choice}" needs it'
            yield InputError(f"mesh.{name}", rule=rule, remedy=f"add {name} = {example}")
        if mesh.compliance != choice and present:
            rule = f'contradicts compliance = "{mesh.compliance}"'
            remedy = f'leave {name} out, or write compliance = "{choice}"'
            yield InputError(f"mesh.{name}", rule=rule, remedy=remedy)


def _broken_internal_face(scenario: Any) -> Iterator[InputError]:
    """Refuse what varies along the face of an internal spur pair, whose teeth are not cut into slices."""
    if scenario.drive.helix_angle:
        return
    modifications = modifications_of(scenario.drive, getattr(scenario.mesh, "misalignment", _ALIGNED))
    slices = getattr(scenario.mesh, "slices", None)
    if slices_of(slices, modifications) > 1:
        even = "internal spur pairs are even along the face"
        rule = f"{even}: no slices, and nothing modified or misaligned along it"
        remedy = "leave out slices, misalignment, and the crowning and end relief of both gears"
        yield InputError("mesh.slices", slices, rule, remedy)


def _broken_supports(scenario: Any) -> Iterator[InputError]:
    """Go through the broken rules of shafts and bearings, where the kind has such tables."""
    shafts, bearings = getattr(scenario, "shaft", None), getattr(scenario, "bearings", None)
    if bearings is not None:
        yield from broken_bearing_rules(bearings, drawn_shafts(shafts))
    yield from broken_shafts(shafts, SIDES, bearings)
    for number, shaft in enumerate(listed(shafts)):
        if len(shaft.gears) > 1 and shaft.drawn is None:
            rule = "pinion and gear mesh, and turn on two shafts"
            yield InputError(f"shaft.{number}.gears", None, rule, "name one of them")


def broken_support_keys(scenario: Any) -> Iterator[InputError]:
    """Refuse bearings and shafts of which a study of the teeth alone reads nothing."""
    bearings = scenario.bearings
    if bearings is not None and not any(bearing.matrix for bearing in bearings.by_name.values()):
        rule = "has no effect: of bearings the teeth alone know the tilts, by a matrix"
        remedy = "leave it out, or give [bearings.pinion] a matrix"
        yield InputError("bearings", None, rule, remedy)
    elif has_supports(scenario) and not _tilts_load_the_face(scenario):
        teeth, remedy = "teeth of an internal pair", "leave it out"
        if not scenario.drive.has_ring:
            teeth = f'spur teeth with compliance = "{scenario.mesh.compliance}"'
            remedy = 'write mesh.compliance = "fem", or leave it out'
        key = "bearings" if bearings is not None else "shaft"
        yield InputError(key, None, f"has no effect: {teeth} are loaded evenly along the face", remedy)


def broken_gear_rules(
    scenario: Any, *, every_duty: bool = False, oil: bool = True, every_tooth: bool = False
) -> Iterator[InputError]:
    """Go through the broken rules of drive, duty, oil, temperatures, losses and mesh.

    Tables and keys that the scenario's kind does not have count as absent. `every_duty` says whether the
    study runs all duties of a load spectrum at a time, `oil` whether the lubricant is looked at,
    `every_tooth` whether teeth may differ.
    """
    drive, mesh, lubricant = scenario.drive, scenario.mesh, scenario.lubricant
    if drive.has_ring:
        if not getattr(scenario, "internal_gears", True):
            yield internal_refused(drive)
            return
        yield from broken_internal_runs(scenario)
        yield from _broken_internal_face(scenario)
    yield from broken_drive_rules(drive)
    if not every_duty:
        yield from unnamed_duty(scenario)
    if lubricant is not None:
        if oil:
            yield from broken_lubricant_rules(lubricant, oil_temperature_of(scenario))
        yield from broken_temperature_rules(getattr(scenario, "temperature", None), lubricant)
    losses = getattr(scenario, "losses", None)
    yield from broken_losses(losses, drawn=drawn_of_pair(scenario))
    yield from broken_mesh_method(losses, [drive.family])
    if losses is not None and losses.mesh is not None and not getattr(scenario, "mesh_formulas", False):
        rule = "is for points of operation of gear pairs and trains, and this kind does not have them"
        yield InputError("losses.mesh", quoted(losses.mesh), rule, "leave it out")
    yield from _broken_supports(scenario)
    misalignment = getattr(mesh, "misalignment", _ALIGNED)
    coupling = getattr(mesh, "slice_coupling", True)
    face = Face(drive, misalignment, getattr(mesh, "slices", None), coupling, has_supports(scenario))
    if (compliance := getattr(mesh, "compliance", None)) is None:
        yield from broken_slice_rules(face)
    else:
        yield from broken_face_rules(face, compliance, every_tooth=every_tooth)
    if every_tooth:
        yield from broken_own_teeth(drive, mesh.tooth_sample)
    else:
        yield from teeth_alike(drive)
    yield from broken_sample_rules(drive, getattr(mesh, "deviation_sample", None), misalignment)
    if hasattr(mesh, "hertz"):
        yield from broken_part_rules(mesh.hertz, mesh.foundation, mesh.compliance)
