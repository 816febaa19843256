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

from tribodyn.dynamics import approach as contact
from tribodyn.dynamics.contact_forces import reversals_per_velocity
from tribodyn.dynamics.mesh_motion import motion_of, place_in_mesh
from tribodyn.numerics.elementary import absolute, anywhere, independent, law, maximum, minimum, plain, where
from tribodyn.solve.integrator import Status
from tribodyn.train.structure import driven_arm, driver_arm, rolling_ratio, shifted, turn_of, turned

#: First step to try and the smallest one, mesh cycles; a step is the last if it ends this close to the end.
FIRST_STEP, MINIMUM_STEP, TOUCHING = 1e-3, 1e-13, 1.0000001
#: Error taken for that of the last step at the start, and the smallest that is remembered.
MINIMUM_ERROR = 1e-4
#: Share of the nominal speed below which steps that vanish mean that the reference comes to rest: rates with
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

    Too many in this mesh cycle; the reference comes to rest, as it does where steps vanish as it stops, and
    at once where an engagement takes all its kinetic energy; or too small. Speeds are the reference's.
    """
    too_many, vanishing, stopped = steps >= max_steps, step < MINIMUM_STEP, speed <= 0.0
    failure = 0.0 * step
    if anywhere(too_many | vanishing | stopped):
        at_rest = (vanishing & (speed < STANDSTILL * nominal_speed)) | stopped
        failure = where(at_rest, STALLED, where(vanishing, STEP_TOO_SMALL, failure))
        failure = where(too_many, TOO_MANY_STEPS, failure)
    return failure


@law
def relative_factor(state, layout):
    """Factor on the relative tolerance of a state.

    Displacements have none: on soft bearings they are many times the deflection of the mesh, on which all
    forces depend. Nor have works, which grow with the run.
    """
    return 1.0 if state == layout.lag or layout.half <= state < layout.mechanical else 0.0


@law
def weighed_error(difference, before, after, atol, rtol):
    """Error of one state over its tolerance."""
    return absolute(difference) / (atol + rtol * maximum(absolute(before), absolute(after)))


@law
def collected(worst, total, weighed):
    """Largest error of some states and the sum of them, with another state's: see `step_error`."""
    return where(weighed > worst, weighed, worst), total + weighed


@law
def collected_errors(difference, before, after, atol, rtol, layout):
    """Largest error of all states over their tolerances, and the sum of them."""
    worst, total = 0.0, 0.0
    for i in range(layout.states):
        relative = rtol * relative_factor(i, layout)
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
    layout = model.options.layout
    at_rest = accepted & (model.operation.nominal_speed + after[layout.half + layout.lag] <= 0.0)
    runaway = accepted & unbounded(after, model)
    failure = 0.0 * step
    if anywhere(undefined | at_rest | runaway):
        failure = where(at_rest, STALLED, where(runaway, UNBOUNDED, failure))
        failure = where(undefined & (step < MINIMUM_RETRY), NOT_FINITE, failure)
    return accepted, undefined, failure


@law
def unbounded(state, model):
    """Whether a motion has grown without bound: something moved by more than a centre distance.

    No gears are left then of which the table of a mesh says anything. An unstable motion grows exponentially,
    so that it matters little where the bound is.
    """
    layout = model.options.layout
    farthest = 0.0 * plain(state[0])
    for m in range(layout.meshes):
        mesh = model.meshes[m]
        distance = absolute(mesh.driver_radius + mesh.driven_radius)
        farthest = maximum(farthest, largest_displacement(m, state, model) / distance)
    return farthest > 1.0


@law
def shift_size(body, state, layout):
    """Largest magnitude of a body's displacements, m."""
    x, y = plain(shifted(body, 0, state, layout)), plain(shifted(body, 1, state, layout))
    return maximum(absolute(x), absolute(y))


@law
def largest_displacement(m, state, model):
    """Largest magnitude of the displacements of a mesh's bodies and of its transmission error, m."""
    layout, mesh = model.options.layout, model.meshes[m]
    driver, driven = layout.driver[m], layout.driven[m]
    first, second = shift_size(driver, state, layout), shift_size(driven, state, layout)
    error = driver_arm(mesh) * plain(turned(driver, state, layout))
    error = error - driven_arm(mesh) * plain(turned(driven, state, layout))
    return maximum(maximum(first, second), absolute(error))


