"""What standards of load capacity need to know beside the gears and their duty."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

from pydantic import Field

from tribodyn.errors import InputError, quoted
from tribodyn.geometry.drive import MaterialData
from tribodyn.scenario import units
from tribodyn.scenario.quantity import InUnit, Positive, Switch, Table, written

AtLeastOne = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=1)]
Hours = Annotated[float, InUnit(units.positive(units.TIME), "20000 h")]
Roughness = Annotated[float, InUnit(units.positive(units.LENGTH), "4.8 um")]
#: Mean peak-to-valley roughness over Ra where the former is not given: ISO 6336-2.
PEAKS_OVER_MEAN = 6.0


class RatingTable(Table):
    """What the standards need to know."""

    application_factor: Positive = Field(1.0, description="K_A, what the driven and the driving machine add")
    lubrication: Literal["dip", "spray", "submerged"] = Field(
        "dip", description="how the oil gets to the mesh"
    )
    structure_factor: Positive = Field(
        1.0, description="X_W: 1 of case-hardened steel, 1.5 nitrided (ISO/TS 6336-20, table 2)"
    )
    adequate_tip_relief: Switch = Field(
        False, description="whether the standards may count on the tip relief that the flanks have"
    )
    mesh_load_factor: AtLeastOne | None = Field(
        None, description="K_γ, share of the most loaded of several meshes in parallel; default: 1"
    )
    dynamic_factor: AtLeastOne | None = Field(
        None, description="K_v of the standard; default: ISO 6336-1, method B"
    )
    face_load_factor: AtLeastOne | None = Field(None, description="K_Hβ; default: of the contact analysis")
    transverse_load_factor: AtLeastOne | None = Field(
        None, description="K_Hα of the standard; default: ISO 6336-1, method B"
    )
    gear_blank_factor: Positive | None = Field(
        None, description="C_R of gears with rim and web, for the standard's stiffness; default: 1, solid"
    )
    required_life: Hours = written("20000 h", description="in operation, of pinion and gear")
    required_safety_pitting: Positive = Field(1.0, description="S_Hmin; a safety below is red")
    required_safety_bending: Positive = Field(1.4, description="S_Fmin; a safety below is red")
    peak_roughness: Roughness | None = Field(None, description="Rz of the flanks; default: 6 Ra")
    root_roughness: Roughness = written("20 um", description="Rz of the root fillets")


def broken_strength_rules(
    table: str, settings: RatingTable, materials: Sequence[MaterialData]
) -> Iterator[InputError]:
    """Refuse what asks for safeties or a life of materials without strength."""
    names = [name for name in _OF_STRENGTH if name in settings.model_fields_set]
    lacking = [material.name for material in materials if material.treatment is None]
    if names and lacking:
        rule = f"needs the strength of the material, which {quoted(lacking[0])} has not"
        remedy = 'add treatment = "case-hardened" (or another) to the material, or leave the key out'
        yield InputError(f"{table}.{names[0]}", rule=rule, remedy=remedy)


_OF_STRENGTH = ("required_life", "required_safety_pitting", "required_safety_bending")
