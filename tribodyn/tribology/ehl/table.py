"""The solved contact over the duty of a mesh: polynomials in the logarithms of load, speed, radius, sliding.

Contacts all over the duty are solved, mixed and with heat, by one process per core. Fitted by polynomials of
the powers `TERMS` are the logarithm of the central film, the asperities' share, and of the film's friction
coefficient μ_f below that at the limiting stress, μ_l, ln(μ_f/(μ_l − μ_f)), which is nearly even in all
variables. A part of the contacts is not fitted but compared: their deviation is the table's error.
"""

import hashlib
import math
import pickle
import sys
from contextlib import suppress
from functools import lru_cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.numerics.files.cache import arrays_kept_or_made
from tribodyn.numerics.files.sources import digest_of
from tribodyn.numerics.processes import child
from tribodyn.numerics.processes.work import foretell, part, steps, usable_cores
from tribodyn.numerics.shapes import Array
from tribodyn.tribology.contact import DUTY_LOADS, DutyRange, hertz_half_width
from tribodyn.tribology.ehl.coupled import solve_coupled
from tribodyn.tribology.ehl.lookup import TERMS, mixed_friction, most_of_film
from tribodyn.tribology.ehl.of_case import Contact, contact_of, friction_band
from tribodyn.tribology.ehl.problem import LineContact
from tribodyn.tribology.law import LawInput

if TYPE_CHECKING:
    import subprocess

#: Where solved contacts lie in the cache.
CACHE = "ehl"
#: Grid's step of the contacts: the film within 0.05 %, friction within 1.5 % where pressures are low.
STEP = 0.12
#: Of the contacts along a path one in so many is spread over the whole box, so that no polynomial goes astray
#: beside the path.
BOXED = 6
#: Departures from the path that vibrations make: of ln curvature and of ln slide-to-roll ratio.
_BESIDE = (0.02, 0.1)
#: Contacts that a process of its own is worth; places along a path that the band of friction is taken over.
_WORTH, _BAND = 40, 5


def spread(duty: DutyRange, count: int) -> tuple[Array, Array]:
    """Return duties (count, 4), logarithms as in `DutyRange`, and whether each lies along the path.

    Along a path, curvature and slide-to-roll ratio belong together, and entrainment with both up to the
    speed: the contacts crowd there, with every load and speed of the range. They alone may be compared.
    """
    from scipy.stats import qmc

    sequence: Any = qmc.Sobol
    points = sequence(6, seed=1).random(2 ** max(count - 1, 1).bit_length())[:count]
    # towards the ends of each range, where polynomials go astray first
    ended = 0.5 - 0.5 * np.cos(math.pi * points)
    ends = np.log(np.array(duty[:4]))
    low, width = ends[:, 0], np.diff(ends, axis=1)[:, 0]
    duties = low + width * ended[:, :4]
    if not duty.places:
        return duties, np.ones(count, dtype=bool)
    along = np.arange(count) % BOXED != 0
    path = np.log(np.maximum(np.array(duty.places), [0.0, 0.0, duty.slide_to_roll[0]]))
    step = np.diff(path, axis=0) / np.maximum(width[1:], 1e-6)
    way = np.concatenate([[0.0], np.cumsum(np.sqrt(np.sum(step * step, axis=1)))])
    place = ended[:, 1] * way[-1]
    on_path = np.stack([np.interp(place, way, values) for values in path.T], axis=1)
    slowest, fastest = ends[1] - np.array([path[:, 0].min(), path[:, 0].max()])
    offset = (2.0 * points[:, 4:] - 1.0) * _BESIDE
    on_path += np.column_stack([slowest + (fastest - slowest) * ended[:, 2], offset])
    duties[along, 1:] = on_path[along]
    return np.clip(duties, ends[:, 0], ends[:, 1]), along


def solve_one(contact: Contact, duty: Array, step: float = STEP) -> Array:
    """Ln of film, ln of friction coefficient, and the asperities' share at a duty; NaN: none found."""
    line_load, speed, curvature, ratio = map(math.exp, duty)
    fluid, modulus, roughness, *_ = contact
    problem = LineContact(line_load, 1.0 / curvature, speed, fluid, modulus, ratio * speed, roughness)
    try:
        coupled = solve_coupled(problem, contact.rheology, contact.thermal, step=step)
    except SimulationError:
        return np.full(3, np.nan)
    gap = np.interp(0.0, coupled.solution.place, coupled.solution.mean_gap)
    friction = max(coupled.friction / line_load, 1e-12)
    return np.array([math.log(gap), math.log(friction), coupled.solution.asperity_load_ratio])


