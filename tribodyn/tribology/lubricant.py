"""What a case says of its lubricant and of the asperities in it, in SI units."""

from dataclasses import dataclass
from typing import Any

from tribodyn.tribology.oil import GIVEN, UNITS, OilSheet, OilType, OilValue, by_type

#: Where the defaults of `LubricantData` are from.
DEFAULTS = {
    "load_exponent": "default: mineral oil 75W90 (Diez-Ibarbia et al.)",
    "lubricant_factor": "default: the load exponent stands for it",
    "schlenk_factor": "default: mineral oil",
}


@dataclass(frozen=True)
class FzgStages:
    """Failure load stages of an oil in FZG's tests; None where the data sheet gives none."""

    scuffing: int | None = None  # test A/8.3/90 (ISO 14635-1)
    micropitting: int | None = None  # test C-GF/8.3/90 (FVA 54/7)
    micropitting_temperature: float = 363.15  # oil temperature of the latter, K


@dataclass(frozen=True)
class LubricantData:
    """Lubricant and asperities, as film and friction laws make their parameters of them."""

    asperity_friction: float  # f_c, friction coefficient of the asperities
    limiting_shear_coefficient: float  # Λ_lim, limiting shear stress over pressure
    inlet_viscosity: float  # η0, dynamic viscosity at inlet temperature and ambient pressure, Pa s
    pressure_viscosity: float  # α_PV, 1/Pa
    viscosity_pressure_index: float  # z of Roelands' law
    temperature_viscosity: float  # K_T, 1/K
    density: float  # kg/m³; used by ISO/TR 14179-1 and by Veciana's variant of the Péclet number
    #: d of Niemann's lubricant factor X_L w^−d; 0.0651 of mineral oil 75W90 (Diez-Ibarbia et al.)
    load_exponent: float = 0.0651
    lubricant_factor: float = 1.0  # X_L of Niemann's mean friction coefficient and of ISO/TR 15144-1
    schlenk_factor: float = 0.846  # X_L of Schlenk's mean friction coefficient; default: mineral oil
    temperature: Any = None  # at which the numbers hold, K; None: not said
    type: OilType | None = None  # of an oil without a data sheet, where it is given
    given: frozenset[str] | None = None  # numbers that are neither of the type nor defaults; None: all
    sheet: OilSheet | None = None  # the data sheet that they come from, where they do
    fzg: FzgStages = FzgStages()
    #: temperature of the oil around the gears, K, where the numbers are those at the teeth's bulk
    #: temperature: mean friction coefficients read the viscosity there
    supply: Any = None


def lubricant_from(sheet: OilSheet, temperature: Any, fzg: FzgStages = FzgStages()) -> LubricantData:
    """Return the numbers of an oil at a temperature (K), from its data sheet."""
    numbers = {name: number.value for name, number in sheet.values(temperature).items()}
    return LubricantData(**numbers, temperature=temperature, sheet=sheet, fzg=fzg)


def lubricant_at(lubricant: LubricantData, temperature: Any) -> LubricantData:
    """Return the numbers of the same oil at another temperature (K).

    Raises
    ------
    ValueError
        If it has no data sheet: its numbers hold at one temperature only.
    """
    if lubricant.sheet is None:
        raise ValueError("a lubricant without a data sheet is known at one temperature only")
    return lubricant_from(lubricant.sheet, temperature, lubricant.fzg)


def lubricant_around(lubricant: LubricantData) -> LubricantData:
    """Return the numbers of the oil around the gears, where the teeth are warmer than it."""
    return lubricant if lubricant.supply is None else lubricant_at(lubricant, lubricant.supply)


def oil_values(lubricant: LubricantData) -> dict[str, OilValue]:
    """Numbers of a lubricant by name, with their origin, whether from a data sheet or given."""
    if lubricant.sheet is not None:
        return lubricant.sheet.values(lubricant.temperature)
    typical = by_type(lubricant.type) if lubricant.type is not None else {}
    found = {}
    for name, unit in UNITS.items():
        value, usual = getattr(lubricant, name), typical.get(name)
        if lubricant.given is None or name in lubricant.given:
            found[name] = OilValue(value, unit, GIVEN)
        elif usual is not None:
            found[name] = OilValue(value, unit, usual.source, usual.real_spread)
        else:
            found[name] = OilValue(value, unit, DEFAULTS[name])
    return found
