"""Rules of modified flanks, slices and deviating axes: what contradicts, and which kinds of run know them."""

from collections.abc import Iterator
from math import degrees
from typing import NamedTuple

from tribodyn.errors import InputError
from tribodyn.geometry.modification import too_few_slices, vary_along_lead
from tribodyn.scenario.drive_data import modifications_of
from tribodyn.scenario.model_files import DriveTable
from tribodyn.scenario.modification import MisalignmentTable, Modification


class Face(NamedTuple):
    """What a scenario says of the flanks along and across the face."""

    drive: DriveTable
    misalignment: MisalignmentTable
    slices: int | None
    slice_coupling: bool


def broken_flank_rules(drive: DriveTable) -> Iterator[InputError]:
    """Go through what contradicts in the modifications of both gears."""
    for name in ("pinion", "gear"):
        gear = getattr(drive, name)
        yield from _flank(f"drive.{name}.modification", gear.modification, gear.teeth, gear.face_width)


def _flank(key: str, table: Modification, teeth: int, face_width: float) -> Iterator[InputError]:
    for end in ("tip", "root"):
        if (amount := getattr(table, f"{end}_relief")) and getattr(table, f"{end}_relief_length") is None:
            yield InputError(
                f"{key}.{end}_relief",
                _length(amount),
                "nothing says how far it reaches",
                f'add {end}_relief_length = "3 mm", along the line of action',
            )
    if table.crowning is not None:
        for name in ("lead_relief_start", "lead_relief_end", "lead_unmodified"):
            if value := getattr(table, name):
                yield InputError(
                    f"{key}.{name}",
                    _length(value),
                    "contradicts crowning, which gives the whole shape of the lead",
                    "give the one or the other",
                )
    if table.lead_unmodified > face_width:
        yield InputError(
            f"{key}.lead_unmodified",
            _length(table.lead_unmodified),
            f"longer than the face of {_length(face_width)}",
            "use less than the face width",
        )
    if table.pitch_errors and len(table.pitch_errors) != teeth:
        yield InputError(
            f"{key}.pitch_errors",
            _values(len(table.pitch_errors)),
            f"the gear has {teeth} teeth",
            "give one value per tooth",
        )


def broken_slice_rules(face: Face) -> Iterator[InputError]:
    """Go through the rules of a run that knows modifications: slices enough for what varies."""
    varies = vary_along_lead(modifications_of(face.drive, face.misalignment))
    if face.slices is not None and (broken := too_few_slices(face.slices, varies)):
        yield broken


def broken_face_rules(face: Face, compliance: str) -> Iterator[InputError]:
    """Go through the rules of a run that repeats one mesh cycle, by finite elements or without them."""
    if compliance == "fem":
        yield from broken_slice_rules(face)
        yield from _contradicted_pitch_errors(face.drive)
    else:
        remedy = 'leave it out, or write compliance = "fem"'
        yield from _contradicted_modifications(face, f'compliance = "{compliance}"', remedy)


def _contradicted_modifications(face: Face, contradiction: str, remedy: str) -> Iterator[InputError]:
    """Refuse everything of the sort in a run that does not know it.

    Parameters
    ----------
    contradiction : str
        What it contradicts: ``compliance = "energy"``.
    remedy : str
        What to write instead.
    """
    for key, value in (*_all_reliefs(face.drive), *_pitch_errors(face.drive), *_deviations(face)):
        yield InputError(key, value, f"contradicts {contradiction}", remedy)


def _contradicted_pitch_errors(drive: DriveTable) -> Iterator[InputError]:
    """Refuse errors of single teeth in a run whose mesh repeats with every pitch."""
    for key, value in _pitch_errors(drive):
        yield InputError(
            key,
            value,
            "the run repeats one mesh cycle, in which all teeth are alike",
            "leave it out, or use a load contact study",
        )


def _all_reliefs(drive: DriveTable) -> Iterator[tuple[str, str | None]]:
    for name in ("pinion", "gear"):
        table = getattr(drive, name).modification
        key = f"drive.{name}.modification"
        for relief in ("tip_relief", "root_relief", "lead_relief_start", "lead_relief_end", "crowning"):
            if amount := getattr(table, relief):
                yield f"{key}.{relief}", _length(amount)
        if table.profile_error is not None:
            yield f"{key}.profile_error", None


def _pitch_errors(drive: DriveTable) -> Iterator[tuple[str, str | None]]:
    for name in ("pinion", "gear"):
        if errors := getattr(drive, name).modification.pitch_errors:
            yield f"drive.{name}.modification.pitch_errors", _values(len(errors))


def _deviations(face: Face) -> Iterator[tuple[str, str | None]]:
    for name, angle in face.misalignment.model_dump().items():
        if angle:
            yield f"mesh.misalignment.{name}", f"{degrees(angle) * 60:g} arcmin"
    if face.slices is not None:
        yield "mesh.slices", str(face.slices)
    if not face.slice_coupling:
        yield "mesh.slice_coupling", "false"


def _length(value: float) -> str:
    return f"{value * 1e6:g} um" if value < 1e-3 else f"{value * 1e3:g} mm"


def _values(count: int) -> str:
    return f"{count} value{'s' if count != 1 else ''}"
