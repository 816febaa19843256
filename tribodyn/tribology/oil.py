"""An oil: from its data sheet, or from numbers given, to what film and friction laws read of it.

A data sheet gives the kinematic viscosity at 40 and 100 °C, the density at 15 °C and the type of the base
oil; from that follows everything at any temperature. Temperatures are absolute, K; the functions take floats,
arrays and traced numbers.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Literal, NamedTuple, get_args

from tribodyn.numerics.elementary import exp, log, minimum
from tribodyn.tribology.pressure_law import MeasuredViscosity

OilType = Literal["mineral", "pao", "ester", "pag"]
OIL_TYPES: tuple[OilType, ...] = get_args(OilType)

#: 0 °C, and the temperatures of the data sheet's viscosities, K.
ZERO_CELSIUS = 273.15
T_40, T_100 = 313.15, 373.15
#: Temperatures for which values are derived, K: below, wax and viscosity improvers bend the line of D341;
#: above, oils decompose. Limits of this package; ASTM D341 itself gives none but the viscosity's.
TEMPERATURE_RANGE = (ZERO_CELSIUS - 40.0, ZERO_CELSIUS + 180.0)
#: Kinematic viscosities, m²/s, for which the constant 0.7 of ASTM D341 holds.
MINIMUM_VISCOSITY, MAXIMUM_VISCOSITY = 2e-6, 20.0
#: ln ln(ν + 0.7) at which viscosities are held, far above the last: a power of a power stays a number.
_HELD = 4.0
#: Roelands' constants: pressure p_0, Pa, and −ln of the viscosity at its pole, ln of Pa·s.
ROELANDS_PRESSURE, ROELANDS_POLE = 1.962e8, 9.67


def kinematic_viscosity(viscosity_40: Any, viscosity_100: Any, temperature: Any) -> Any:
    """Kinematic viscosity ν at a temperature, m²/s, by ASTM D341 (Ubbelohde & Walther).

    lg lg(ν + 0.7) = C − B lg T with ν in mm²/s and T in K, through the viscosities at 40 and 100 °C (m²/s).
    """
    level, slope = walther_line(viscosity_40, viscosity_100)
    return 1e-6 * (exp(exp(minimum(level - slope * log(temperature), _HELD))) - 0.7)


def walther_line(viscosity_40: Any, viscosity_100: Any) -> tuple[Any, Any]:
    """Level C′ and slope B of ln ln(ν + 0.7) = C′ − B ln T, ν in mm²/s; B is the standard's."""
    at_40 = log(log(1e6 * viscosity_40 + 0.7))
    slope = (at_40 - log(log(1e6 * viscosity_100 + 0.7))) / (log(T_100) - log(T_40))
    return at_40 + slope * log(T_40), slope


def density_at(density_15: Any, temperature: Any) -> Any:
    """Density ρ = ρ15 − 0.7 (T − 289), kg/m³ (ISO/TR 15144-1)."""
    return density_15 - 0.7 * (temperature - 289.0)


_STANDARD = "ISO/TR 15144-1"
#: Factor (1/Pa) and exponent of α38 = factor η38^exponent, η38 in Pa·s: ISO/TR 15144-1.
PRESSURE_VISCOSITY: dict[OilType, tuple[float, float]] = {
    "mineral": (2.657e-8, 0.1348),
    "pao": (1.466e-8, 0.0507),
    "pag": (1.392e-8, 0.1572),
}
#: α = s ν^t of saturated esters, 1/Pa, ν in mm²/s at the requested temperature: Gold et al., J. Synthetic
#: Lubrication 18 (2001) 51; ISO/TR 15144-1 gives no ester. From memory of the literature, not checked against
#: the paper: give pressure_viscosity where it is known.
ESTER = (6.605e-9, 0.1360)


def pressure_viscosity_38(kind: OilType, viscosity: Any) -> Any:
    """Pressure-viscosity coefficient at 38 °C, 1/Pa, from the viscosity η there, Pa·s; not of an ester."""
    factor, exponent = PRESSURE_VISCOSITY[kind]
    return factor * exp(exponent * log(viscosity))


def roelands_index(pressure_viscosity: Any, viscosity: Any) -> Any:
    """Roelands' z = α p_0/(ln η0 + 9.67): his law then begins with the slope α; α in 1/Pa, η0 in Pa·s."""
    return pressure_viscosity * ROELANDS_PRESSURE / (log(viscosity) + ROELANDS_POLE)


