"""The tables of modified flanks, ``[drive.pinion.modification]``, and of the axes' deviations."""

from typing import Annotated, Literal

from pydantic import Field

from tribodyn.geometry.flanks.modification import FlankModification, LeadRelief, Misalignment, Relief
from tribodyn.scenario import units
from tribodyn.scenario.common import ErrorCurve
from tribodyn.scenario.quantity import InUnit, NotNegative, Switch, Table, csv_file, written

Amount = Annotated[float, InUnit(units.not_negative(units.RELIEF))]
Extent = Annotated[float, InUnit(units.positive(units.LENGTH))]
Shape = Literal["linear", "parabolic"]

_EXPONENT = {"linear": 1.0, "parabolic": 2.0}


class Modification(Table):
    """What is missing on the flanks of a gear, along their normal: the driving flanks, or both."""

    tip_relief: Amount = written("0 um", description="at the end of the active profile")
    tip_relief_length: Extent | None = Field(
        None, description="along the line of action, from the end of the active path; default: the module"
    )
    tip_relief_shape: Shape = "linear"
    root_relief: Amount = written("0 um", description="at the beginning of the active profile")
    root_relief_length: Extent | None = Field(
        None, description="along the line of action, from the end of the active path; default: the module"
    )
    root_relief_shape: Shape = "linear"
    lead_relief_start: Amount = written("0 um", description="at one end of the face, parabolic")
    lead_relief_end: Amount = written("0 um", description="at the other end")
    lead_unmodified: Annotated[float, InUnit(units.not_negative(units.LENGTH))] = written(
        "0 mm", description="straight part of the face between the two, in its middle"
    )
    crowning: Amount | None = Field(
        None, description="the same at both ends of the face, without a straight part"
    )
    profile_error: (
        Annotated[
            ErrorCurve,
            csv_file("roll_angle", "error"),
        ]
        | None
    ) = Field(None, description="positive where material is missing")
    pitch_errors: Annotated[
        tuple[Annotated[float, InUnit(units.DEVIATION)], ...], csv_file("error", as_list=True)
    ] = Field((), description="one per tooth, positive where material is missing")
    both_flanks: Switch = Field(
        False, description="whether reliefs, crowning and profile error are on the back flanks too"
    )


class MisalignmentTable(Table):
    """Angles between the axes of the gears."""

    in_plane: Annotated[float, InUnit(units.SMALL_ANGLE)] = written(
        "0 arcmin", description="within the plane of action"
    )
    out_of_plane: Annotated[float, InUnit(units.SMALL_ANGLE)] = written(
        "0 arcmin", description="perpendicular to the plane of action"
    )
    from_quality: NotNegative = Field(
        0.0, description="share of both gears' helix slope tolerances that adds to in_plane"
    )


def flank_of(table: Modification, module: float) -> FlankModification:
    """Return the modification of a gear's flanks; `module` in m is the length of reliefs without one."""
    return FlankModification(
        tip=_relief(table, "tip", module),
        root=_relief(table, "root", module),
        lead=LeadRelief(
            table.lead_relief_start, table.lead_relief_end, table.lead_unmodified, table.crowning or 0.0
        ),
        profile_error=table.profile_error.in_si() if table.profile_error else None,
        pitch_error=table.pitch_errors,
        both_flanks=table.both_flanks,
    )


def misalignment_of(table: MisalignmentTable) -> Misalignment:
    """Return how the axes stand."""
    return Misalignment(table.in_plane, table.out_of_plane)


def _relief(table: Modification, end: str, module: float) -> Relief:
    amount, length = getattr(table, f"{end}_relief"), getattr(table, f"{end}_relief_length")
    if length is None:
        length = module if amount else 0.0
    return Relief(amount, length, _EXPONENT[getattr(table, f"{end}_relief_shape")])
