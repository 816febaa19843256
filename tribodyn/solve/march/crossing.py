"""Where a step by time passes the end of an interval, on its dense output; and the clock of such a march.

Times are in reference cycles of nominal speed.
"""

from tribodyn.dynamics.parameters import Model
from tribodyn.kernels.native import kernel
from tribodyn.numerics.elementary import law, maximum
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.march.marching import SCRATCH, STATE
from tribodyn.solve.methods.dopri5 import dense_output

#: What a march goes on with, rows of `clock`: the time; whole reference cycles before the interval; the
#: interval, and which of its stops comes next; the step to try; the error of the last one; steps so far.
TIME, WHOLE, INTERVAL, STOP, STEP, LAST_ERROR, STEPS = range(7)
#: Of the step last accepted, and of no weight between calls: its length, the share of it that counts, the way
#: over the end of the interval (−1, 0, 1), and whether the derivatives where it ends are not known yet.
TAKEN, SHARE, WAY, FRESH = range(7, 11)
CLOCK_ROWS = 11
#: How far a step goes over the end of an interval that it begins on, about at rest; reference cycles.
FROM_BOUND = 1e-9
#: Halvings in which a place on the dense output is found.
HALVINGS = 100


def cycles_at(
    times: Float[Array, " sample"], states: Float[Array, "sample state"], model: Model
) -> Float[Array, " sample"]:
    """Reference cycles that states have come to at times."""
    return times - states[:, model.layout.lag] / float(nominal_time(model))


@law
def nominal_time(model):
    """Time of a reference cycle at nominal speed, s."""
    return model.operation.pitch_angle / model.operation.nominal_speed


@law
def phase_at(time, lag, whole, model):
    """Phase of the reference at a time and a lag, counted from the start of a cycle."""
    return time - lag / nominal_time(model) - whole


@law
def speed_share(slip, model):
    """Speed of the reference over its nominal one."""
    return 1.0 + slip / model.operation.nominal_speed


@kernel
def beyond(share, way, bound, model, y, clock, buffer):
    """Phase by which a state inside the step last attempted is beyond a bound, in the given way."""
    lag = model.options.layout.lag
    k, step = buffer[SCRATCH:], clock[TAKEN]
    behind = dense_output(share, step, y[lag], buffer[STATE, lag], k, lag)
    return way * (phase_at(clock[TIME] + share * step, behind, clock[WHOLE], model) - bound)


@kernel
def share_at(way, bound, low, high, model, y, clock, buffer):
    """Share of the step between two, not beyond and beyond a bound, at which the bound is passed.

    The second where the step begins on the bound. It is short then, and time goes on, also where the forces
    on either side of the bound drive the reference against each other.
    """
    if beyond(low, way, bound, model, y, clock, buffer) >= 0.0:
        return high
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if middle <= low or middle >= high:
            break
        if beyond(middle, way, bound, model, y, clock, buffer) >= 0.0:
            high = middle
        else:
            low = middle
    return high


@kernel
def turning_share(model, y, clock, buffer):
    """Share of the step last attempted at which the reference turns back; 1.0 where it does not."""
    layout = model.options.layout
    i, step, k = layout.half + layout.lag, clock[TAKEN], buffer[SCRATCH:]
    before, after = speed_share(y[i], model), speed_share(buffer[STATE, i], model)
    if before * after >= 0.0:
        return 1.0
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if middle <= low or middle >= high:
            break
        at = speed_share(dense_output(middle, step, y[i], buffer[STATE, i], k, i), model)
        if at * before > 0.0:
            low = middle
        else:
            high = middle
    return low


@kernel
def find_crossing(low, high, near, model, y, clock, buffer):
    """Put into `clock` what share of the step last attempted counts, and the way over a bound where it ends.

    It may pass a bound on the way to where the reference turns back, and be inside again at its end. What
    stands on a bound, as near as rounding moves it, stays there.
    """
    layout = model.options.layout
    begin_share, turn = 0.0, turning_share(model, y, clock, buffer)
    clock[SHARE], clock[WAY] = 1.0, 0.0
    for _ in range(2):
        for side in range(2):
            way, bound = 1.0 - 2.0 * side, high if side == 0 else low
            over = beyond(turn, way, bound, model, y, clock, buffer)
            from_bound = beyond(0.0, way, bound, model, y, clock, buffer) >= -near
            if over > (maximum(0.5 * FROM_BOUND, near) if from_bound else near) and clock[WAY] == 0.0:
                clock[SHARE] = share_at(way, bound, begin_share, turn, model, y, clock, buffer)
                clock[WAY] = way
            elif over >= -near and turn == 1.0 and not from_bound and clock[WAY] == 0.0:
                if way * speed_share(buffer[STATE, layout.half + layout.lag], model) > 0.0:
                    clock[WAY] = way
        if clock[WAY] != 0.0 or turn == 1.0:
            break
        begin_share, turn = turn, 1.0