def temperature_viscosity_at(viscosity_40: Any, viscosity_100: Any, density_15: Any, temperature: Any) -> Any:
    """K_T = −d ln η/dT at a temperature, 1/K: the slopes of ASTM D341 and of the density."""
    level, slope = walther_line(viscosity_40, viscosity_100)
    logarithm = exp(minimum(level - slope * log(temperature), _HELD))
    shifted = exp(logarithm)
    of_kinematic = shifted / (shifted - 0.7) * logarithm * slope / temperature
    return of_kinematic + 0.7 / density_at(density_15, temperature)


def specific_heat(density_15: Any, temperature: Any) -> Any:
    """Specific heat of a mineral oil, J/(kg K): (1685 + 3.39 θ)/√d, θ in °C, d relative density.

    C. S. Cragoe, Bureau of Standards Miscellaneous Publication 97 (1929); taken for the other types too.
    """
    return (1685.0 + 3.39 * (temperature - ZERO_CELSIUS)) / exp(0.5 * log(1e-3 * density_15))


class Typical(NamedTuple):
    """A coefficient by the type of the oil."""

    value: float
    source: str
    spread: tuple[float, float] | None = None  # of what is published; None: one value


_ARANA = "Arana, Larrañaga & Ulacia (2019)"
#: Λ_lim, limiting shear stress over pressure: twin discs at 1 GPa and 60 °C (DOI 10.1177/1350650118778655).
LIMITING_SHEAR: dict[OilType, Typical] = {
    "mineral": Typical(0.047, f"{_ARANA}, twin discs, 1 GPa, 60 °C: paraffinic; naphthenic", (0.047, 0.053)),
    "pao": Typical(0.035, f"{_ARANA}, twin discs, 1 GPa, 60 °C; spread assumed", (0.030, 0.040)),
    "ester": Typical(0.035, "assumption: as PAO, whose lubricant factor esters share", (0.030, 0.045)),
    "pag": Typical(0.0315, "assumption: PAO's, by the ratio of Schlenk's lubricant factors", (0.025, 0.035)),
}
#: f_c, friction coefficient of touching asperities: the same of all types.
BOUNDARY_FRICTION = Typical(0.065, f"{_ARANA}, boundary; others use up to 0.12 (Veciana)", (0.065, 0.12))
#: X_L of the mean friction coefficient of ISO/TR 15144-1 and of Niemann. Of esters the standard lists only
#: the phosphate ester, 1.3; of PAG 0.6 where they dissolve in water.
LUBRICANT_FACTOR: dict[OilType, Typical] = {
    "mineral": Typical(1.0, _STANDARD),
    "pao": Typical(0.8, _STANDARD),
    "ester": Typical(0.8, "assumption: as PAO; ISO/TR 15144-1 gives none", (0.8, 1.0)),
    "pag": Typical(0.7, f"{_STANDARD}, not soluble in water; 0.6 soluble", (0.6, 0.7)),
}
_OPEN = "values of an open program for Schlenk's formula"
#: X_L of Schlenk's mean friction coefficient.
SCHLENK_FACTOR: dict[OilType, Typical] = {
    "mineral": Typical(0.846, _OPEN),
    "pao": Typical(0.65, _OPEN),
    "ester": Typical(0.65, _OPEN),
    "pag": Typical(0.585, _OPEN),
}


def by_type(kind: OilType) -> dict[str, Typical]:
    """Numbers of a `LubricantData` that follow from the type of the oil alone."""
    return {
        "limiting_shear_coefficient": LIMITING_SHEAR[kind],
        "asperity_friction": BOUNDARY_FRICTION,
        "load_exponent": Typical(0.0, "the lubricant factor stands for it"),
        "lubricant_factor": LUBRICANT_FACTOR[kind],
        "schlenk_factor": SCHLENK_FACTOR[kind],
    }


class OilValue(NamedTuple):
    """A number of a lubricant: value (SI), unit, where it is from, and its spread where one is known."""

    value: Any
    unit: str
    origin: str
    spread: tuple[float, float] | None = None


