"""A line contact of two lubricated cylinders, its numbers and their check, and its solution; SI units."""

import math
import numbers
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.numerics.shapes import Array
from tribodyn.tribology.contact import hertz_half_width
from tribodyn.tribology.contact import hertz_pressure as maximum_hertz_pressure
from tribodyn.tribology.ehl.fluid import LAWS, Fluid, Rheology
from tribodyn.tribology.ehl.grid import FilmGrid
from tribodyn.tribology.ehl.heat import HeatProperties
from tribodyn.tribology.ehl.reynolds import FilmState, FlowCorrection
from tribodyn.tribology.ehl.rough import Reduced, Roughness, RoughReduced, asperities, gap

#: Moes' M and L between which contacts are tried; gears have M 5 … 2000 and L 2 … 25. Smooth ones converge up
#: to M = 1e4, rough ones up to the dry contact.
LEAST_LOAD, GREATEST_LOAD, GREATEST_MATERIAL = 0.01, 1e12, 1000.0
#: Products of several numbers up to this size, and of their inverses, are still floats.
LARGEST = 1e30


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
        flow = 12.0 * self.entrainment_speed * self.fluid.viscosity * self.radius**2
        return flow / (self.half_width**3 * self.hertz_pressure)

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
        flow = 2.0 * self.fluid.viscosity * self.entrainment_speed
        return flow / (self.effective_modulus * self.radius)


class Solution(NamedTuple):
    """A solved contact."""

    problem: LineContact
    reduced: Reduced
    grid: FilmGrid
    state: FilmState  # State, in Hertz's units
    film: Array  # H at the nodes
    closure: FlowCorrection  # what shear and heat make of the flow
    steps: int  # of Newton's method
    imbalance: float  # largest residual: of mass flow over the flow, of force over the load

    @property
    def place(self) -> Array:
        """Place x of the nodes, m; 0 on the line of centres, the film ends at the last."""
        return (self.state.end + self.grid.node) * self.problem.half_width

    @property
    def pressure(self) -> Array:
        """Of fluid and asperities together, Pa."""
        return self.fluid_pressure + self.asperity_pressure

    @property
    def asperity_pressure(self) -> Array:
        """Mean pressure of the asperities, Pa; 0 between smooth surfaces."""
        if not isinstance(self.reduced, RoughReduced):
            return np.zeros_like(self.film)
        return asperities(self.film, self.reduced)[0] * self.problem.hertz_pressure

    @property
    def fluid_pressure(self) -> Array:
        """Pa; 0 behind the film."""
        return self.state.pressure * self.problem.hertz_pressure

    @property
    def mean_gap(self) -> Array:
        """Mean distance of the surfaces, m: the film of smooth ones, never zero between rough ones."""
        if not isinstance(self.reduced, RoughReduced):
            return self.film_thickness
        return gap(self.film, self.reduced)[0] * self.problem.film_unit

    @property
    def asperity_load_ratio(self) -> float:
        """Share of the load that the asperities carry."""
        carried = float(self.grid.weight @ self.asperity_pressure)
        return carried / self.problem.line_load * self.problem.half_width

    @property
    def film_thickness(self) -> Array:
        """Film thickness, m."""
        return self.film * self.problem.film_unit

    @property
    def central_film_thickness(self) -> float:
        """Film on the line of centres, x = 0, m."""
        return _parabola(self.place, self.film_thickness, int(np.argmin(np.abs(self.place))))[0]

    @property
    def minimum_film_thickness(self) -> float:
        """Minimum film thickness, m."""
        return _parabola(self.place, self.film_thickness, int(np.argmin(self.film)))[1]

    @property
    def flow_film_thickness(self) -> float:
        """Flow per width over u ρ0: film where the pressure is highest, times relative density there, m."""
        return self.state.flow * self.problem.film_unit

    @property
    def rolling_drag(self) -> float:
        """Drag of the pressure flow on each surface, ½ ∫ h dp/dx dx, N/m (Biboulet & Houpert 2010).

        With τ = τ_m + (z − h/2) dp/dx in the film, ∫ τ_m dx holds back the faster surface, this one both.
        """
        pressure, thick = self.fluid_pressure, self.mean_gap
        return 0.25 * float(np.sum((thick[1:] + thick[:-1]) * np.diff(pressure)))


def _parabola(place: Array, value: Array, at: int) -> tuple[float, float]:
    """Value at x = 0, and extreme value, of the parabola through a node and its neighbours."""
    at = min(max(at, 1), len(place) - 2)
    c2, c1, c0 = np.polyfit(place[at - 1 : at + 2] / place[-1], value[at - 1 : at + 2] / value[at], 2)
    extreme = c0 - c1 * c1 / (4.0 * c2) if c2 > 0.0 else 1.0
    return float(c0 * value[at]), float(min(extreme, 1.0) * value[at])


