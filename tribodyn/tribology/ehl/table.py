"""The solved contact over the duty of a mesh: polynomials in the logarithms of load, speed, radius, sliding.

Contacts all over the duty are solved, mixed and with heat. Logarithms of the central film and of the friction
coefficient, and the asperities' share, are fitted by polynomials of all powers up to `DEGREE` together. A
part of the contacts is not fitted but compared: their deviation is the table's error.
"""

import io
import math
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError, SimulationError
from tribodyn.numerics.cache import alone, keep, read_kept
from tribodyn.numerics.elementary import is_jax
from tribodyn.numerics.sources import digest_of
from tribodyn.tribology.duty_range import DutyRange
from tribodyn.tribology.ehl.asperities import Roughness
from tribodyn.tribology.ehl.coupled import solve_coupled
from tribodyn.tribology.ehl.fluid import Fluid
from tribodyn.tribology.ehl.heat import Thermal
from tribodyn.tribology.ehl.problem import LineContact
from tribodyn.tribology.ehl.rheology import Rheology
from tribodyn.tribology.ehl.table_lookup import TERMS
from tribodyn.tribology.law import LawInput

Array = Any

#: Largest deviation of film and friction that a table aims at.
WANTED = 0.01
#: Contacts solved: first, more each time while the error is larger, and at most; and of these one in so many
#: is compared instead of fitted.
FIRST, MORE, MOST, COMPARED = 200, 100, 300, 6
#: Grid's step of the contacts: the film within 0.05 %, friction within 1 % where the pressure spike counts.
_STEP = 0.15


class Contact(NamedTuple):
    """What is the same in all contacts of a table; numbers alone, so that it has a hash."""

    fluid: Fluid
    effective_modulus: float
    roughness: Roughness
    rheology: Rheology
    thermal: Thermal


class Table(NamedTuple):
    """Polynomials of ln h_c (m), ln μ and asperity share over four variables, flat as lanes read it.

    `film` is the mean gap on the line of centres, which between rough surfaces is never zero. A variable is
    its logarithm less the middle of its range, over half the length of that. The errors are the deviations
    that 95 % of the compared contacts stay below.
    """

    line_load: float
    line_load_half: float
    entrainment: float
    entrainment_half: float
    curvature: float
    curvature_half: float
    slide_to_roll: float
    slide_to_roll_half: float
    film: Array
    friction: Array
    share: Array
    film_error: float
    friction_error: float
    solved: float


def table_over(contact: Contact, duty: DutyRange) -> Table:
    """Return the table, from this process, from the cache, or made.

    Raises
    ------
    SimulationError
        If too few of the contacts can be solved.
    """
    return _table(contact, duty)


@lru_cache(maxsize=16)
def _table(contact: Contact, duty: DutyRange) -> Table:
    import hashlib

    digest = hashlib.sha256(digest_of(__name__) + repr((contact, duty)).encode()).hexdigest()
    name = f"{digest}.npz"
    with alone("ehl", name):
        kept = read_kept("ehl", name)
        if kept is not None:
            with np.load(io.BytesIO(kept)) as found:
                numbers = [float(one) for one in found["numbers"]]
                film, friction, share = (np.ascontiguousarray(one) for one in found["coefficients"])
            return Table._make([*numbers[:8], film, friction, share, *numbers[8:]])
        made = _made(contact, duty)
        stream = io.BytesIO()
        numbers = np.array([*made[:8], *made[11:]])
        np.savez(stream, numbers=numbers, coefficients=np.array([made.film, made.friction, made.share]))
        keep("ehl", name, stream.getvalue())
        return made


def _made(contact: Contact, duty: DutyRange) -> Table:
    from scipy.stats import qmc

    ends = np.log(np.array(duty))
    middle, half = ends.mean(axis=1), np.maximum(0.5 * np.diff(ends, axis=1)[:, 0], 1e-6)
    box = [float(one) for pair in zip(middle, half, strict=True) for one in pair]
    sequence: Any = qmc.Sobol
    points = sequence(4, seed=1).random(1024)[:MOST] * 2.0 - 1.0
    # towards the ends of the range, where polynomials go astray first
    points = np.sin(0.5 * math.pi * points)
    values = np.full((MOST, 3), np.nan)
    solved, found = 0, None
    for count in range(FIRST, MOST + 1, MORE):
        for number in range(solved, count):
            values[number] = _solved(contact, np.exp(middle + half * points[number]))
        solved = count
        found = _fitted(box, points[:count], values[:count])
        if max(found.film_error, found.friction_error) <= WANTED:
            break
    assert found is not None
    return found


