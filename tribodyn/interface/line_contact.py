"""A lubricated line contact as a function: film, pressure and friction from the equations."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from tribodyn.interface.words import in_python
from tribodyn.tribology.ehl.fluid import Fluid, roelands_index
from tribodyn.tribology.ehl.problem import LineContact, check
from tribodyn.tribology.ehl.steady import STEP, Solution, solve_steady
from tribodyn.tribology.ehl.traction import newtonian_friction, rolling_traction

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = Any


@dataclass(frozen=True)
class SolvedContact:
    """A solved line contact; SI, arrays over the nodes of the film.

    Attributes
    ----------
    x : along the direction of entrainment, m; 0 on the line of centres, the film ends at the last
    pressure : Pa
    film_thickness : m
    temperature : mean over the film, K above the inlet's
    central_film_thickness : at x = 0, m
    minimum_film_thickness : m
    friction_coefficient
        ∫ τ_m dx over the load, τ_m the mean shear stress over the film; of the sign of `sliding_speed`: where
        surface 1 is the faster one, the film holds it back and draws on surface 2.
    rolling_coefficient : drag of the pressure flow on each surface over the load, ½ ∫ h dp/dx dx/w
    hertz_pressure, half_width : of the dry contact, Pa, m
    moes_load, moes_material : Moes' M and L, with the sum of the speeds
    solution : the solution in Hertz's units, from which a similar contact can start
    """

    x: Array
    pressure: Array
    film_thickness: Array
    temperature: Array
    central_film_thickness: float
    minimum_film_thickness: float
    friction_coefficient: float
    rolling_coefficient: float
    hertz_pressure: float
    half_width: float
    moes_load: float
    moes_material: float
    solution: Solution

    def plot(self, ax: "Axes | None" = None) -> "Figure":
        """Draw pressure and film over the contact.

        Parameters
        ----------
        ax : matplotlib axes, optional
            Draw here; default: a figure of its own.
        """
        from tribodyn.post.style import PALETTE, house_style, new_figure

        with house_style():
            if ax is None:
                ax = new_figure(4.2, 2.8).subplots()
            place = self.x / self.half_width
            (pressure,) = ax.plot(place, self.pressure / 1e9, color=PALETTE[0], label="pressure")
            ax.set(
                xlabel="x over Hertz's half width",
                ylabel="pressure in GPa",
                xlim=(-2.0, 1.5),
                ylim=(0.0, None),
            )
            right = ax.twinx()
            (film,) = right.plot(place, self.film_thickness * 1e6, color=PALETTE[1], label="film")
            right.set(ylabel="film thickness in µm", ylim=(0.0, 4.0 * self.central_film_thickness * 1e6))
            right.grid(visible=False)
            ax.legend(handles=[pressure, film], loc="upper left")
        return ax.figure  # pyright: ignore[reportReturnType]  (no part of a figure)

    def __repr__(self) -> str:
        return (
            f"<tribodyn line contact: p_H {self.hertz_pressure / 1e9:.3g} GPa, central film "
            f"{self.central_film_thickness * 1e6:.4g} µm, minimum {self.minimum_film_thickness * 1e6:.4g} µm>"
        )


@in_python()
def line_contact(
    *,
    line_load: float,
    radius: float,
    entrainment_speed: float,
    sliding_speed: float = 0.0,
    viscosity: float,
    pressure_viscosity: float,
    viscosity_pressure_index: float | None = None,
    effective_modulus: float,
    compressible: bool = True,
    step: float = STEP,
    start: SolvedContact | None = None,
) -> SolvedContact:
    """Solve a lubricated line contact of smooth surfaces; SI.

    Parameters
    ----------
    line_load : float
        w, N/m.
    radius : float
        R, 1/R = 1/R_1 + 1/R_2, m.
    entrainment_speed : float
        Mean speed (u_1 + u_2)/2 of the surfaces relative to the contact, m/s.
    sliding_speed : float
        u_1 − u_2, m/s, any sign.
    viscosity : float
        η0 at ambient pressure and the inlet's temperature, Pa s.
    pressure_viscosity : float
        α, 1/Pa.
    viscosity_pressure_index : float, optional
        z of Roelands' law, ln(η/η0) = α p_r/z [(1 + p/p_r)^z − 1], p_r = 0.1962 GPa; 1: Barus' law. Default:
        the z that Roelands' own isotherm has at this η0 and α, at most 1.
    effective_modulus : float
        E', 2/E' = (1 − ν_1²)/E_1 + (1 − ν_2²)/E_2, Pa.
    compressible : bool
        Density by Dowson & Higginson; else constant.
    step : float
        Steps of the grid over the distance from inlet and end of the film.
    start : SolvedContact, optional
        Of a similar contact: its grid and its pressures are the start.

    Returns
    -------
    SolvedContact

    Raises
    ------
    InputError
        If a value is no number, or not positive where it must be.
    SimulationError
        If the equations could not be solved.
    """
    index = viscosity_pressure_index
    if index is None:
        check(
            LineContact(
                line_load, radius, entrainment_speed, Fluid(viscosity, pressure_viscosity), effective_modulus
            )
        )
        index = min(max(roelands_index(pressure_viscosity, viscosity), 1e-3), 1.0)
    fluid = Fluid(viscosity, pressure_viscosity, index, compressible)
    problem = LineContact(line_load, radius, entrainment_speed, fluid, effective_modulus, sliding_speed)
    solution = solve_steady(problem, start.solution if start is not None else None, step)
    return SolvedContact(
        x=solution.place,
        pressure=solution.pressure,
        film_thickness=solution.film_thickness,
        temperature=np.zeros_like(solution.film),
        central_film_thickness=solution.central_film_thickness,
        minimum_film_thickness=solution.minimum_film_thickness,
        friction_coefficient=newtonian_friction(solution) / line_load,
        rolling_coefficient=rolling_traction(solution).shear / line_load,
        hertz_pressure=problem.hertz_pressure,
        half_width=problem.half_width,
        moes_load=problem.moes_load,
        moes_material=problem.moes_material,
        solution=solution,
    )
