"""Steps: where they end, which are accepted, how they are given up, and how far friction may turn in them.

Written as laws, so that the march of one case and that of many cases side by side apply the same rules.

Friction turns while the sliding velocity passes through the width of reversal, over less than a step of the
vibration. A step across it evaluates the reversal with some of its stages or with none, and its error
estimate misses it. With the nominal sliding the place is known, see `reversal`; with dynamic sliding it moves
and is found as the motion comes to it. Steps end, nearly, where the sliding passes one of a few shares of the
width: their length follows from the rate of the last step, and one that passes such a share by too much is
tried again with its own rate. At creep speeds the width is no more than the tolerance of a velocity; the turn
then is left to the error control, which takes steps by the force.
"""

import numpy as np

from tribodyn.dynamics import contact_forces as contact
from tribodyn.dynamics.equations import locate
from tribodyn.dynamics.parameters import DISPLACEMENTS, SLIP, STATES, WORKS, X_G, X_P, XI, Y_G, Y_P
from tribodyn.numerics.elementary import absolute, anywhere, law, maximum, minimum, plain, where
from tribodyn.solve.integrator import Status

#: First step to try and the smallest one, mesh cycles; a step is the last if it ends this close to the end.
FIRST_STEP, MINIMUM_STEP, TOUCHING = 1e-3, 1e-13, 1.0000001
#: Error taken for that of the last step at the start, and the smallest that is remembered.
MINIMUM_ERROR = 1e-4
#: Factor on the relative tolerance of every state. Displacements have none: on soft bearings they are many
#: times the deflection of the mesh, on which all forces depend. Nor have works, which grow with the run.
RELATIVE = np.array([0.0 if state in (*DISPLACEMENTS, *WORKS) else 1.0 for state in range(STATES)])
#: Share of the nominal speed below which steps that vanish mean that the pinion comes to rest: rates with
#: respect to phase grow without bound there. A light pinion at low nominal speed still turns at a hundredth
#: of it when a step is the smallest one.
STANDSTILL = 0.05
#: Factor on a step that gives no finite numbers, and the step below which it is given up, mesh cycles.
RETRY, MINIMUM_RETRY = 0.1, 1e-9
INFINITE = float("inf")
#: As floats, which lanes hold.
_DONE, STEP_TOO_SMALL, TOO_MANY_STEPS, NOT_FINITE, STALLED, _GAVE_UP, UNBOUNDED = map(float, Status)


@law
def cut_at_stop(phase, step, stop):
    """Whether a step comes so near the next stop that it is to end there, and the step as it then is."""
    cut = phase + TOUCHING * step >= stop
    return cut, where(cut, stop - phase, step)


@law
def refusal(steps, max_steps, step, speed, nominal_speed):
    """The `Status` for which no step can be taken, as a number; 0.0 where one can.

    Too many in this mesh cycle; the pinion comes to rest, as it does where steps vanish as it stops, and at
    once where an engagement takes all its kinetic energy; or too small. Speeds are the pinion's.
    """
    too_many, vanishing, stopped = steps >= max_steps, step < MINIMUM_STEP, speed <= 0.0
    failure = 0.0 * step
    if anywhere(too_many | vanishing | stopped):
        at_rest = (vanishing & (speed < STANDSTILL * nominal_speed)) | stopped
        failure = where(at_rest, STALLED, where(vanishing, STEP_TOO_SMALL, failure))
        failure = where(too_many, TOO_MANY_STEPS, failure)
    return failure


@law
def weighed_error(difference, before, after, atol, rtol):
    """Error of one state over its tolerance."""
    return absolute(difference) / (atol + rtol * maximum(absolute(before), absolute(after)))


@law
def collected(worst, total, weighed):
    """Largest error of some states and the sum of them, with another state's: see `step_error`."""
    return where(weighed > worst, weighed, worst), total + weighed


@law
def collected_errors(difference, before, after, atol, rtol):
    """Largest error of all states over their tolerances, and the sum of them."""
    worst, total = 0.0, 0.0
    for i in range(STATES):
        relative = rtol * RELATIVE[i]
        weighed = weighed_error(plain(difference[i]), plain(before[i]), plain(after[i]), atol[i], relative)
        worst, total = collected(worst, total, weighed)
    return worst, total


@law
def step_error(worst, total):
    """Error of a step over its tolerance, that of the worst state: a mean would let states at rest dilute it.

    The sum over all states says where it is not finite, which comparisons do not see.
    """
    return where(total < INFINITE, worst, total)


@law
def step_outcome(error, step, after, model):
    """Whether a step is accepted, whether it is not finite, and the `Status` that ends the march, or 0.0.

    `error` is over the tolerance, and not a number where any state's is not.
    """
    accepted = error <= 1.0
    undefined = (error != error) | (error >= INFINITE)
    at_rest = accepted & (model.mechanics.nominal_speed + after[SLIP] <= 0.0)
    runaway = accepted & unbounded(after, model.table)
    failure = 0.0 * step
    if anywhere(undefined | at_rest | runaway):
        failure = where(at_rest, STALLED, where(runaway, UNBOUNDED, failure))
        failure = where(undefined & (step < MINIMUM_RETRY), NOT_FINITE, failure)
    return accepted, undefined, failure