#: Units of the numbers of a `LubricantData`, in the order in which they are shown.
UNITS = {
    "inlet_viscosity": "Pa s",
    "density": "kg/m3",
    "pressure_viscosity": "1/Pa",
    "viscosity_pressure_index": "1",
    "temperature_viscosity": "1/K",
    "limiting_shear_coefficient": "1",
    "asperity_friction": "1",
    "load_exponent": "1",
    "lubricant_factor": "1",
    "schlenk_factor": "1",
}
GIVEN = "given"


@dataclass(frozen=True)
class OilSheet:
    """An oil as its data sheet has it."""

    type: OilType
    #: viscosity_40, viscosity_100: kinematic, at 40 and 100 °C, m²/s; the first is the larger
    viscosity_40: Any
    viscosity_100: Any
    density_15: Any  # at 15 °C, kg/m³
    #: numbers of `LubricantData` that take the place of derived ones, by name
    given: Mapping[str, Any] = field(default_factory=lambda: MappingProxyType({}))
    law: MeasuredViscosity | None = None  # how its viscosity rises with pressure, where that was measured
    roelands: bool = False  # whether the solved contact takes Roelands' law, and no estimate by type

    def viscosity(self, temperature: Any) -> Any:
        """Dynamic viscosity η = ν ρ at a temperature, Pa·s."""
        kinematic = kinematic_viscosity(self.viscosity_40, self.viscosity_100, temperature)
        return kinematic * density_at(self.density_15, temperature)

    def pressure_viscosity(self, temperature: Any) -> Any:
        """Pressure-viscosity coefficient α at a temperature, 1/Pa.

        α* of a measured law; else α = α38 [1 + 516 (1/T − 1/311)] (ISO/TR 15144-1), but of esters `ESTER`.
        """
        if self.law is not None:
            return self.law.coefficient(temperature)
        if self.type == "ester":
            kinematic = kinematic_viscosity(self.viscosity_40, self.viscosity_100, temperature)
            return ESTER[0] * exp(ESTER[1] * log(1e6 * kinematic))
        at_38 = pressure_viscosity_38(self.type, self.viscosity(ZERO_CELSIUS + 38.0))
        return at_38 * (1.0 + 516.0 * (1.0 / (temperature - 0.15) - 1.0 / 311.0))

    def values(self, temperature: Any) -> dict[str, OilValue]:
        """All numbers of `LubricantData` at a temperature (K), with their origin."""
        values: dict[str, OilValue] = {}

        def put(name: str, value: Any, origin: str, spread: tuple[float, float] | None = None) -> Any:
            if name in self.given:
                value, origin, spread = self.given[name], GIVEN, None
            values[name] = OilValue(value, UNITS[name], origin, spread)
            return value

        at_hand = "ASTM D341 and density over temperature"
        viscosity = put("inlet_viscosity", self.viscosity(temperature), f"kinematic by {at_hand}")
        put("density", density_at(self.density_15, temperature), f"density_15 - 0.7 (T - 289 K), {_STANDARD}")
        source = f"{'Gold et al. (2001)' if self.type == 'ester' else _STANDARD}, {self.type} oil"
        if self.law is not None:
            source = "α* of viscosity_law, 1/∫ η0/η dp"
        coefficient = put("pressure_viscosity", self.pressure_viscosity(temperature), source)
        index = roelands_index(coefficient, viscosity)
        put("viscosity_pressure_index", index, "pressure_viscosity and inlet_viscosity, Roelands")
        slope = temperature_viscosity_at(self.viscosity_40, self.viscosity_100, self.density_15, temperature)
        put("temperature_viscosity", slope, f"slope of {at_hand}")
        for name, typical in by_type(self.type).items():
            put(name, typical.value, typical.source, typical.spread)
        return values


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
    temperature: Any = None  # at which the numbers hold, K; None: not given
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
    """Return the numbers of the same oil at another temperature (K); ValueError without a data sheet."""
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
    values = {}
    for name, unit in UNITS.items():
        value, typical_value = getattr(lubricant, name), typical.get(name)
        if lubricant.given is None or name in lubricant.given:
            values[name] = OilValue(value, unit, GIVEN)
        elif typical_value is not None:
            values[name] = OilValue(value, unit, typical_value.source, typical_value.spread)
        else:
            values[name] = OilValue(value, unit, DEFAULTS[name])
    return values
