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

    edition: Literal[2019, 2006] = 2019
    application_factor: Positive = 1.0
    lubrication: Literal["dip", "spray", "submerged"] = "dip"
    structure_factor: Positive = 1.0
    run_in: Switch = True
    tip_relief: Relief | None = None
    adequate_tip_relief: Switch = False
    mesh_load_factor: AtLeastOne | None = None
    dynamic_factor: AtLeastOne | None = None
    face_load_factor: AtLeastOne | None = None
    transverse_load_factor: AtLeastOne | None = None
    gear_blank_factor: Positive | None = None
    required_life: Hours | None = None
    required_safety_pitting: Positive | None = None
    required_safety_bending: Positive | None = None
    peak_roughness: Roughness | None = None
    root_roughness: Roughness = written("20 um")

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
