"""Ratios of every film and friction law to the solved contact, over oils, surfaces and duties of gears.

python -m tools.law_ranges            # writes the tables into docs/ehl.md: two minutes of one core

The numbers of `JudgedRange` in the laws are those that this prints.
"""

import math
import tomllib
from collections.abc import Iterator
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from tools.marked_block import DOCS, ROOT, put, table
from tribodyn.errors import SimulationError
from tribodyn.geometry.drive import MaterialData
from tribodyn.input.tables.lubricant import Lubricant, lubricant_of
from tribodyn.tribology.closure import closure, without_nominal_conditions
from tribodyn.tribology.contact import NominalConditions, Surfaces, local_contact
from tribodyn.tribology.ehl.coupled import CoupledSolution, solve_coupled
from tribodyn.tribology.ehl.of_case import contact_of
from tribodyn.tribology.ehl.problem import LineContact
from tribodyn.tribology.ehl.table import STEP
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.film.numbers import roughening
from tribodyn.tribology.friction import FRICTION_LAWS
from tribodyn.tribology.law import FilmLaw, FrictionLaw, LawInput
from tribodyn.tribology.oil import LubricantData
from tribodyn.tribology.surface_state import range_shares, surface_state

Array = Any

PAGE = DOCS / "ehl.md"
#: Pairs of teeth of the tables, and where their random numbers begin.
PAIRS, SEED = 98, 1
#: Shipped oils, and the temperatures between which one is drawn, °C; one is known at one temperature only.
OILS = {
    "iso-vg-32-mineral": (0.0, 100.0),
    "iso-vg-220-mineral": (20.0, 110.0),
    "iso-vg-460-mineral": (40.0, 120.0),
    "iso-vg-68-pao": (0.0, 110.0),
    "iso-vg-320-pao": (20.0, 120.0),
    "75w90": (10.0, 120.0),
    "liu-ni-2022": None,
}
#: Ra of each flank, m.
SURFACES = {"polished": 0.05e-6, "finely ground": 0.2e-6, "ground": 0.4e-6, "milled": 0.8e-6}
#: Case-hardened, 58 HRC.
STEEL = MaterialData("case-hardened steel", 206e9, 0.3, 7850.0, 42.0, 484.0, 6.4e9)
#: Positions of a pair along its path of contact.
POSITIONS = 4
#: What is drawn: module (m), pitch line speed (m/s), Hertz pressure at the pitch point (Pa), teeth, ratio.
MODULES, PITCH_SPEEDS, PRESSURES = (1.5e-3, 8e-3), (0.2, 20.0), (0.2e9, 2.0e9)
TEETH, RATIOS, ANGLE = (17, 45), (1.0, 4.0), math.radians(20.0)
#: Factors on what is assumed of asperities and oil, of every other pair: σβn, σ/β, Λ, τ_00, f_c.
ASSUMED = {
    "density": (0.6, 2.0),
    "slope": (0.5, 5.0),
    "limit": (0.75, 1.33),
    "floor": (0.5, 2.0),
    "rubbing": (0.8, 1.6),
}
#: Laws whose coefficient is a mean over the mesh.
MEANS = ("niemann", "schlenk", "iso-14179-1")
#: Laws without a formula of their own: tabulated from the solved contact, given, or none.
LEFT_OUT = ("solved", "coulomb", "none")


class Pair(NamedTuple):
    """Two teeth at positions along their path of contact (arrays), with oil and surfaces; SI.

    `factors` are those on `ASSUMED`, 1 where they are not `drawn`.
    """

    oil: str
    surface: str
    given: LawInput
    drawn: bool
    factors: dict[str, float]
    line_load: Array
    curvature: Array
    speeds: tuple[Array, Array]


class Ratios(NamedTuple):
    """A law over the solved contact: arrays over contacts, or over pairs for a mean coefficient.

    `judged`: inside the judged limits, or the authors' range of a law without any; `stated`: inside the
    whole range; `drawn`: with drawn constants of asperities and limiting stress, not the judge's.
    """

    ratio: Array
    judged: Array
    stated: Array
    oil: Array
    drawn: Array


