"""Explicit or stiff: an estimate of the steps that an explicit method needs for stability, and the choice."""

from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import DRIVE_SPEED, SLIDING_DYNAMIC, SLIDING_KINEMATIC, Model
from tribodyn.mesh.cycle import CHANNELS
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.initial import accelerations
from tribodyn.solve.methods import AUTO, EXPLICIT, IN_TIME, IN_TIME_STIFF, STIFF, SWITCHING
from tribodyn.solve.tolerances import state_scales
from tribodyn.train.clutches import friction_torque
from tribodyn.train.schedule import intervals, place_of

_DISTANCE = CHANNELS.index("signed_distance")
#: Explicit steps per mesh cycle, by stability alone, above which the stiff solver is the cheaper one, with
#: the nominal sliding velocity and with the vibration's; measured on the CRC drive at rtol 1e-6.
STIFF_ABOVE = {SLIDING_KINEMATIC: 5000, SLIDING_DYNAMIC: 10000}
#: The same of runs by time, whose stiff solver is SciPy's: on the shipped run-up at 1 rad/s, with 63 000
#: steps, it takes 16 times as long; half of what `solver.max_steps` allows by default.
STIFF_IN_TIME = 500_000
#: The same for switching between both within the mesh cycle: with the vibration's sliding flanks stick, for
#: longer than the state at the start can tell, so that the estimate is too low.
SWITCHING_ABOVE = {SLIDING_KINEMATIC: float("inf"), SLIDING_DYNAMIC: 100}
#: Stability limit of Dormand-Prince 5(4) on the negative real axis.
REAL_STABILITY = 3.3
#: Reference cycles of the common period that are looked at, evenly spread, where it has more.
CYCLES = 8
#: Phases in each reference cycle at which the Jacobian is evaluated, and at least in each of its intervals;
#: intervals at most; phases evaluated at a time.
PHASES, LEAST, SEGMENTS, AT_A_TIME = 18, 2, 96, 32
#: Places about that where the friction of a pair reverses, over the width of reversal: that alone, and where
#: the spectral radius is this many times its median.
PITCH_POINT, REVERSAL, STEEP = np.zeros(1), np.linspace(-1.5, 1.5, 13), 2.0
#: Digits of the phase in which places differ: equal meshes reverse together.
DIGITS = 9
#: Difference of a state over its scale.
SHARE = 1e-4


class Choice(NamedTuple):
    """A method and the reason for it."""

    method: str
    reason: str


def stability_steps(model: Model, state: Float[Array, " state"]) -> float:
    """Steps per mesh cycle that an explicit method needs for stability at nominal speed.

    The spectral radius of the mechanics' Jacobian over the stability limit, integrated over the phase; it is
    sampled finely about the pitch points, where friction reverses, if it is far above the usual there.
    Clutches count as they will close.
    """
    state = state.copy()
    state[model.layout.half + model.layout.lag] = 0.0
    cycles, radius = _spectral_radii(model, state, PITCH_POINT)
    if np.max(radius) > STEEP * np.median(radius):
        cycles, radius = _spectral_radii(model, state, REVERSAL)
    whole = float(np.sum(0.5 * np.diff(cycles) * (radius[1:] + radius[:-1])))
    return max(whole / float(cycles[-1] - cycles[0]) / REAL_STABILITY, _closing_steps(model))


def _closing_steps(model: Model) -> float:
    """Steps per mesh cycle for stability of the clutch that closes most stiffly, over all of the run."""
    layout, operation, clutches = model.layout, model.operation, model.operation.clutches
    rates = [0.0]
    for c, ends in enumerate(zip(layout.clutch_first, layout.clutch_second, strict=True)):
        largest = float(np.max(np.asarray(clutches.capacity)[c]))
        slope = float(friction_torque(0.0, largest, c, clutches)[1])
        held = model.options.drive == DRIVE_SPEED  # the reference, which then has no inertia
        inertias = [
            float(model.bodies.inertia[body]) for body in ends if body > 0 or (body == 0 and not held)
        ]
        rates.append(slope * sum(1.0 / inertia for inertia in inertias))
    return max(rates) * float(operation.pitch_angle) / float(operation.nominal_speed) / REAL_STABILITY