def solve_all(contact: Contact, duties: Array) -> Array:
    """Return `solve_one` of each duty, (count, 3), by this process and one more per further core."""
    workers = max(1, min(usable_cores(), len(duties) // _WORTH))
    values = np.full((len(duties), 3), np.nan)
    others = [_begun(contact, duties[number::workers]) for number in range(1, workers)]
    try:
        for at in steps(range(0, len(duties), workers)):
            values[at] = solve_one(contact, duties[at])
        for number, process in enumerate(others, start=1):
            solutions = _answer(process)
            rows = range(number, len(duties), workers)
            if solutions is None:  # it could not be begun, or was killed
                solutions = [solve_one(contact, duties[row]) for row in rows]
            values[rows] = solutions
    except KeyboardInterrupt as error:
        error.add_note("nothing is kept of the table of solved contacts, the same call solves them anew")
        raise
    finally:
        for process in others:
            if process is not None:
                child.end(process)
    return values


def _begun(contact: Contact, duties: Array) -> "subprocess.Popen[bytes] | None":
    with suppress(OSError):
        process = child.start(f"{__name__}:serve")
        with suppress(OSError):
            child.tell(process, pickle.dumps((contact, duties)))
        return process
    return None


def _answer(process: "subprocess.Popen[bytes] | None") -> Array | None:
    if process is None:
        return None
    assert process.stdout is not None
    answer = process.stdout.read()
    return pickle.loads(answer) if process.wait() == 0 else None


def serve() -> None:
    """Solve what comes in, pickled, and write the solutions; in a child process."""
    contact, duties = pickle.load(sys.stdin.buffer)
    values = np.array([solve_one(contact, duty) for duty in duties])
    pickle.dump(values, sys.stdout.buffer)


#: Deviation of film and friction that a table aims at, of 95 % of the compared contacts.
WANTED = 0.01
#: Contacts solved: first, more each time while the error is larger, and at most; and of these one in so many
#: is compared instead of fitted.
FIRST, MORE, MOST, COMPARED = 240, 120, 600, 6
#: What a contact takes, s of one core, mixed and with heat.
A_CONTACT = 0.12
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
    #: friction_low, friction_high: factors on the friction coefficient, of the band of an estimated viscosity
    friction_low: float = 1.0
    friction_high: float = 1.0
    #: whether the viscosity at high pressure is no estimate, 1 or 0; pressure up to which it was measured,
    #: Pa; share of the temperatures' limit, at least 1 inside
    measured: float = 1.0
    pressure_limit: float = math.inf
    temperature_share: float = 1.0


@lru_cache(maxsize=16)
def table_over(contact: Contact, duty: DutyRange) -> ContactTable:
    """Return the table, from this process, from the cache, or made.

    Raises SimulationError if too few of the contacts can be solved.
    """
    digest = hashlib.sha256(digest_of(__name__) + repr((contact, duty)).encode()).hexdigest()
    fit = lambda: _made(contact, duty)._asdict()  # noqa: E731
    arrays = arrays_kept_or_made(CACHE, digest, fit)
    values: dict[str, Any] = {name: value if value.ndim else float(value) for name, value in arrays.items()}
    return ContactTable(**values)


def _made(contact: Contact, duty: DutyRange) -> ContactTable:
    ends = np.log(np.array(duty[:4]))
    middle, half = ends.mean(axis=1), np.maximum(0.5 * np.diff(ends, axis=1)[:, 0], 1e-6)
    duties, along = spread(duty, MOST)
    values = np.zeros((0, 3))
    table = None
    foretell(
        f"solves {FIRST} to {MOST} contacts of the teeth, once, at about {A_CONTACT:g} s of one core each"
    )
    for count in range(FIRST, MOST + 1, MORE):
        with part(len(values) / MOST, count / MOST):
            values = np.concatenate([values, solve_all(contact, duties[len(values) : count])])
        table = _fitted(contact, (middle, half), duties[:count], values, along[:count])
        if max(table.film_error, table.friction_error) <= WANTED:
            break
    assert table is not None
    low, high = friction_band(contact, _along(duty))
    return table._replace(friction_low=low, friction_high=high)


def _along(duty: DutyRange) -> list[tuple[float, float, float, float]]:
    """Line load, entrainment, radius and sliding speed along a path, at its highest nominal load."""
    whole = duty.line_load[1] / DUTY_LOADS[1]
    middle = [tuple(math.sqrt(low * high) for low, high in duty[1:4])]
    places = duty.places[:: max(1, len(duty.places) // _BAND)] or middle
    return [(whole, speed, 1.0 / curvature, ratio * speed) for speed, curvature, ratio in places]


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
        _solved(powers[used], quantity[used], counts[used])
        for quantity, counts in ((film, same), (saturation, weight), (share, same))
    ]
    by_film, by_saturation, by_share = (powers @ quantity for quantity in coefficients)
    mixed = mixed_friction(by_saturation, np.clip(by_share, 0.0, 1.0), most, rubbing)
    deviations = np.abs(np.expm1(by_film - film)), np.abs(mixed * np.exp(-friction) - 1.0)
    errors = (float(np.quantile(deviation[compared], 0.95)) for deviation in deviations)
    numbers = [float(number) for pair in zip(*box, strict=True) for number in pair]
    return ContactTable._make(
        [
            *(*numbers, *coefficients, limit, floor, rubbing, *errors, float(np.count_nonzero(good))),
            *(1.0, 1.0, *contact.viscosity_limits),
        ]
    )


def _solved(powers: Array, values: Array, weight: Array) -> Array:
    # a little stiffness, so that no high power grows from noise
    stiff = np.diag(_STIFFNESS * np.sqrt(len(values)) * np.array([sum(term) for term in TERMS], float))
    system = np.concatenate([powers * weight[:, None], stiff])
    right = np.concatenate([values * weight, np.zeros(len(TERMS))])
    return np.ascontiguousarray(np.linalg.lstsq(system, right, rcond=None)[0])


def table_of(inputs: LawInput) -> ContactTable:
    """Return the table of a case; raises as `contact_of`, `table_over` and the case's duty."""
    return table_over(contact_of(inputs), inputs.duty())
