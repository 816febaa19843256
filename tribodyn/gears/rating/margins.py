"""Margins against scuffing and micropitting: what an oil stands by its FZG tests, and what a motion takes."""

import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.gears.case import GearCase, LubricatedCase
from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import MaterialData
from tribodyn.standards import fzg, micropitting, scuffing
from tribodyn.standards.micropitting import Flanks, Oil
from tribodyn.tribology.oil import LubricantData

#: Grade by ISO 1328-1 where a drive has none.
_GRADE = 7.0


class Strength(NamedTuple):
    """What the oil stands, from its FZG load stages; None where there is none. Temperatures in K."""

    scuffing: float | None
    scuffing_integral: float | None
    specific_film: float | None


def oil_of(lubricant: LubricantData) -> Oil:
    """The oil over temperature, of a data sheet."""
    sheet = lubricant.sheet
    assert sheet is not None, "refused by the rules"
    return Oil(sheet.viscosity, sheet.pressure_viscosity, lubricant.lubricant_factor)


def flanks_of(case: GearCase) -> Flanks:
    """What the flanks are of."""
    pinion, gear = case.materials
    reduced = 2.0 / sum(
        (1.0 - material.poisson_ratio**2) / material.youngs_modulus for material in (pinion, gear)
    )
    grade = case.quality.grade if case.quality else _GRADE
    return Flanks(case.mean_roughness, reduced, (_contact(pinion), _contact(gear)), grade)


def _contact(material: MaterialData) -> float:
    return math.sqrt(material.thermal_conductivity * material.density * material.specific_heat)


def strength_of(
    lubricant: LubricantData,
    oil_temperature: float,
    structure: float = 1.0,
    materials: Sequence[MaterialData] = (),
) -> Strength:
    """Scuffing temperatures and permissible film of an oil of a data sheet that enters at a temperature (K).

    `structure` is X_W of the teeth's material, see `fzg.scuffing_temperature`; W_W is that of `materials`.
    """
    stages, sheet, factor = lubricant.fzg, lubricant.sheet, lubricant.lubricant_factor
    assert sheet is not None, "refused by the rules"
    flash = integral = film = None
    if stages.scuffing is not None:
        of_flash = scuffing.lubricant_factor(factor, float(sheet.viscosity(oil_temperature)))
        flash = fzg.scuffing_temperature(stages.scuffing, of_flash, structure)
        integral = fzg.scuffing_integral_temperature(
            stages.scuffing, factor, float(sheet.viscosity_40), structure
        )
    if stages.micropitting is not None:
        film = fzg.permissible_specific_film(
            stages.micropitting,
            oil_of(lubricant),
            fzg.material_factor([material.treatment for material in materials]),
            stages.micropitting_temperature,
        )
    return Strength(flash, integral, film)


def bulk_of(assembly: Assembly, quantities: Mapping[str, Any], oil: float, supply: str = "dip") -> float:
    """Bulk temperature of the teeth in motion, K: its own, else by its loss as in ISO/TR 15144-1.

    `oil` is the temperature (K) of the oil that enters.
    """
    if quantities.get("bulk_temperature") is not None:
        return float(quantities["bulk_temperature"])
    centre = float(assembly.path.pinion_pitch_radius + assembly.path.gear_pitch_radius)
    # over a short window friction may give more than it takes: that heats nothing
    loss, width = max(float(quantities["power_friction_mean"]), 0.0), float(assembly.common_width)
    factor = micropitting.LUBRICATION_FACTORS[supply]
    return oil + micropitting.bulk_rise(loss, 1.0, 1.0, centre, width, factor)


def margins_of(
    case: LubricatedCase, assembly: Assembly, window: Mapping[str, np.ndarray], quantities: Mapping[str, Any]
) -> dict[str, float]:
    """Safeties S_B (ISO/TS 6336-20) and S_λ (ISO/TS 6336-22) of a mesh in motion, by the oil's FZG stages.

    From the pressures, speeds, friction and flash temperatures of the motion and the bulk temperature of
    `bulk_of`; case-hardened teeth, dip lubrication, no application factor; S_λ by the film formula of the
    standard, which the permissible film is of. `window` are datasets of the mesh, `quantities` those of its
    summary.
    """
    temperature, flash = case.lubricant.temperature, float(quantities.get("flash_temperature_max", 0.0))
    if case.lubricant.sheet is None or temperature is None or not flash > 0.0:
        return {}
    oil, margins = float(temperature), dict[str, float]()
    strength = strength_of(case.lubricant, oil, materials=case.materials)
    bulk = bulk_of(assembly, quantities, oil)
    if strength.scuffing is not None:
        margins["S_B"] = scuffing.flash_safety(strength.scuffing, bulk + flash, oil)
    if strength.specific_film is not None:
        sliding, mean = np.abs(window["sliding_speed"]) / 2.0, np.abs(window["entrainment_speed"])
        with np.errstate(invalid="ignore", divide="ignore"):
            films = micropitting.at_places(
                window["hertz_pressure"],
                window["equivalent_radius"],
                (mean + sliding, mean - sliding),
                quantities["friction_coefficient_mean"],
                bulk,
                flanks_of(case),
                oil_of(case.lubricant),
            )
        margins["S_lambda"] = float(np.nanmin(films.specific_film)) / strength.specific_film
    return margins
