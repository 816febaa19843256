"""Contacts of a table: over which duties they are spread, and their solutions, one process per core."""

import math
import pickle
import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from tribodyn.errors import SimulationError
from tribodyn.numerics import child
from tribodyn.numerics.shapes import Array
from tribodyn.numerics.work import steps, usable_cores
from tribodyn.tribology.contact import DutyRange
from tribodyn.tribology.ehl.coupled import solve_coupled
from tribodyn.tribology.ehl.fluid import Fluid, Rheology
from tribodyn.tribology.ehl.heat import HeatProperties
from tribodyn.tribology.ehl.problem import LineContact
from tribodyn.tribology.ehl.rough import Roughness

if TYPE_CHECKING:
    import subprocess

#: Grid's step of the contacts: the film within 0.05 %, friction within 1.5 % where pressures are low.
STEP = 0.12
#: Of the contacts along a path one in so many is spread over the whole box, so that no polynomial goes astray
#: beside the path.
BOXED = 6
#: Departures from the path that vibrations make: of ln curvature and of ln slide-to-roll ratio.
_BESIDE = (0.02, 0.1)
#: Contacts that a process of its own is worth.
_WORTH = 40


class Contact(NamedTuple):
    """What is the same in all contacts of a table; numbers alone, so that it has a hash."""

    fluid: Fluid
    effective_modulus: float
    roughness: Roughness
    rheology: Rheology
    thermal: HeatProperties


def spread(duty: DutyRange, count: int) -> tuple[Array, Array]:
    """Return duties, and whether each lies along the path of contact.

    Along a path, curvature and slide-to-roll ratio belong together, and entrainment with both up to the
    speed: the contacts crowd there, with every load and speed of the range.

    Returns
    -------
    array, (count, 4)
        Logarithms of line load, entrainment, curvature and slide-to-roll ratio, as in `DutyRange`.
    array, (count,)
        Whether it may be compared.
    """
    from scipy.stats import qmc

    sequence: Any = qmc.Sobol
    power = max(count - 1, 1).bit_length()
    points = sequence(6, seed=1).random(2**power)[:count]
    # towards the ends of each range, where polynomials go astray first
    ended = 0.5 - 0.5 * np.cos(math.pi * points)
    ends = np.log(np.array(duty[:4]))
    low, width = ends[:, 0], np.diff(ends, axis=1)[:, 0]
    found = low + width * ended[:, :4]
    if not duty.places:
        return found, np.ones(count, dtype=bool)
    along = np.arange(count) % BOXED != 0
    path = np.log(np.maximum(np.array(duty.places), [0.0, 0.0, duty.slide_to_roll[0]]))
    step = np.diff(path, axis=0) / np.maximum(width[1:], 1e-6)
    way = np.concatenate([[0.0], np.cumsum(np.sqrt(np.sum(step * step, axis=1)))])
    place = ended[:, 1] * way[-1]
    on_path = np.stack([np.interp(place, way, values) for values in path.T], axis=1)
    slowest, fastest = ends[1] - np.array([path[:, 0].min(), path[:, 0].max()])
    beside = (2.0 * points[:, 4:] - 1.0) * _BESIDE
    on_path += np.column_stack([slowest + (fastest - slowest) * ended[:, 2], beside])
    found[along, 1:] = on_path[along]
    return np.clip(found, ends[:, 0], ends[:, 1]), along


def solve_one(contact: Contact, duty: Array) -> Array:
    """Ln of film, ln of friction coefficient, and the asperities' share at a duty; NaN: none found."""
    line_load, entrainment, curvature, ratio = map(math.exp, duty)
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
        found = solve_coupled(problem, contact.rheology, contact.thermal, step=STEP)
    except SimulationError:
        return np.full(3, np.nan)
    gap = np.interp(0.0, found.solution.place, found.solution.mean_gap)
    friction = max(found.friction / line_load, 1e-12)
    return np.array([math.log(gap), math.log(friction), found.solution.asperity_load_ratio])


def solve_all(contact: Contact, duties: Array) -> Array:
    """Return `solve_one` of each duty, (count, 3), by this process and one more per further core."""
    workers = max(1, min(usable_cores(), len(duties) // _WORTH))
    values = np.full((len(duties), 3), np.nan)
    others = [_begun(contact, duties[number::workers]) for number in range(1, workers)]
    try:
        for at in steps(range(0, len(duties), workers)):
            values[at] = solve_one(contact, duties[at])
        for number, process in enumerate(others, start=1):
            known = _answer(process)
            rows = range(number, len(duties), workers)
            if known is None:  # it could not be begun, or was killed
                known = [solve_one(contact, duties[row]) for row in rows]
            values[rows] = known
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
