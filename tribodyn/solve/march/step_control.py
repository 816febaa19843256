"""Steps: where they end, which are accepted, how they are given up. One set of rules for every native method.

Written as laws, so that the march of one case and that of many cases side by side apply the same rules.
"""

import numpy as np

from tribodyn.dynamics.parameters import DISPLACEMENTS, STATES, WORKS, X_G, X_P, XI, Y_G, Y_P
from tribodyn.numerics.elementary import absolute, law, maximum, plain, where

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


@law
def cut_at_stop(phase, step, stop):
    """Whether a step comes so near the next stop that it is to end there, and the step as it then is."""
    cut = phase + TOUCHING * step >= stop
    return cut, where(cut, stop - phase, step)


@law
def refused(steps, max_steps, step, speed, nominal_speed):
    """Whether no step can be taken: too many in this mesh cycle; too small; the pinion comes to rest.

    It does where steps vanish as it stops, and at once where an engagement takes all its kinetic energy.

    Parameters
    ----------
    steps, max_steps : number
        Accepted in this mesh cycle so far, and allowed.
    step : float
        To be taken, mesh cycles.
    speed, nominal_speed : float
        Of the pinion, rad/s.
    """
    vanishing = step < MINIMUM_STEP
    at_rest = (vanishing & (speed < STANDSTILL * nominal_speed)) | (speed <= 0.0)
    return steps >= max_steps, vanishing, at_rest


@law
def weighed_error(difference, before, after, atol, rtol):
    """Error of one state over its tolerance."""
    return absolute(difference) / (atol + rtol * maximum(absolute(before), absolute(after)))


@law
def collected(worst, total, weighed):
    """Largest error of some states and the sum of them, with another state's: see `step_error`."""
    return where(weighed > worst, weighed, worst), total + weighed


@law
def step_error(worst, total):
    """Error of a step over its tolerance, that of the worst state: a mean would let states at rest dilute it.

    The sum over all states says where it is not finite, which comparisons do not see.
    """
    return where(total < INFINITE, worst, total)


@law
def step_outcome(error, step, speed_after):
    """What a step attempted is: accepted; not finite; not finite and too small to try again; at rest.

    `error` is over the tolerance, and not a number where any state's is not.
    """
    accepted = error <= 1.0
    undefined = (error != error) | (error >= INFINITE)
    return accepted, undefined, undefined & (step < MINIMUM_RETRY), accepted & (speed_after <= 0.0)


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
