"""What all solved contacts of a case have in common, from its surfaces, its oil and its materials."""

from collections.abc import Iterable
from typing import NamedTuple

from tribodyn.errors import InputError, SimulationError
from tribodyn.numerics.elementary import is_jax
from tribodyn.tribology.ehl.coupled import solve_coupled
from tribodyn.tribology.ehl.fluid import Fluid, Rheology
from tribodyn.tribology.ehl.heat import HeatProperties
from tribodyn.tribology.ehl.problem import LineContact
from tribodyn.tribology.ehl.rough import Roughness
from tribodyn.tribology.high_pressure import contact_viscosity
from tribodyn.tribology.law import LawInput
from tribodyn.tribology.pressure_law import PressureLaw, asymptotic_coefficient


class Contact(NamedTuple):
    """What is the same in all contacts of a case; numbers alone, so that it has a hash."""

    fluid: Fluid
    effective_modulus: float
    roughness: Roughness
    rheology: Rheology
    thermal: HeatProperties
    #: lowest, highest: how the viscosity may rise with pressure where that is estimated; else none
    band: tuple[PressureLaw, ...] = ()
    #: whether the viscosity is no estimate (1 or 0), pressure up to which it was measured, Pa, and the
    #: temperatures' share: 1 inside the measured ones, ½ outside
    viscosity_limits: tuple[float, float, float] = (1.0, float("inf"), 1.0)

    def under(self, law: PressureLaw) -> "Contact":
        """The contact with another rise of its viscosity."""
        return self._replace(
            fluid=self.fluid._replace(pressure_viscosity=asymptotic_coefficient(law), law=law)
        )


def contact_of(inputs: LawInput) -> Contact:
    """Return what all contacts of a case have in common, from its surfaces, oil and materials.

    The film slips at the oil's limiting shear stress Λ p beside `Rheology`'s floor. Raises InputError if a
    derivative by one of these numbers is requested: a table is of one oil and one pair of surfaces.
    """
    surfaces, oil, asperities = inputs.surfaces, inputs.lubricant, inputs.asperities
    numbers = (
        *(oil.inlet_viscosity, oil.pressure_viscosity, oil.viscosity_pressure_index, oil.asperity_friction),
        *(oil.limiting_shear_coefficient, oil.temperature_viscosity),
        *(surfaces.effective_modulus, surfaces.roughness),
        *(surfaces.pinion_conductivity, surfaces.gear_conductivity),
        *(surfaces.pinion_heat_capacity, surfaces.gear_heat_capacity),
    )
    if any(is_jax(number) for number in numbers):
        remedy = "use a law of formulas, or differences"
        raise InputError("film.law", '"solved"', "has no derivative by oil or surfaces", remedy)
    eta, alpha, index, rubbing, limit, hot, modulus, height, k_1, k_2, c_1, c_2 = map(float, numbers)
    viscosity = contact_viscosity(oil)
    fluid = Fluid(eta, alpha, min(index, 1.0))
    if viscosity.law is not None:
        fluid = Fluid(eta, viscosity.pressure_viscosity, law=viscosity.law)
    outside = viscosity.law is not None and viscosity.temperature_outside(viscosity.law.temperature) > 0.0
    return Contact(
        fluid,
        modulus,
        Roughness(max(height, 1e-9), asperities.density, asperities.slope, rubbing),
        Rheology("limiting", limiting_coefficient=limit),
        HeatProperties(hot, solid_conductivity=(k_1, k_2), solid_heat_capacity=(c_1, c_2)),
        tuple(law for law in (viscosity.lowest, viscosity.highest) if law is not None),
        (0.0 if viscosity.estimated else 1.0, viscosity.maximum_pressure, 0.5 if outside else 1.0),
    )


def friction_band(
    contact: Contact, places: Iterable[tuple[float, float, float, float]], step: float = 0.12
) -> tuple[float, float]:
    """Lowest and highest factor on the loss that the band of an estimated viscosity makes; 1, 1 without one.

    Over contacts of line loads (N/m), entrainment (m/s), radii (m) and sliding speeds (m/s).
    """
    if not contact.band:
        return 1.0, 1.0
    lost = []
    for each in (contact, *map(contact.under, contact.band)):
        total = 0.0
        for line_load, speed, radius, sliding in places:
            problem = LineContact(
                line_load, radius, speed, each.fluid, each.effective_modulus, sliding, each.roughness
            )
            try:
                solution = solve_coupled(problem, each.rheology, each.thermal, step=step)
            except SimulationError:
                return float("nan"), float("nan")
            total += abs(solution.friction * sliding)
        lost.append(total)
    if lost[0] == 0.0:
        return 1.0, 1.0
    ratios = [1.0, *(value / lost[0] for value in lost[1:])]
    return min(ratios), max(ratios)
