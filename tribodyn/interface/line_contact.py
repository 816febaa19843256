"""A lubricated line contact as a function: film, pressure and friction from the equations; oils by name."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from tribodyn.errors import InputError, quoted, unknown_name
from tribodyn.input.tables.lubricant import read_lubricant
from tribodyn.interface.scenario import public
from tribodyn.tribology.ehl.coupled import solve_coupled
from tribodyn.tribology.ehl.fluid import Fluid, Rheology
from tribodyn.tribology.ehl.grid import STEP
from tribodyn.tribology.ehl.heat import HeatProperties
from tribodyn.tribology.ehl.problem import LineContact, Solution, check, positive
from tribodyn.tribology.ehl.rough import Roughness
from tribodyn.tribology.high_pressure import ContactViscosity, contact_viscosity
from tribodyn.tribology.oil import LubricantData, roelands_index
from tribodyn.tribology.pressure_law import asymptotic_coefficient


def named_oil(name: str, temperature: float | None, numbers: tuple[Any, ...]) -> LubricantData:
    """Return the lubricant at its temperature; InputError beside other numbers, or without a temperature."""
    if not isinstance(name, str):
        rule, remedy = "not the name of a lubricant", "name a shipped one, or the path of a file: oil.toml"
        raise InputError("lubricant", quoted(name), rule, remedy)
    keys = ("viscosity", "pressure_viscosity", "viscosity_pressure_index", "temperature_viscosity")
    for key, value in zip(keys, numbers, strict=True):
        if value is not None:
            raise InputError(
                key, value, f"contradicts lubricant = {quoted(name)}, which gives it", "leave it out"
            )
    if temperature is None:
        raise InputError("oil_temperature", None, "missing: the lubricant needs it", "give it in K: 353.15")
    return read_lubricant(name, positive("oil_temperature", temperature, "K"))


def fluid_of(oil: LubricantData, at: ContactViscosity, band: str) -> Fluid:
    """Return the fluid of an oil, with the best estimate or an end of its band."""
    laws = {"best": at.law, "lowest": at.lowest, "highest": at.highest}
    if band not in laws:
        raise unknown_name("viscosity_band", str(band), laws, "end of a band")
    eta, alpha = float(oil.inlet_viscosity), float(oil.pressure_viscosity)
    if (law := laws[band]) is None:
        if band != "best":
            raise InputError("viscosity_band", quoted(band), f"there is none: {at.origin}", 'write "best"')
        return Fluid(eta, alpha, min(float(oil.viscosity_pressure_index), 1.0))
    return Fluid(eta, asymptotic_coefficient(law), law=law)


if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = Any

#: α p_H above which oils are solid rather than fluid (elastic-plastic, Johnson & Tevaarwerk 1977).
SOLID = 60.0
#: Friction coefficients of lubricated steel stay below; limiting stresses of oils are 0.03 … 0.12 p.
CREDIBLE = 0.2
#: Between which steps of the grid are taken.
FINEST, COARSEST = 0.01, 1.0


@dataclass(frozen=True)
class SolvedContact:
    """A solved line contact; SI, arrays over the nodes of the film."""

    #: along the direction of entrainment, m; 0 on the line of centres. The film ends at the last, between
    #: rough surfaces before it
    x: Array
    pressure: Array  #: of fluid and asperities together, Pa
    asperity_pressure: Array  #: mean pressure of the asperities, Pa; 0 between smooth surfaces
    film_thickness: Array  #: distance of the mean planes of the surfaces, m
    temperature: Array  #: mean over the film, K above the inlet's
    surface_temperatures: Array  #: of surfaces 1 and 2, K above the inlet's; (2, nodes)
    shear_stress: Array  #: τ_m, mean over the film, Pa
    central_film_thickness: float  #: at x = 0, m
    minimum_film_thickness: float  #: m
    asperity_load_ratio: float  #: share of the load that the asperities carry
    #: ∫ τ_m + f_c p_a dx over the load, τ_m the mean shear stress over the film; of the sign of
    #: `sliding_speed`: where surface 1 is the faster one, the film holds it back and draws on surface 2.
    friction_coefficient: float
    rolling_coefficient: float  #: drag of the pressure flow on each surface over the load, ½ ∫ h dp/dx dx/w
    hertz_pressure: float  #: of the dry contact, Pa
    half_width: float  #: of the dry contact, m
    moes_load: float  #: Moes' M, with the sum of the speeds
    moes_material: float  #: Moes' L, with the sum of the speeds
    limits: tuple[str, ...]  #: what the result is not credible for; empty within the laws' usual range
    solution: Solution  #: the solution in Hertz's units, from which a similar contact can start

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
            ax.set(xlabel="x over Hertz's half width", ylabel="pressure in GPa")
            ax.set(xlim=(-2.0, 1.5), ylim=(0.0, None))
            right = ax.twinx()
            (film,) = right.plot(place, self.film_thickness * 1e6, color=PALETTE[1], label="film")
            right.set(ylabel="film thickness in µm", ylim=(0.0, 4.0 * self.central_film_thickness * 1e6))
            right.grid(visible=False)
            ax.legend(handles=[pressure, film], loc="upper left")
        return ax.figure  # pyright: ignore[reportReturnType]  (no part of a figure)

    def __repr__(self) -> str:
        return (
            f"<tribodyn line contact: p_H {self.hertz_pressure / 1e9:.3g} GPa, central film "
            f"{self.central_film_thickness * 1e6:.4g} µm, minimum {self.minimum_film_thickness * 1e6:.4g} µm"
            f"{''.join(f'; {limit}' for limit in self.limits)}>"
        )


@public
def line_contact(
    *,
    line_load: float,
    radius: float,
    entrainment_speed: float,
    sliding_speed: float = 0.0,
    viscosity: float | None = None,
    pressure_viscosity: float | None = None,
    viscosity_pressure_index: float | None = None,
    lubricant: str | None = None,
    oil_temperature: float | None = None,
    viscosity_band: str = "best",
    effective_modulus: float,
    compressible: bool = True,
    roughness: float | None = None,
    asperity_density: float = 0.05,
    asperity_slope: float = 0.01,
    asperity_friction: float = 0.12,
    rheology: str = "newtonian",
    eyring_stress: float = Rheology().eyring_stress,
    limiting_coefficient: float = Rheology().limiting_coefficient,
    limiting_floor: float = Rheology().limiting_floor,
    carreau_modulus: float = Rheology().carreau_modulus,
    carreau_index: float = Rheology().carreau_index,
    temperature_viscosity: float | None = None,
    oil_conductivity: float = 0.14,
    oil_heat_capacity: float = 1.7e6,
    solid_conductivity: tuple[float, float] = (46.0, 46.0),
    solid_heat_capacity: tuple[float, float] = (3.6e6, 3.6e6),
    step: float = STEP,
    start: SolvedContact | None = None,
) -> SolvedContact:
    """Solve a lubricated line contact; SI.

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
    viscosity : float, optional
        η0 at ambient pressure and the inlet's temperature, Pa s. This and the next, or a lubricant.
    pressure_viscosity : float, optional
        α, 1/Pa.
    viscosity_pressure_index : float, optional
        z of Roelands' law, ln(η/η0) = α p_r/z [(1 + p/p_r)^z − 1], p_r = 0.1962 GPa; 1: Barus' law. Default:
        the z that Roelands' own isotherm has at this η0 and α, at most 1.
    lubricant : str, optional
        Name of a shipped lubricant that has a data sheet, or its file: it gives viscosity, its slope over the
        temperature and its rise with pressure, in place of `viscosity`, `pressure_viscosity`,
        `viscosity_pressure_index` and `temperature_viscosity`; the contact is solved with heat.
    oil_temperature : float, optional
        Of the lubricant at the inlet, K.
    viscosity_band : {"best", "lowest", "highest"}
        Of a lubricant whose viscosity at high pressure is estimated by its type: the best estimate, or an end
        of what measured oils of the type span.
    effective_modulus : float
        E', 2/E' = (1 − ν_1²)/E_1 + (1 − ν_2²)/E_2, Pa.
    compressible : bool
        Density by Dowson & Higginson; else constant.
    roughness : float, optional
        σ, rms of both surfaces together, m. Default: smooth surfaces.
    asperity_density, asperity_slope : float
        σ β n and σ/β of Greenwood & Tripp's asperities: height, radius β and number per area n.
    asperity_friction : float
        Friction coefficient f_c of the asperities.
    rheology : {"newtonian", "eyring", "limiting", "carreau"}
        Law of shear; a Newtonian fluid gives no credible friction where α p exceeds ten.
    eyring_stress : float
        τ_0 of γ' = τ_0/η sinh(τ/τ_0), Pa.
    limiting_coefficient, limiting_floor : float
        Λ and τ_00 (Pa) of the limiting shear stress τ_00 + Λ p.
    carreau_modulus, carreau_index : float
        G (Pa) and n of τ = η γ' [1 + (η γ'/G)²]^((n − 1)/2).
    temperature_viscosity : float, optional
        K_T = −d ln η/dT at ambient pressure, 1/K. Default: an isothermal contact.
    oil_conductivity, oil_heat_capacity : float
        W/(m K), and J/(m³ K) per volume; of mineral oil by default.
    solid_conductivity, solid_heat_capacity : (float, float)
        Of surfaces 1 and 2, W/(m K) and J/(m³ K) per volume; of steel by default.
    step : float
        Steps of the grid over the distance from inlet and end of the film, 0.01 … 1.
    start : SolvedContact, optional
        Of a similar contact, as rough or as smooth: its grid and its pressures are the start.

    Returns
    -------
    SolvedContact

    Raises
    ------
    InputError
        If a value is no number, or not positive where it must be, or if the contact is wider than its
        cylinders.
    SimulationError
        If the equations could not be solved.
    """
    _check_options(compressible, step, start, roughness)
    at_pressure: ContactViscosity | None = None
    if lubricant is not None:
        numbers = viscosity, pressure_viscosity, viscosity_pressure_index, temperature_viscosity
        oil = named_oil(lubricant, oil_temperature, numbers)
        at_pressure = contact_viscosity(oil)
        fluid = fluid_of(oil, at_pressure, viscosity_band)._replace(compressible=compressible)
        temperature_viscosity = float(oil.temperature_viscosity)
    else:
        if oil_temperature is not None or viscosity_band != "best":
            key = "viscosity_band" if oil_temperature is None else "oil_temperature"
            raise InputError(
                key, None, "has no effect without a lubricant", "leave it out, or name a lubricant"
            )
        # what is missing is refused by the check as no number
        alpha: Any = pressure_viscosity
        fluid = Fluid(viscosity, alpha)  # pyright: ignore[reportArgumentType]
        check(LineContact(line_load, radius, entrainment_speed, fluid, effective_modulus))
        index = viscosity_pressure_index
        if index is None:
            index = min(max(float(roelands_index(alpha, viscosity)), 1e-3), 1.0)
        fluid = fluid._replace(viscosity_pressure_index=index, compressible=compressible)
    rough = None
    if roughness is not None:
        rough = Roughness(roughness, asperity_density, asperity_slope, asperity_friction)
    problem = LineContact(
        line_load, radius, entrainment_speed, fluid, effective_modulus, sliding_speed, rough
    )
    shear = Rheology(
        rheology, eyring_stress, limiting_coefficient, limiting_floor, carreau_modulus, carreau_index
    )
    thermal = None
    if temperature_viscosity is not None:
        thermal = HeatProperties(
            temperature_viscosity,
            oil_conductivity,
            oil_heat_capacity,
            _pair(solid_conductivity),
            _pair(solid_heat_capacity),
        )
    solved = solve_coupled(problem, shear, thermal, start.solution if start is not None else None, step)
    solution, heat = solved.solution, solved.heat
    cold = np.zeros_like(solution.film)
    return SolvedContact(
        x=solution.place,
        pressure=solution.pressure,
        asperity_pressure=solution.asperity_pressure,
        film_thickness=solution.film_thickness,
        temperature=solved.temperature,
        surface_temperatures=np.array([heat.surface_1, heat.surface_2] if heat is not None else [cold, cold]),
        shear_stress=solved.shear.stress,
        central_film_thickness=solution.central_film_thickness,
        minimum_film_thickness=solution.minimum_film_thickness,
        asperity_load_ratio=solution.asperity_load_ratio,
        friction_coefficient=solved.friction / line_load,
        rolling_coefficient=solution.rolling_drag / line_load,
        hertz_pressure=problem.hertz_pressure,
        half_width=problem.half_width,
        moes_load=problem.moes_load,
        moes_material=problem.moes_material,
        limits=(
            *_limits(problem, shear, abs(solved.friction) / line_load),
            *(at_pressure.limits(problem.hertz_pressure, oil_temperature) if at_pressure is not None else ()),
        ),
        solution=solution,
    )


def _check_options(compressible: Any, step: Any, start: Any, roughness: Any) -> None:
    """Raise InputError at what is no switch, no step and no start."""
    if not isinstance(compressible, bool):
        raise InputError("compressible", quoted(compressible), "is neither True nor False", "write either")
    if not FINEST <= positive("step", step) <= COARSEST:
        raise InputError("step", step, f"is not {FINEST:g} … {COARSEST:g}", f"0.05 is fine, {STEP:g} usual")
    if start is None:
        return
    if not isinstance(start, SolvedContact):
        raise InputError("start", quoted(start), "is no solved contact", "give what td.line_contact returned")
    if (start.solution.problem.roughness is None) != (roughness is None):
        raise InputError("start", None, "one contact is rough, the other smooth", "start without it")


def _pair(value: Any) -> Any:
    return tuple(value) if isinstance(value, (list, np.ndarray)) else value


def _limits(problem: LineContact, rheology: Rheology, friction: float) -> tuple[str, ...]:
    """Say where oils do not follow the laws used."""
    limits = []
    exponent = problem.fluid.pressure_viscosity * problem.hertz_pressure
    if exponent > SOLID:
        limits.append(
            f"α p_H {exponent:.0f} is above {SOLID:g}: an oil so stiff is a solid, whose film and friction "
            f"are extrapolated"
        )
    if friction > CREDIBLE and rheology.law != "limiting":
        limits.append(
            f'the "{rheology.law}" film bears more shear than any oil: friction coefficient {friction:.3g} '
            f'above {CREDIBLE:g}; rheology="limiting" bounds it'
        )
    return tuple(limits)