def pairs(seed: int, count: int) -> Iterator[Pair]:
    """Draw pairs of standard involute teeth that carry from a fifth to all of what steel bears."""
    draw = np.random.default_rng(seed)

    def between(low: float, high: float) -> float:
        return float(math.exp(draw.uniform(math.log(low), math.log(high))))

    for number in range(count):
        oil_name = list(OILS)[number % len(OILS)]
        surface = list(SURFACES)[number // len(OILS) % len(SURFACES)]
        warmth = OILS[oil_name] and 273.15 + draw.uniform(*OILS[oil_name])
        module, ratio = between(*MODULES), draw.uniform(*RATIOS)
        radius = 0.5 * module * int(draw.integers(*TEETH))
        pressure, speed = draw.uniform(*PRESSURES), between(*PITCH_SPEEDS)
        factors = {name: between(*ends) for name, ends in ASSUMED.items()}
        drawn = number % 2 == 1
        if not drawn:
            factors = dict.fromkeys(factors, 1.0)
        oil = oil_of(oil_name, warmth)
        oil = replace(
            oil,
            limiting_shear_coefficient=oil.limiting_shear_coefficient * factors["limit"],
            asperity_friction=oil.asperity_friction * factors["rubbing"],
        )
        given = given_of(oil, SURFACES[surface])
        yield _mesh(
            Pair(oil_name, surface, given, drawn, factors, None, None, (None, None)),
            (radius, radius * ratio),
            module,
            speed,
            pressure,
        )


def oil_of(name: str, temperature: float | None) -> LubricantData:
    """Return a shipped oil at a temperature, K."""
    table = tomllib.loads((ROOT / "models" / "lubricants" / f"{name}.toml").read_text("utf-8"))
    if temperature is not None:  # the judged ranges are those of Roelands' law
        table["viscosity_law"] = {"model": "roelands"}
    return lubricant_of(Lubricant.model_validate(table), temperature)


def given_of(oil: LubricantData, mean_roughness: float) -> LawInput:
    """Return what laws are made from: steel flanks of equal Ra (m), composite σ = √π Ra."""
    heat = STEEL.density * STEEL.specific_heat
    surfaces = Surfaces(
        STEEL.youngs_modulus / (1.0 - STEEL.poisson_ratio**2),
        STEEL.hardness,
        math.sqrt(math.pi) * mean_roughness,
        mean_roughness,
        oil.inlet_viscosity,
        oil.pressure_viscosity,
        *2 * (STEEL.thermal_conductivity,),
        *2 * (heat,),
    )
    return LawInput(surfaces, oil, (STEEL, STEEL), without_nominal_conditions)


def _mesh(pair: Pair, radii: tuple[float, float], module: float, pitch_speed: float, pressure: float) -> Pair:
    """Return the pair with its loads, curvatures and speeds, and with its nominal conditions.

    Where two pairs touch, each carries half.
    """
    oil, surfaces = pair.given.lubricant, pair.given.surfaces
    arms = [radius * math.sin(ANGLE) for radius in radii]
    load = 2.0 * math.pi * pressure**2 / (surfaces.effective_modulus * sum(1.0 / arm for arm in arms))
    pinion_end, gear_end = (
        min(math.sqrt((radius + module) ** 2 - (radius * math.cos(ANGLE)) ** 2) - arm, 0.9 * other)
        for radius, arm, other in zip(radii, arms, reversed(arms), strict=True)
    )
    place = -gear_end + (np.arange(POSITIONS) + 0.5) / POSITIONS * (pinion_end + gear_end)
    pitch = math.pi * module * math.cos(ANGLE)
    alone = (place > pinion_end - pitch) & (place < pitch - gear_end)
    left, right = arms[0] + place, arms[1] - place
    nominal = NominalConditions(
        load * math.cos(ANGLE),
        *radii,
        ANGLE,
        pitch_speed / radii[0],
        1.0,
        oil.inlet_viscosity,
        oil.density,
        surfaces.mean_roughness,
        oil.load_exponent,
        oil.lubricant_factor,
        oil.schlenk_factor,
    )
    return pair._replace(
        given=pair.given._replace(nominal=lambda: nominal),
        line_load=load * np.where(alone, 1.0, 0.5),
        curvature=1.0 / left + 1.0 / right,
        speeds=(pitch_speed / radii[0] * left, pitch_speed / radii[1] * right),
    )


def solved(pair: Pair, at: int, smooth: bool) -> CoupledSolution | None:
    """Solve a contact with heat, mixed or of smooth surfaces; None: no solution was found."""
    contact, factors = contact_of(pair.given), pair.factors
    rough = contact.roughness._replace(
        density=contact.roughness.density * factors["density"],
        slope=contact.roughness.slope * factors["slope"],
    )
    rheology = contact.rheology._replace(limiting_floor=contact.rheology.limiting_floor * factors["floor"])
    speeds = [float(speed[at]) for speed in pair.speeds]
    problem = LineContact(
        float(pair.line_load[at]),
        1.0 / float(pair.curvature[at]),
        0.5 * sum(speeds),
        contact.fluid,
        contact.effective_modulus,
        speeds[0] - speeds[1],
        None if smooth else rough,
    )
    try:
        return solve_coupled(problem, rheology, contact.thermal, step=STEP)
    except SimulationError:
        return None


def solved_along(pair: Pair) -> dict[str, Array]:
    """Central films, m, of rough and smooth flanks, and friction coefficient; NaN: not solved."""
    found = {name: np.full(POSITIONS, np.nan) for name in ("film", "smooth film", "friction")}
    for at in range(POSITIONS):
        if (rough := solved(pair, at, smooth=False)) is not None:
            found["film"][at] = np.interp(0.0, rough.solution.place, rough.solution.mean_gap)
            found["friction"][at] = abs(rough.friction) / pair.line_load[at]
        if (flat := solved(pair, at, smooth=True)) is not None:
            found["smooth film"][at] = flat.solution.central_film_thickness
    return found


def ratios(seed: int, count: int) -> dict[tuple[str, str], Ratios]:
    """Return (what, law) -> law over solved contact, of as many pairs."""
    found: dict[tuple[str, str], list[tuple[Array, ...]]] = {}
    roughened: list[Array] = []
    for pair in pairs(seed, count):
        known = solved_along(pair)
        smooth, rough = np.log(known["smooth film"]), math.log(pair.given.surfaces.roughness)
        roughened.append(np.exp(smooth) * roughening(smooth, rough) / known["film"])
        entrainment, sliding = 0.5 * (pair.speeds[0] + pair.speeds[1]), pair.speeds[0] - pair.speeds[1]
        contact = local_contact(pair.line_load, pair.curvature, entrainment, sliding, *pair.speeds)
        for what, registry in (("film", FILM_LAWS), ("friction", FRICTION_LAWS)):
            for name in registry:
                if name in LEFT_OUT:
                    continue
                law = registry[name]
                inside = _by_law(law, contact, pair.given)
                against = known[what]
                rows = (inside[0] / against, *inside[1:])
                if what == "friction" and name in MEANS:
                    weight = pair.line_load * np.abs(sliding)
                    mean = np.sum(weight * inside[0]) / np.sum(weight * against)
                    rows = (np.array([mean]), *(limits[:1] for limits in inside[1:]))
                whose = np.full(len(rows[0]), pair.oil), np.full(len(rows[0]), pair.drawn)
                found.setdefault((what, name), []).append((*rows, *whose))
    factors = np.concatenate(roughened)
    print("roughening over solved, 5, 50, 95 %:", quantiles(factors[np.isfinite(factors)]))
    joined = {
        key: [np.concatenate(parts) for parts in zip(*rows, strict=True)] for key, rows in found.items()
    }
    return {key: Ratios(*(row[np.isfinite(rows[0])] for row in rows)) for key, rows in joined.items()}


def _by_law(law: FilmLaw | FrictionLaw, contact: Any, given: LawInput) -> tuple[Array, Array, Array]:
    """Film or friction coefficient; whether the judged limits hold, or the authors'; whether all hold."""
    film = law if isinstance(law, FilmLaw) else FILM_LAWS[law.film]
    friction = law if isinstance(law, FrictionLaw) else FRICTION_LAWS["none"]
    made = closure(given, film, friction)
    state = surface_state(contact, made)
    is_film = isinstance(law, FilmLaw)
    value = state.central_film_thickness if is_film else np.abs(state.friction_coefficient)
    shares = range_shares(contact, made)[0 if is_film else 1]
    shares = np.broadcast_to(shares, (POSITIONS, shares.shape[-1]))
    judged = law.judged.limits if law.judged is not None else 0
    own = shares[:, shares.shape[-1] - judged :] if judged else shares
    return np.broadcast_to(value, (POSITIONS,)), np.all(own >= 1.0, axis=1), np.all(shares >= 1.0, axis=1)


def right(law: FilmLaw | FrictionLaw, ratio: Array) -> Array:
    """Whether a law is right, by the criterion that it states."""
    assert law.judged is not None
    low, high = law.judged.right
    return (ratio >= low) & (ratio <= high)


def quantiles(ratio: Array) -> tuple[float, float, float]:
    """5, 50 and 95 %, to three digits."""
    low, median, high = (float(f"{value:.3g}") for value in np.quantile(ratio, (0.05, 0.5, 0.95)))
    return low, median, high


def tables(found: dict[tuple[str, str], Ratios]) -> str:
    """Return both tables as Markdown."""
    head = ["law", "stands for", "right", "limits by the solved contact", "contacts inside: all, those right"]
    head += [
        "ratio there: 5, 50, 95 %",
        "outside: 5, 50, 95 %",
        "right with constants of the judge, drawn",
        "right anywhere",
    ]
    head += ["anywhere: 5, 50, 95 %"]
    rows, by_oil = [], []
    for (what, name), ratios in found.items():
        law = FILM_LAWS[name] if what == "film" else FRICTION_LAWS[name]
        assert law.judged is not None
        limits = law.limits[len(law.limits) - law.judged.limits :]
        inside, outside = ratios.ratio[ratios.judged], ratios.ratio[~ratios.judged]
        low, high = law.judged.right
        stands = f"{law.thickness} film" if isinstance(law, FilmLaw) else "friction"
        stands = "mean of the mesh" if name in MEANS else stands
        cells = (
            f"{what} `{name}`",
            stands,
            f"{low:g} … {high:g}",
            ", ".join(limits) or "none found",
            f"{len(inside)} of {len(ratios.ratio)}, {_share(right(law, inside))}",
            ", ".join(f"{value:.3g}" for value in quantiles(inside)),
            ", ".join(f"{value:.3g}" for value in quantiles(outside)) if outside.size else "–",
            ", ".join(_share(right(law, ratios.ratio[ratios.judged & (ratios.drawn == d)])) for d in (0, 1)),
            _share(right(law, ratios.ratio)),
            ", ".join(f"{value:.3g}" for value in quantiles(ratios.ratio)),
        )
        rows.append(cells)
        spread = []
        for oil in OILS:
            ratio = ratios.ratio[ratios.judged & (ratios.oil == oil)]
            low, median, high = quantiles(ratio) if len(ratio) else (math.nan,) * 3
            spread.append(f"{median:.2f} ({low:.2f} … {high:.2f})" if len(ratio) > 1 else "–")
        by_oil.append([f"{what} `{name}`", *spread])
    parts = table(head, rows, "llllrlllr"), "By oil, inside the same limits (median, 5 and 95 %):"
    return "\n\n".join([*parts, table(["law", *OILS], by_oil)])


def _share(hits: Array) -> str:
    return f"{100 * np.mean(hits):.0f} %"


def main() -> None:
    text = tables(ratios(SEED, PAIRS))
    print(text)
    put(PAGE, "law-ranges", text)


if __name__ == "__main__":
    main()