@law
def next_step(step, cut, uncut_step):
    """Step to try after an accepted one that was cut or not: cutting says nothing against the one wanted."""
    return where(cut, maximum(step, uncut_step), step)


#: Slices of a face reverse one after the other, each with its small part of the load: no step ends there.
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
def resolves_turns(atol, model):
    """Whether tolerances of the states are fine enough to see friction turn, in some mesh."""
    layout = model.options.layout
    fine = atol[0] < 0.0
    for m in range(layout.meshes):
        tolerance = (
            absolute(model.meshes[m].driven_radius) * atol[layout.half + turn_of(layout.driven[m], layout)]
        )
        fine = fine | (tolerance * reversals_in(m, model) < FINEST)
    return fine


@law
def reversals_in(m, model):
    """`contact_forces.reversals_per_velocity` of a mesh."""
    return reversals_per_velocity(rolling_ratio(m, model), model.meshes[m], model)


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
def begin_turning(phase, interval, y, model, work):
    """Fill `work` with where the pairs' sliding stands at the start of an interval; `TURNING_RATE` is 0."""
    for m in range(model.options.layout.meshes):
        mesh, contacts = model.meshes[m], work[m]
        if contact.sliced(mesh):
            continue
        place = place_in_mesh(m, phase, interval, model)
        contact.approach(place, independent(motion_of(m, y, model), contacts), mesh, contacts)
        per_velocity = reversals_in(m, model)
        for i in range(mesh.table.side.shape[0]):
            if contact.absent(i, contacts):
                continue
            contacts[contact.TURNED_BEFORE, i] = plain(contacts[contact.RELATIVE_VELOCITY, i]) * per_velocity
            contacts[contact.TURNING_RATE, i] = 0.0 * plain(contacts[contact.TURNED_BEFORE, i])


@law
def longest_step(interval, model, work):
    """Longest step from here at the rates of the last one, reference cycles."""
    longest = UNLIMITED
    for m in range(model.options.layout.meshes):
        mesh, contacts = model.meshes[m], work[m]
        if contact.sliced(mesh):
            continue
        for i in range(mesh.table.side.shape[0]):
            if contact.absent(i, contacts):
                continue
            rate = plain(contacts[contact.TURNING_RATE, i])
            distance, _ = next_share(plain(contacts[contact.TURNED_BEFORE, i]), rate)
            longest = minimum(
                longest, where(rate != 0.0, distance / absolute(where(rate != 0.0, rate, 1.0)), UNLIMITED)
            )
    return longest


@law
def turn_of_friction(step, interval, model, work):
    """Whether a step has turned the friction of a loaded pair too far, and the step to try instead.

    `work` is as the right-hand side left it at the end of the step.
    """
    shorter = 1.0 * step
    for m in range(model.options.layout.meshes):
        mesh, contacts = model.meshes[m], work[m]
        if contact.sliced(mesh):
            continue
        for i in range(mesh.table.side.shape[0]):
            if contact.absent(i, contacts):
                continue
            before = plain(contacts[contact.TURNED_BEFORE, i])
            change = plain(contacts[contact.TURNED, i]) - before
            distance, near = next_share(before, change)
            loaded = plain(contacts[contact.FRICTION_FORCE, i]) != 0.0
            far = (absolute(change) > distance + near) & loaded
            shorter = minimum(shorter, where(far, step * distance / absolute(where(far, change, 1.0)), step))
    return shorter < step, maximum(shorter, SHORTEST * step)


@law
def keep_turned(accepted, step, interval, model, work):
    """Take over where the sliding stands after a step that was accepted."""
    for m in range(model.options.layout.meshes):
        mesh, contacts = model.meshes[m], work[m]
        if contact.sliced(mesh):
            continue
        for i in range(mesh.table.side.shape[0]):
            if contact.absent(i, contacts):
                continue
            before, after = plain(contacts[contact.TURNED_BEFORE, i]), plain(contacts[contact.TURNED, i])
            rate = plain(contacts[contact.TURNING_RATE, i])
            contacts[contact.TURNING_RATE, i] = where(accepted, (after - before) / step, rate)
            contacts[contact.TURNED_BEFORE, i] = where(accepted, after, before)
