"""The solved contact over the duty of a mesh: polynomials in the logarithms of load, speed, radius, sliding.

Contacts all over the duty are solved, mixed and with heat. Fitted by polynomials of the powers `TERMS` are
the logarithm of the central film, the asperities' share, and of the film's friction coefficient μ_f below
that at the limiting stress, μ_l, ln(μ_f/(μ_l − μ_f)), which is nearly even in all variables. A part of the
contacts is not fitted but compared: their deviation is the table's error.
"""

import hashlib
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError, SimulationError
from tribodyn.numerics.cache import arrays_kept_or_made
from tribodyn.numerics.elementary import is_jax
from tribodyn.numerics.shapes import Array
from tribodyn.numerics.sources import digest_of
from tribodyn.tribology.contact import DutyRange, hertz_half_width
from tribodyn.tribology.ehl.fluid import Fluid, Rheology
from tribodyn.tribology.ehl.heat import HeatProperties
from tribodyn.tribology.ehl.lookup import TERMS, mixed_friction, most_of_film
from tribodyn.tribology.ehl.points import Contact, solve_all, spread
from tribodyn.tribology.ehl.rough import Roughness
from tribodyn.tribology.law import LawInput

#: Deviation of film and friction that a table aims at, of 95 % of the compared contacts.
WANTED = 0.01
#: Contacts solved: first, more each time while the error is larger, and at most; and of these one in so many
#: is compared instead of fitted.
FIRST, MORE, MOST, COMPARED = 240, 120, 600, 6
#: Stiffness of the polynomials: what a coefficient counts beside a deviation of all contacts.
_STIFFNESS = 3e-5


class ContactTable(NamedTuple):
    """Polynomials of ln h_c (m), friction and asperity share over four variables, flat as lanes read it.

    `film` is the mean gap on the line of centres, which between rough surfaces is never zero; `friction` the
    first argument of `mixed_friction`, `rubbing` its last, `limit` and `floor` Λ and τ_00 (Pa). A variable
    is its logarithm less the middle of its range, over half the length of that. The errors are the
    deviations that 95 % of the compared contacts stay below; `solved` counts all contacts.
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
    limit: float
    floor: float
    rubbing: float
    film_error: float
    friction_error: float
    solved: float


def table_over(contact: Contact, duty: DutyRange) -> ContactTable:
    """Return the table, from this process, from the cache, or made.

    Raises
    ------
    SimulationError
        If too few of the contacts can be solved.
    """
    return _table(contact, duty)


@lru_cache(maxsize=16)
def _table(contact: Contact, duty: DutyRange) -> ContactTable:
    digest = hashlib.sha256(digest_of(__name__) + repr((contact, duty)).encode()).hexdigest()
    made = lambda: _made(contact, duty)._asdict()  # noqa: E731
    found = arrays_kept_or_made("ehl", digest, made)
    values: dict[str, Any] = {name: value if value.ndim else float(value) for name, value in found.items()}
    return ContactTable(**values)


def _made(contact: Contact, duty: DutyRange) -> ContactTable:
    ends = np.log(np.array(duty[:4]))
    middle, half = ends.mean(axis=1), np.maximum(0.5 * np.diff(ends, axis=1)[:, 0], 1e-6)
    duties, along = spread(duty, MOST)
    values = np.zeros((0, 3))
    found = None
    for count in range(FIRST, MOST + 1, MORE):
        values = np.concatenate([values, solve_all(contact, duties[len(values) : count])])
        found = _fitted(contact, (middle, half), duties[:count], values, along[:count])
        if max(found.film_error, found.friction_error) <= WANTED:
            break
    assert found is not None
    return found


def _fitted(
    contact: Contact, box: tuple[Array, Array], duties: Array, values: Array, along: Array
) -> ContactTable:
    good = np.all(np.isfinite(values), axis=1)
    number = np.arange(len(duties))
    # the comparison goes on with those that are compared already as contacts are added
    compared = good & along & (number % COMPARED == COMPARED - 1)
    used = good & ~compared
    if np.count_nonzero(used) < 1.5 * len(TERMS):
        raise SimulationError(
            f"the contact could be solved at {np.count_nonzero(good)} of {len(duties)} duties only, too few "
            f"for a table; use another film and friction law"
        )
    limit, floor = contact.rheology.limiting_coefficient, contact.rheology.limiting_floor
    rubbing = contact.roughness.friction
    load, curvature = np.exp(duties[:, 0]), np.exp(duties[:, 2])
    most = most_of_film(load, hertz_half_width(load, curvature, contact.effective_modulus), limit, floor)
    film, friction, share = np.where(good[:, None], values, 0.5).T
    sheared = np.exp(friction) - rubbing * share
    part = np.clip(sheared / np.maximum((1.0 - share) * most, 1e-12), 1e-6, 1.0 - 1e-6)
    saturation = np.log(part / (1.0 - part))
    # what a deviation of the saturation makes of the whole coefficient
    weight = np.clip(sheared * np.exp(-friction) * (1.0 - part), 0.02, 1.0)
    place = (duties - box[0]) / box[1]
    powers = np.array([np.prod(place ** np.array(term), axis=1) for term in TERMS]).T
    same = np.ones_like(film)
    coefficients = [
        _solved(powers[used], known[used], counts[used])
        for known, counts in ((film, same), (saturation, weight), (share, same))
    ]
    by_film, by_saturation, by_share = (powers @ known for known in coefficients)
    mixed = mixed_friction(by_saturation, np.clip(by_share, 0.0, 1.0), most, rubbing)
    deviations = np.abs(np.expm1(by_film - film)), np.abs(mixed * np.exp(-friction) - 1.0)
    errors = (float(np.quantile(deviation[compared], 0.95)) for deviation in deviations)
    numbers = [float(number) for pair in zip(*box, strict=True) for number in pair]
    return ContactTable._make(
        [*numbers, *coefficients, limit, floor, rubbing, *errors, float(np.count_nonzero(good))]
    )


def _solved(powers: Array, known: Array, weight: Array) -> Array:
    # a little stiffness, so that no high power grows from noise
    stiff = np.diag(_STIFFNESS * np.sqrt(len(known)) * np.array([sum(term) for term in TERMS], float))
    system = np.concatenate([powers * weight[:, None], stiff])
    right = np.concatenate([known * weight, np.zeros(len(TERMS))])
    return np.ascontiguousarray(np.linalg.lstsq(system, right, rcond=None)[0])


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
    if any(is_jax(number) for number in numbers):
        raise InputError(
            "film.law",
            '"solved"',
            "has no derivative by oil or surfaces",
            "use a law of formulas, or differences",
        )
    eta, alpha, index, modulus, height, rubbing, limit, hot, k_1, k_2, c_1, c_2 = (
        float(number) for number in numbers
    )
    return Contact(
        Fluid(eta, alpha, min(index, 1.0)),
        modulus,
        Roughness(max(height, 1e-9), friction=rubbing),
        Rheology("limiting", limiting_coefficient=limit),
        HeatProperties(hot, solid_conductivity=(k_1, k_2), solid_heat_capacity=(c_1, c_2)),
    )


def table_of(given: LawInput) -> ContactTable:
    """Return the table of a case; raises as `contact_of`, `table_over` and the case's duty."""
    return table_over(contact_of(given), given.duty())