@law
def largest_displacement(state):
    """Largest magnitude of the displacements of the bodies and of the transmission error, m."""
    pinion = maximum(absolute(plain(state[X_P])), absolute(plain(state[Y_P])))
    gear = maximum(absolute(plain(state[X_G])), absolute(plain(state[Y_G])))
    return maximum(maximum(pinion, gear), absolute(plain(state[XI])))


@law
def unbounded(state, table):
    """Whether a motion has grown without bound: something moved by more than the centre distance.

    No gears are left then of which the table of the mesh says anything. An unstable motion grows
    exponentially, so that it matters little where the bound is.
    """
    return largest_displacement(state) > table.pinion_pitch_radius + table.gear_pitch_radius


@law
def next_step(step, cut, uncut_step):
    """Step to try after an accepted one that was cut or not: cutting says nothing against the one wanted."""
    return where(cut, maximum(step, uncut_step), step)


#: Shares of the width of reversal that steps end on, as in `reversal.SHARES`, and how far from them. The
#: force is C1 at the ends; at the pitch point the friction coefficient has a kink in the sliding speed.
SHARES = (-1.0, -0.2, 0.0, 0.2, 1.0)
NEAR = (0.1, 0.04, 0.01, 0.04, 0.1)
#: Shortest step that a turn may ask for, over the one that went too far, and how often it may ask.
SHORTEST, MOST_TRIES = 0.02, 3.0
#: Tolerance of a velocity, over that of the width, above which it says nothing of the turn.
FINEST = 0.02
UNLIMITED = 1e9


@law
def resolves_turns(tolerance, model):
    """Whether a tolerance of the velocities, m/s, is fine enough to see friction turn."""
    return tolerance * contact.reversals_per_velocity(model) < FINEST


@law
def next_share(share, rate):
    """Distance from a share of the width to the next place where a step ends, and how near it is to end."""
    distance, near = UNLIMITED + 0.0 * share, 0.0 * share
    for place in range(len(SHARES)):
        ahead = where(rate > 0.0, SHARES[place] - share, share - SHARES[place])
        closer = (ahead > NEAR[place]) & (ahead < distance)
        distance, near = where(closer, ahead, distance), where(closer, NEAR[place], near)
    return distance, near


@law
def begin_turning(phase, segment, y, model, work):
    """Fill `work` with where the pairs' sliding stands at the start of a segment; `TURNING_RATE` is 0."""
    cell, u, cells_per_radian = locate(phase, segment, model.table)
    contact.approach(segment, cell, u, cells_per_radian, y, model, work)
    per_velocity = contact.reversals_per_velocity(model)
    for i in range(model.table.side.shape[0]):
        if contact.out_of_reach(segment, i, model):
            continue
        work[contact.TURNED_BEFORE, i] = plain(work[contact.RELATIVE_VELOCITY, i]) * per_velocity
        work[contact.TURNING_RATE, i] = 0.0 * plain(work[contact.TURNED_BEFORE, i])


@law
def longest_step(segment, model, work):
    """Longest step from here at the rates of the last one, mesh cycles."""
    longest = UNLIMITED
    for i in range(model.table.side.shape[0]):
        if contact.out_of_reach(segment, i, model):
            continue
        rate = plain(work[contact.TURNING_RATE, i])
        distance, _ = next_share(plain(work[contact.TURNED_BEFORE, i]), rate)
        longest = minimum(
            longest, where(rate != 0.0, distance / absolute(where(rate != 0.0, rate, 1.0)), UNLIMITED)
        )
    return longest


@law
def turn_of(step, segment, model, work):
    """Whether a step has turned the friction of a loaded pair too far, and the step to try instead.

    `work` is as the right-hand side left it at the end of the step.
    """
    shorter = 1.0 * step
    for i in range(model.table.side.shape[0]):
        if contact.out_of_reach(segment, i, model):
            continue
        before = plain(work[contact.TURNED_BEFORE, i])
        change = plain(work[contact.TURNED, i]) - before
        distance, near = next_share(before, change)
        far = (absolute(change) > distance + near) & (plain(work[contact.FRICTION_FORCE, i]) != 0.0)
        shorter = minimum(shorter, where(far, step * distance / absolute(where(far, change, 1.0)), step))
    return shorter < step, maximum(shorter, SHORTEST * step)


@law
def keep_turned(accepted, step, segment, model, work):
    """Take over where the sliding stands after a step that was accepted."""
    for i in range(model.table.side.shape[0]):
        if contact.out_of_reach(segment, i, model):
            continue
        before, after = plain(work[contact.TURNED_BEFORE, i]), plain(work[contact.TURNED, i])
        rate = plain(work[contact.TURNING_RATE, i])
        work[contact.TURNING_RATE, i] = where(accepted, (after - before) / step, rate)
        work[contact.TURNED_BEFORE, i] = where(accepted, after, before)
