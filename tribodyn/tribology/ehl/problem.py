"""A line contact between two lubricated cylinders, its Hertz contact and its numbers; SI units."""

import math
from typing import NamedTuple

from tribodyn.errors import InputError
from tribodyn.tribology.contact import hertz_half_width
from tribodyn.tribology.contact import hertz_pressure as maximum_hertz_pressure
from tribodyn.tribology.ehl import asperities
from tribodyn.tribology.ehl.asperities import Roughness
from tribodyn.tribology.ehl.fluid.fluid import Fluid
from tribodyn.tribology.ehl.values import not_negative, number, positive

#: Moes' M and L between which contacts are tried; gears have M 5 … 2000 and L 2 … 25. Smooth ones converge up
#: to M = 1e4, rough ones up to the dry contact.
LEAST_LOAD, GREATEST_LOAD, GREATEST_MATERIAL = 0.01, 1e12, 1000.0


class LineContact(NamedTuple):
    """What is between the surfaces and how they move; x runs in the direction of entrainment."""

    line_load: float  # w, N/m
    radius: float  # R, 1/R = 1/R_1 + 1/R_2, m
    entrainment_speed: float  # mean speed u = (u_1 + u_2)/2 of the surfaces relative to the contact, m/s, > 0
    fluid: Fluid
    effective_modulus: float  # E', 2/E' = (1 − ν_1²)/E_1 + (1 − ν_2²)/E_2, Pa
    sliding_speed: float = 0.0  # u_1 − u_2, m/s, any sign
    roughness: Roughness | None = None  # Roughness, or None of smooth surfaces

    @property
    def half_width(self) -> float:
        """Half width b of the Hertz contact, m."""
        return hertz_half_width(self.line_load, 1.0 / self.radius, self.effective_modulus)

    @property
    def hertz_pressure(self) -> float:
        """Maximum pressure p_H of the Hertz contact, Pa."""
        return maximum_hertz_pressure(self.line_load, 1.0 / self.radius, self.effective_modulus)

    @property
    def film_unit(self) -> float:
        """b²/R, m."""
        return self.half_width**2 / self.radius

    @property
    def speed_number(self) -> float:
        """λ = 12 u η0 R²/(b³ p_H) of Reynolds' equation; = 3π²/(8 M²)."""
        drawn = 12.0 * self.entrainment_speed * self.fluid.viscosity * self.radius**2
        return drawn / (self.half_width**3 * self.hertz_pressure)

    @property
    def moes_load(self) -> float:
        """Moes' M = W/√U_Σ, W = w/(E' R), U_Σ = 2 η0 u/(E' R)."""
        return self.line_load / (self.effective_modulus * self.radius) / math.sqrt(self._sum_speed)

    @property
    def moes_material(self) -> float:
        """Moes' L = α E' U_Σ^¼."""
        return self.fluid.pressure_viscosity * self.effective_modulus * self._sum_speed**0.25

    @property
    def surface_speeds(self) -> tuple[float, float]:
        """u_1 and u_2, m/s."""
        half = 0.5 * self.sliding_speed
        return self.entrainment_speed + half, self.entrainment_speed - half

    @property
    def _sum_speed(self) -> float:
        drawn = 2.0 * self.fluid.viscosity * self.entrainment_speed
        return drawn / (self.effective_modulus * self.radius)


#: Argument that must be positive -> unit, remedy.
_POSITIVE = {
    "line_load": ("N/m", "a contact without load has no film to solve; load it"),
    "radius": ("m", "give the radius of relative curvature"),
    "entrainment_speed": (
        "m/s",
        "count x and both speeds in the direction of entrainment; at rest no film forms",
    ),
    "viscosity": ("Pa*s", "give η0 at the inlet's temperature"),
    "effective_modulus": ("Pa", "give E', 2/E' = Σ(1 − ν²)/E"),
    "viscosity_pressure_index": ("", "give z of Roelands' law, 0.4 … 0.8 of mineral oils; 1 is Barus' law"),
}


def check(problem: LineContact) -> None:
    """Raise InputError at the first value that is no number, has the wrong sign, or is out of all bounds."""
    given = {**problem._asdict(), **problem.fluid._asdict()}
    for name, (unit, remedy) in _POSITIVE.items():
        positive(name, given[name], unit, remedy)
    not_negative("pressure_viscosity", problem.fluid.pressure_viscosity, "1/Pa")
    number("sliding_speed", problem.sliding_speed)
    if problem.fluid.viscosity_pressure_index > 1.0:
        index = problem.fluid.viscosity_pressure_index
        raise InputError("viscosity_pressure_index", index, "is above 1, which is Barus' law", "give z ≤ 1")
    if problem.roughness is not None:
        asperities.check(problem.roughness)
    _check_size(problem)


def _check_size(problem: LineContact) -> None:
    """Raise InputError outside of what the equations are made for."""
    width, load, material = problem.half_width, problem.moes_load, problem.moes_material
    if width > problem.radius:
        raise InputError(
            "line_load",
            f"{problem.line_load:g} N/m",
            f"the contact is wider ({2.0 * width:.3g} m) than cylinders of {problem.radius:.3g} m radius",
            "half spaces need a lower load, a larger radius or a stiffer material",
        )
    if not LEAST_LOAD <= load <= GREATEST_LOAD:
        raise InputError(
            "line_load",
            f"{problem.line_load:g} N/m",
            f"Moes' load parameter M is {load:.3g}, solved is {LEAST_LOAD:g} … {GREATEST_LOAD:g}",
            "check load, speed and viscosity, and their units",
        )
    if material > GREATEST_MATERIAL:
        raise InputError(
            "pressure_viscosity",
            f"{problem.fluid.pressure_viscosity:g} 1/Pa",
            f"Moes' material parameter L is {material:.3g}, solved is up to {GREATEST_MATERIAL:g}",
            "check its unit: 1e-8 … 4e-8 1/Pa of oils",
        )