def _solved(contact: Contact, at: Array) -> Array:
    """Ln of film, ln of friction coefficient, and the asperities' share at one duty; NaN: none found."""
    line_load, entrainment, curvature, ratio = (float(one) for one in at)
    problem = LineContact(
        line_load,
        1.0 / curvature,
        entrainment,
        contact.fluid,
        contact.effective_modulus,
        ratio * entrainment,
        contact.roughness,
    )
    try:
        found = solve_coupled(problem, contact.rheology, contact.thermal, step=_STEP)
    except SimulationError:
        return np.full(3, np.nan)
    gap = np.interp(0.0, found.solution.place, found.solution.mean_gap)
    return np.array(
        [
            math.log(gap),
            math.log(max(found.friction / line_load, 1e-12)),
            found.solution.asperity_load_ratio,
        ]
    )


def _fitted(box: list[float], points: Array, values: Array) -> Table:
    good = np.all(np.isfinite(values), axis=1)
    if np.count_nonzero(good) < 1.5 * len(TERMS):
        raise SimulationError(
            f"the contact could be solved at {np.count_nonzero(good)} of {len(points)} duties only, too few "
            f"for a table; use another film and friction law"
        )
    compared = good & (np.arange(len(points)) % COMPARED == COMPARED - 1)
    used = good & ~compared
    powers = np.array([np.prod(points ** np.array(term), axis=1) for term in TERMS]).T
    # a little stiffness, so that no high power grows from noise
    stiff = np.diag(1e-5 * math.sqrt(np.count_nonzero(used)) * np.array([sum(term) for term in TERMS], float))
    system = np.concatenate([powers[used], stiff])
    right = np.concatenate([values[used], np.zeros((len(TERMS), values.shape[1]))])
    coefficients = np.linalg.lstsq(system, right, rcond=None)[0]
    deviation = np.abs(np.expm1(powers[compared] @ coefficients - values[compared]))
    film, friction, share = (np.ascontiguousarray(one) for one in coefficients.T)
    film_error, friction_error = (float(np.quantile(deviation[:, one], 0.95)) for one in (0, 1))
    solved = float(np.count_nonzero(good))
    return Table._make([*box, film, friction, share, film_error, friction_error, solved])


def contact_of(given: LawInput) -> Contact:
    """Return what all contacts of a case have in common, from its surfaces, oil and materials.

    The film slips at the oil's limiting shear stress Λ p beside `Rheology`'s floor.

    Raises
    ------
    InputError
        If a derivative by one of these numbers is asked for: a table is of one oil and one pair of surfaces.
    """
    surfaces, oil = given.surfaces, given.lubricant
    numbers = [
        *(
            oil.inlet_viscosity,
            oil.pressure_viscosity,
            oil.viscosity_pressure_index,
            surfaces.effective_modulus,
        ),
        *(
            surfaces.roughness,
            oil.asperity_friction,
            oil.limiting_shear_coefficient,
            oil.temperature_viscosity,
        ),
        *(surfaces.pinion_conductivity, surfaces.gear_conductivity),
        *(surfaces.pinion_heat_capacity, surfaces.gear_heat_capacity),
    ]
    if any(is_jax(one) for one in numbers):
        raise InputError(
            "film.law",
            '"solved"',
            "has no derivative by oil or surfaces",
            "use a law of formulas, or differences",
        )
    eta, alpha, index, modulus, height, rubbing, limit, hot, k_1, k_2, c_1, c_2 = (
        float(one) for one in numbers
    )
    return Contact(
        Fluid(eta, alpha, min(index, 1.0)),
        modulus,
        Roughness(max(height, 1e-9), friction=rubbing),
        Rheology("limiting", limiting_coefficient=limit),
        Thermal(hot, solid_conductivity=(k_1, k_2), solid_heat_capacity=(c_1, c_2)),
    )


def table_of(given: LawInput) -> Table:
    """Return the table of a case; raises as `contact_of`, `table_over` and the case's duty."""
    return table_over(contact_of(given), given.duty())