def _spectral_radii(
    model: Model, state: Float[Array, " state"], about: Float[Array, " place"]
) -> tuple[Float[Array, " place"], Float[Array, " place"]]:
    """Spectral radii of the Jacobian (forward differences) at `_places`, and the cycles before these."""
    cycles, phases, numbers = _places(model, about)
    mechanical = model.layout.mechanical
    scale = state_scales(model, state)[:mechanical]
    moved = np.tile(state, (1 + mechanical, 1))
    moved[1:, :mechanical] += SHARE * np.diag(scale)
    parts = []
    for first in range(0, len(phases), AT_A_TIME):
        some = slice(first, first + AT_A_TIME)
        shape = (len(phases[some]), *moved.shape)
        rates = accelerations(np.broadcast_to(moved, shape), phases[some, None], numbers[some, None], model)
        change = (rates[:, 1:] - rates[:, :1])[..., :mechanical]
        jacobians = np.swapaxes(change / (SHARE * scale[:, None]), 1, 2)
        parts.append(np.max(np.abs(np.linalg.eigvals(jacobians)), axis=1))
    return cycles, np.concatenate(parts)


def _places(
    model: Model, about: Float[Array, " place"]
) -> tuple[Float[Array, " place"], Float[Array, " place"], Int[Array, " place"]]:
    """Places over the cycles looked at, put one behind the other: cycles, phases in them, and intervals.

    Among them those about the pitch points, in widths of reversal.
    """
    schedule = model.schedule
    start, end = np.asarray(schedule.start), np.asarray(schedule.end)
    count = min(schedule.period, CYCLES)
    chosen = np.arange(count) * schedule.period // count
    of_cycles = [
        (number, n) for number, cycle in enumerate(chosen.tolist()) for n in intervals(schedule, cycle)
    ]
    if len(of_cycles) > SEGMENTS:
        spread = np.linspace(0, len(of_cycles) - 1, SEGMENTS).round().astype(int)
        of_cycles = [of_cycles[place] for place in spread]
    passed, phases, interval_numbers = [], [], []
    for number, interval in of_cycles:
        low, high = float(start[interval]), float(end[interval])
        count = len(intervals(schedule, int(chosen[number])))
        places = list(np.linspace(low, high, max(LEAST, PHASES // count)))
        for m, mesh in enumerate(model.meshes):
            segment = int(np.asarray(schedule.segment)[interval, m])
            ends = np.asarray(mesh.table.boundary)[segment : segment + 2]
            distance = np.asarray(mesh.table.channel)[segment, :, :, _DISTANCE, 0]
            nodes = np.linspace(float(ends[0]), float(ends[1]), distance.shape[0] + 1)[:-1]
            slices = np.shape(mesh.table.face_position)[0]  # which reverse one after the other: of a pair one
            for slot in np.flatnonzero(np.asarray(mesh.table.in_contact)[segment])[::slices]:
                before, after = sorted((0, -1), key=lambda i, slot=slot: distance[i, slot])
                if distance[before, slot] <= 0.0 <= distance[after, slot]:
                    order = np.argsort(distance[:, slot])
                    pitch_point = np.interp(0.0, distance[order, slot], nodes[order])
                    slope = abs(distance[-1, slot] - distance[0, slot]) / (nodes[-1] - nodes[0])
                    width = float(model.operation.reversal_width) / slope
                    near = [place_of(m, phase, schedule, interval) for phase in pitch_point + width * about]
                    places += [phase for phase in near if low < phase < high]
        # np.unique would import numpy.ma, a hundredth of the start of a run
        distinct = sorted(set(np.round(places, DIGITS).tolist()))
        phases += distinct
        passed += [number] * len(distinct)
        interval_numbers += [interval] * len(distinct)
    return np.array(passed) + np.array(phases), np.array(phases), np.array(interval_numbers)


def choose(method: str, model: Model, state: Float[Array, " state"]) -> Choice:
    """Return the method to use: the user's, or explicit unless stability makes that too expensive."""
    if method != AUTO:
        return Choice(method, "chosen in the scenario")
    steps, sliding = stability_steps(model, state), model.options.sliding
    needed = f"explicit stability needs {steps:.0f} steps per mesh cycle"
    stiff, switching = STIFF_ABOVE[sliding], SWITCHING_ABOVE[sliding]
    if steps > stiff:
        return Choice(STIFF, f"stiff: {needed}, above {stiff}")
    if steps > switching:
        return Choice(SWITCHING, f"stiff where flanks stick: {needed}, above {switching}")
    return Choice(EXPLICIT, f"not stiff: {needed}, below {min(stiff, switching)}")


def choose_in_time(method: str, model: Model, state: Float[Array, " state"]) -> Choice:
    """Return the method of a run by time: the user's, or by the same estimate."""
    if method != AUTO:
        return choose(method, model, state)
    steps = stability_steps(model, state)
    needed = f"explicit stability needs {steps:.0f} steps per mesh cycle"
    if steps > STIFF_IN_TIME:
        return Choice(IN_TIME_STIFF, f"stiff: {needed}, above {STIFF_IN_TIME}")
    return Choice(IN_TIME, f"not stiff: {needed}, below {STIFF_IN_TIME}")
