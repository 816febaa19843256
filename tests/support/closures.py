"""Surfaces, lubricants and laws of local contacts, as the tests of laws and efficiencies need them."""

import math
from dataclasses import replace
from typing import Any

from tribodyn.geometry.drive import MaterialData
from tribodyn.tribology.closure import closure, closure_of, without_nominal_conditions
from tribodyn.tribology.contact import Surfaces, local_contact
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import Closure, FilmData, FrictionData, LawInput
from tribodyn.tribology.oil import LubricantData
from tribodyn.tribology.surface_state import SurfaceState, surface_state

#: Laws of the local contact.
LOCAL_LAWS = ("masjedi-khonsari", "xu", "benedict-kelley")
MIXED = "masjedi-khonsari"


def _given(steel: MaterialData, oil: LubricantData, modulus: float, roughness: float) -> LawInput:
    heat = steel.density * steel.specific_heat
    surfaces = Surfaces(
        effective_modulus=modulus,
        hardness=steel.hardness,
        roughness=roughness,
        mean_roughness=roughness / math.sqrt(math.pi),
        inlet_viscosity=oil.inlet_viscosity,
        pressure_viscosity=oil.pressure_viscosity,
        pinion_conductivity=steel.thermal_conductivity,
        gear_conductivity=steel.thermal_conductivity,
        pinion_heat_capacity=heat,
        gear_heat_capacity=heat,
    )
    return LawInput(surfaces, oil, (steel, steel), without_nominal_conditions)


#: Liu & Ni (2022), Table 2; solid 7850 kg/m³, 460 J/(kg K).
LIU_NI = _given(
    MaterialData("steel", 2.06e11, 0.3, 7850.0, 60.5, 460.0, 2.3e9),
    LubricantData(0.11, 0.091, 0.35, 2.5e-8, 0.57, 0.045, 880.0),
    2.06e11 / 0.91,
    3e-7,
)
#: Veciana et al. (2024), Table 2; density of the lubricant in the Péclet numbers.
VECIANA = _given(
    MaterialData("steel", 2.1e11, 0.3, 769.2, 60.5, 434.0, 6e9),
    LubricantData(0.12, 0.06, 0.01, 1.5e-8, 0.58, 0.03, 769.2),
    231e9,
    0.2e-6,
)
POINT = dict(
    line_load=3.85e5,
    curvature=1 / 8.98e-3,
    entrainment=0.134,
    sliding=0.0447,
    pinion_speed=0.156,
    gear_speed=0.112,
)


def under(friction: str, given: LawInput = LIU_NI, film: str | None = None, **values: float) -> Closure:
    """Surfaces and laws by name; the values are those of the friction law's own keys, SI."""
    law = FRICTION_LAWS[friction]
    return closure(given, FILM_LAWS[film or law.film], law, {}, values)


def coulomb(coefficient: float, given: LawInput = VECIANA) -> Closure:
    """Coulomb's law."""
    return under("coulomb", given, coefficient=coefficient)


def of_case(case: Any, friction: str, **values: float) -> Closure:
    """Surfaces of a case under another friction law, and the film law that goes with it."""
    return closure_of(replace(case, friction=FrictionData(friction, values), film=FilmData()))


def known(laws: Closure, *state: Any, **named: Any) -> SurfaceState:
    """All that is known of a contact of that state, see `local_contact`."""
    return surface_state(local_contact(*state, **named), laws)
