"""Steps short enough for friction to turn in: with dynamic sliding the place where it reverses moves.

Friction turns while the sliding velocity passes through the width of reversal, over less than a step of the
vibration. A step across it evaluates the reversal with some of its stages or with none, and its error
estimate misses it. With the nominal sliding the place is known, see `reversal`; here it is found as the
motion comes to it. Steps end, nearly, where the sliding passes one of a few shares of the width: their length
follows from the rate of the last step, and one that passes such a share by too much is tried again with its
own rate. At creep speeds the width is no more than the tolerance of a velocity; the turn then is left to the
error control, which takes steps by the force.

Written as laws over `work`, so that every method applies the same rule.
"""

from tribodyn.dynamics.contact_forces import (
    FRICTION_FORCE,
    RELATIVE_VELOCITY,
    TURNED,
    TURNED_BEFORE,
    TURNING_RATE,
    approach,
    out_of_reach,
    reversals_per_velocity,
)
from tribodyn.dynamics.equations import locate
from tribodyn.numerics.elementary import absolute, law, maximum, minimum, plain, where

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
    return tolerance * reversals_per_velocity(model) < FINEST


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
    approach(segment, cell, u, cells_per_radian, y, model, work)
    per_velocity = reversals_per_velocity(model)
    for i in range(model.table.side.shape[0]):
        if out_of_reach(segment, i, model):
            continue
        work[TURNED_BEFORE, i] = plain(work[RELATIVE_VELOCITY, i]) * per_velocity
        work[TURNING_RATE, i] = 0.0 * plain(work[TURNED_BEFORE, i])


@law
def longest_step(segment, model, work):
    """Longest step from here at the rates of the last one, mesh cycles."""
    longest = UNLIMITED
    for i in range(model.table.side.shape[0]):
        if out_of_reach(segment, i, model):
            continue
        rate = plain(work[TURNING_RATE, i])
        distance, _ = next_share(plain(work[TURNED_BEFORE, i]), rate)
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
        if out_of_reach(segment, i, model):
            continue
        before = plain(work[TURNED_BEFORE, i])
        change = plain(work[TURNED, i]) - before
        distance, near = next_share(before, change)
        far = (absolute(change) > distance + near) & (plain(work[FRICTION_FORCE, i]) != 0.0)
        shorter = minimum(shorter, where(far, step * distance / absolute(where(far, change, 1.0)), step))
    return shorter < step, maximum(shorter, SHORTEST * step)


@law
def keep_turned(accepted, step, segment, model, work):
    """Take over where the sliding stands after a step that was accepted."""
    for i in range(model.table.side.shape[0]):
        if out_of_reach(segment, i, model):
            continue
        before, after = plain(work[TURNED_BEFORE, i]), plain(work[TURNED, i])
        rate = plain(work[TURNING_RATE, i])
        work[TURNING_RATE, i] = where(accepted, (after - before) / step, rate)
        work[TURNED_BEFORE, i] = where(accepted, after, before)
