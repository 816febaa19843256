"""The explicit Runge-Kutta pair of Dormand & Prince: coefficients, dense output and choice of the step.

After Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I (2nd ed., 1993), code DOPRI5.
Written as laws, so that the kernel for one case and the one for many cases side by side share every formula.
"""

import numpy as np

from tribodyn.elementary import absolute, law, maximum, minimum

A = np.array(
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [1 / 5, 0.0, 0.0, 0.0, 0.0, 0.0],
        [3 / 40, 9 / 40, 0.0, 0.0, 0.0, 0.0],
        [44 / 45, -56 / 15, 32 / 9, 0.0, 0.0, 0.0],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729, 0.0, 0.0],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656, 0.0],
        [35 / 384, 0.0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    ]
)
C = np.array([0.0, 1 / 5, 3 / 10, 4 / 5, 8 / 9, 1.0, 1.0])
#: Fifth-order less embedded fourth-order weights.
E = np.array([71 / 57600, 0.0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])
#: Weights of the dense output's highest term.
D = np.array(
    [
        -12715105075 / 11282082432,
        0.0,
        87487479700 / 32700410799,
        -10690763975 / 1880347072,
        701980252875 / 199316789632,
        -1453857185 / 822651844,
        69997945 / 29380423,
    ]
)
STAGES = 7

#: First step to try, mesh cycles, and the least one; a step is the last if it ends this close to the end.
FIRST_STEP, LEAST_STEP, TOUCHING = 1e-3, 1e-13, 1.0000001
#: The error remembered of the last step at the start, and the least that is remembered.
LEAST_REMEMBERED = 1e-4


@law
def weighed_error(difference, before, after, atol, rtol):
    """Error of one state over its tolerance."""
    return absolute(difference) / (atol + rtol * maximum(absolute(before), absolute(after)))


@law
def growth(error, last_error):
    """Factor on the step after an accepted one: PI control on this error and the last, 0.2 … 5."""
    factor = 0.8 * maximum(error, 1e-10) ** -0.17 * last_error**0.04
    return minimum(5.0, maximum(0.2, factor))


@law
def shrinkage(error):
    """Factor on the step after a rejected one, error > 1."""
    return maximum(0.2, 0.9 * error**-0.2)


@law
def dense_output(theta, step, before, after, first_rate, last_rate, high):
    """State at the share `theta` of a step, fourth order; `high` is Σ D k."""
    rise = after - before
    bend = step * first_rate - rise
    return before + theta * (
        rise + (1.0 - theta) * (bend + theta * (rise - step * last_rate - bend + (1.0 - theta) * step * high))
    )