def number(name: str, value: Any) -> float:
    """Return a value as a float; raise InputError if it is none, or not finite."""
    real = isinstance(value, numbers.Real) and not isinstance(value, bool)
    try:
        converted = float(value) if real else math.nan
    except OverflowError:  # a whole number of hundreds of digits
        converted = math.inf
    if not math.isfinite(converted):
        raise InputError(name, quoted(value), "is not a finite number", "give a number in SI units")
    if abs(converted) > LARGEST:
        raise InputError(name, f"{converted:g}", f"is beyond {LARGEST:g}", "give a number in SI units")
    return converted


def not_negative(name: str, value: Any, unit: str = "", remedy: str = "write 0 or more") -> float:
    """Return a value as a float; raise InputError if it is none, or below zero."""
    converted = number(name, value)
    if converted < 0.0:
        raise InputError(name, f"{converted:g} {unit}".strip(), "must not be negative", remedy)
    return converted


def positive(name: str, value: Any, unit: str = "", remedy: str = "give a number above 0") -> float:
    """Return a value as a float; raise InputError if it is none, or not above zero."""
    converted = number(name, value)
    if converted <= 0.0:
        raise InputError(name, f"{converted:g} {unit}".strip(), "must be positive", remedy)
    if converted < 1.0 / LARGEST:
        raise InputError(name, f"{converted:g} {unit}".strip(), f"is below {1.0 / LARGEST:g}", remedy)
    return converted


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
    values = {**problem._asdict(), **problem.fluid._asdict()}
    for name, (unit, remedy) in _POSITIVE.items():
        positive(name, values[name], unit, remedy)
    not_negative("pressure_viscosity", problem.fluid.pressure_viscosity, "1/Pa")
    number("sliding_speed", problem.sliding_speed)
    if problem.fluid.viscosity_pressure_index > 1.0:
        index = problem.fluid.viscosity_pressure_index
        raise InputError("viscosity_pressure_index", index, "is above 1, which is Barus' law", "give z ≤ 1")
    if problem.roughness is not None:
        check_roughness(problem.roughness)
    _check_size(problem)


def _check_size(problem: LineContact) -> None:
    """Raise InputError outside of what the equations are made for."""
    width, load, material = problem.half_width, problem.moes_load, problem.moes_material
    where = "line_load", f"{problem.line_load:g} N/m"
    if width > problem.radius:
        rule = f"the contact is wider ({2.0 * width:.3g} m) than cylinders of {problem.radius:.3g} m radius"
        raise InputError(*where, rule, "half spaces need a lower load, a larger radius or a stiffer material")
    if not LEAST_LOAD <= load <= GREATEST_LOAD:
        rule = f"Moes' load parameter M is {load:.3g}, solved is {LEAST_LOAD:g} … {GREATEST_LOAD:g}"
        raise InputError(*where, rule, "check load, speed and viscosity, and their units")
    if material > GREATEST_MATERIAL:
        value = f"{problem.fluid.pressure_viscosity:g} 1/Pa"
        rule = f"Moes' material parameter L is {material:.3g}, solved is up to {GREATEST_MATERIAL:g}"
        raise InputError("pressure_viscosity", value, rule, "check its unit: 1e-8 … 4e-8 1/Pa of oils")


def check_roughness(roughness: Roughness) -> None:
    """Raise InputError at the first value that is not positive."""
    names = {"height": "roughness", "density": "asperity_density", "slope": "asperity_slope"}
    for name, key in names.items():
        positive(key, getattr(roughness, name), remedy="leave the roughness out for smooth surfaces")
    not_negative("asperity_friction", roughness.friction, remedy="0.08 … 0.15 of steel")


def check_heat(thermal: HeatProperties) -> None:
    """Raise InputError at the first value that is no number, or not positive."""
    not_negative("temperature_viscosity", thermal.temperature_viscosity, "1/K")
    for name in ("conductivity", "heat_capacity"):
        positive(f"oil_{name}", getattr(thermal, name))
    for name in ("solid_conductivity", "solid_heat_capacity"):
        value = getattr(thermal, name)
        if not isinstance(value, tuple) or len(value) != 2:
            raise InputError(name, value, "must be two numbers", "give those of surface 1 and surface 2")
        for part in value:
            positive(name, part)


def check_rheology(rheology: Rheology) -> None:
    """Raise InputError at an unknown law or a constant that is not positive."""
    if not isinstance(rheology.law, str) or rheology.law not in LAWS:
        raise unknown_name("rheology", str(rheology.law), LAWS, "law of shear")
    for name in LAWS[rheology.law]:
        positive(name, getattr(rheology, name), remedy=f'law "{rheology.law}" reads it')
    if rheology.law == "carreau" and rheology.carreau_index > 1.0:
        raise InputError("carreau_index", rheology.carreau_index, "thickens with shear", "give n ≤ 1")
