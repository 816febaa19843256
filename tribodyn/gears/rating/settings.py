"""What standards of load capacity need to know beside the gears and their duty."""

from collections.abc import Iterator, Sequence
from typing import Annotated, Literal

from pydantic import Field

from tribodyn.errors import InputError, quoted
from tribodyn.geometry.drive import MaterialData
from tribodyn.input import units
from tribodyn.input.quantity import InUnit, Positive, Switch, Table, written

AtLeastOne = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=1, le=100)]
Hours = Annotated[float, InUnit(units.positive(units.TIME), "20000 h")]
Relief = Annotated[float, InUnit(units.not_negative(units.LENGTH), "20 um")]
Roughness = Annotated[float, InUnit(units.positive(units.LENGTH), "4.8 um")]
#: Mean peak-to-valley roughness over Ra where the former is not given: ISO 6336-2.
PEAKS_OVER_MEAN = 6.0
#: What is required where nothing is said, usual in industrial gearing: life, s; S_Hmin and S_Fmin.
_LIFE, _SAFETY_PITTING, _SAFETY_BENDING = 20000.0 * 3600.0, 1.0, 1.4


class RatingTable(Table):
    """What the standards need to know."""

    edition: Literal[2019, 2006] = Field(
        2019, description="of ISO 6336-1, -2, -3, by which stresses are computed"
    )
    application_factor: Positive = Field(1.0, description="K_A, what the driven and the driving machine add")
    lubrication: Literal["dip", "spray", "submerged"] = Field(
        "dip", description="how the oil gets to the mesh"
    )
    structure_factor: Positive = Field(
        1.0, description="X_W: 1 of case-hardened steel, 1.5 nitrided (ISO/TS 6336-20, table 2)"
    )
    run_in: Switch = Field(True, description="whether flanks are run in, for scuffing (X_E)")
    tip_relief: Relief | None = Field(
        None, description="C_a that the standard credits, for scuffing (X_Ca); default: none"
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
    required_life: Hours | None = Field(None, description="in operation; default: 20000 h")
    required_safety_pitting: Positive | None = Field(
        None, description="S_Hmin; a safety below is red; default: 1"
    )
    required_safety_bending: Positive | None = Field(
        None, description="S_Fmin; a safety below is red; default: 1.4"
    )
    peak_roughness: Roughness | None = Field(None, description="Rz of the flanks; default: 6 Ra")
    root_roughness: Roughness = written("20 um", description="Rz of the root fillets")

    @property
    def root_by_formula(self) -> bool:
        """Whether roots of internal gears are those of the standard's formula; trains have a key for it."""
        return False

    @property
    def life(self) -> float:
        """The required life, s."""
        return _LIFE if self.required_life is None else self.required_life

    @property
    def safety_pitting(self) -> float:
        """The required S_Hmin."""
        return _SAFETY_PITTING if self.required_safety_pitting is None else self.required_safety_pitting

    @property
    def safety_bending(self) -> float:
        """The required S_Fmin."""
        return _SAFETY_BENDING if self.required_safety_bending is None else self.required_safety_bending


def broken_strength_rules(
    table: str, settings: RatingTable, materials: Sequence[MaterialData]
) -> Iterator[InputError]:
    """Refuse what asks for safeties or a life of materials without strength."""
    names = [name for name in _OF_STRENGTH if getattr(settings, name) is not None]
    lacking = [material.name for material in materials if material.treatment is None]
    if names and lacking:
        rule = f"needs the strength of the material, which {quoted(lacking[0])} has not"
        remedy = 'add treatment = "case-hardened" (or another) to the material, or leave the key out'
        yield InputError(f"{table}.{names[0]}", rule=rule, remedy=remedy)


#: Keys that make no sense without the strength of the materials.
_OF_STRENGTH = ("required_life", "required_safety_pitting", "required_safety_bending")
