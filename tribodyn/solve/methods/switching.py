"""Native method that switches within the mesh cycle: dopri5, and rodas4 where stability limits its steps.

Flanks that stick about the pitch point make the equations stiff for a part of the mesh cycle only. Both
methods say with every step how stiff it is: the explicit one after Hairer & Wanner, Solving Ordinary
Differential Equations II (2nd ed., 1996), IV.2, the other from the Jacobian that it has anyway.
"""

from tribodyn.kernels.native import kernel
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.march.extreme_search import open_segment, search_step
from tribodyn.solve.march.marching import SCRATCH, Method, march_with, scratch_buffer
from tribodyn.solve.methods import dopri5, rodas4
from tribodyn.solve.methods.dopri5 import A
from tribodyn.train.layout import TrainLayout

#: State at the last stage less that at the one before, over the step, by the stages' rates.
APART = A[6] - A[5]
#: Step over the time constant of the stiffest motion: above the first stability limits the explicit method;
#: below the second, the first times the cost of a stiff step over that of an explicit one, it is the cheaper.
STIFF, NOT_STIFF = 3.0, 12.0
#: Accepted steps in a row after which the explicit or the stiff method gives way to the other.
EXPLICIT_STEPS, STIFF_STEPS = 12, 3
#: Explicit steps after which the stiff method is tried whatever the explicit one says of stiffness: where the
#: tolerance of a velocity exceeds the width of reversal, its stages jump across, and find friction constant.
MOST_EXPLICIT_STEPS = 500.0
#: Columns of the buffer's last row: which method (0 explicit), the step over the time
#: constant, steps in a row that speak for the other method, explicit steps in a row.
WHICH, STIFFNESS, COUNT, EXPLICIT_RUN = range(4)
EXPLICIT_METHOD, STIFF_METHOD = 0.0, 1.0


def buffer(layout: TrainLayout) -> Float[Array, "row state"]:
    """Scratch for the kernel: that of both methods, one at a time, and a row of the choice between them."""
    return scratch_buffer(len(rodas4.buffer(layout)) + 1 - SCRATCH, layout)


@kernel
def explicit_stiffness(k, layout):
    """Step over the time constant, squared, from the last two stages, which stand at the same phase."""
    rates, states = 0.0, 0.0
    for i in range(layout.half, layout.mechanical):
        moved = APART[0] * k[0, i] + APART[1] * k[1, i] + APART[2] * k[2, i]
        moved += APART[3] * k[3, i] + APART[4] * k[4, i] + APART[5] * k[5, i]
        rate = k[6, i] - k[5, i]
        states += moved * moved
        rates += rate * rate
    return rates / states if states > 0.0 else 0.0


@kernel
def attempt(fresh, step, place, y, control, model, work, buffer):
    """See `marching.Method`."""
    layout = model.options.layout
    if buffer[buffer.shape[0] - 1, WHICH] == EXPLICIT_METHOD:
        evaluations = dopri5.attempt(fresh, step, place, y, control, model, work, buffer)
        buffer[buffer.shape[0] - 1, STIFFNESS] = explicit_stiffness(buffer[SCRATCH:], layout)
        return evaluations
    evaluations = rodas4.attempt(fresh, step, place, y, control, model, work, buffer)
    buffer[buffer.shape[0] - 1, STIFFNESS] = rodas4.stiffness(step, buffer, layout)
    return evaluations


@kernel
def sample(theta, step, y, buffer, out, layout):
    """See `marching.Method`."""
    if buffer[buffer.shape[0] - 1, WHICH] == EXPLICIT_METHOD:
        dopri5.sample(theta, step, y, buffer, out, layout)
    else:
        rodas4.sample(theta, step, y, buffer, out, layout)


@kernel
def accept(buffer, layout):
    """See `marching.Method`: a step after the methods have changed begins fresh."""
    mode = buffer[buffer.shape[0] - 1]
    if mode[WHICH] == EXPLICIT_METHOD:
        mode[COUNT] = mode[COUNT] + 1.0 if mode[STIFFNESS] > STIFF * STIFF else 0.0
        mode[EXPLICIT_RUN] += 1.0
        if mode[COUNT] >= EXPLICIT_STEPS or mode[EXPLICIT_RUN] >= MOST_EXPLICIT_STEPS:
            mode[WHICH], mode[COUNT], mode[EXPLICIT_RUN] = STIFF_METHOD, 0.0, 0.0
            return True
        return dopri5.accept(buffer, layout)
    mode[COUNT] = mode[COUNT] + 1.0 if mode[STIFFNESS] < NOT_STIFF else 0.0
    if mode[COUNT] >= STIFF_STEPS:
        mode[WHICH], mode[COUNT] = EXPLICIT_METHOD, 0.0
    return True


@kernel
def adapted(step, error, last_error, buffer):
    """See `marching.Method`."""
    if buffer[buffer.shape[0] - 1, WHICH] == EXPLICIT_METHOD:
        return dopri5.adapted(step, error, last_error, buffer)
    return rodas4.adapted(step, error, last_error, buffer)


@kernel
def contacts(phase, interval, model, work, buffer):
    """See `marching.Method`."""
    if buffer[buffer.shape[0] - 1, WHICH] == EXPLICIT_METHOD:
        dopri5.contacts(phase, interval, model, work, buffer)
    else:
        rodas4.contacts(phase, interval, model, work, buffer)


METHOD = Method(attempt, sample, accept, adapted, contacts, open_segment, search_step)


@kernel
def integrate(march, control, model, y, out, work, buffer, search):
    """Integrate mesh cycles, see `marching.march_with`."""
    return march_with(METHOD, march, control, model, y, out, work, buffer, search)
