"""A drive at creeping speed, and the linear equations of statics it must meet."""

import numpy as np

from tests.support.states import recorded
from tribodyn.solve.transient import TransientSettings
from tribodyn.train.structure import TURN

# statics knows no vibration, which sliding of the bodies themselves would follow
SLOW = {"operating.pinion_speed": "0.01 rad/s", "friction.sliding": "kinematic"}


def creep(case, cycles=1, samples=100):
    return recorded(case.model, TransientSettings("radau", 1e-8, cycles, 100000, samples))


def statics(case, phase, segment, friction):
    """Loads from the linear equations of statics, with the given friction coefficients; unknown x, y, ξ."""
    cycle, model = case.cycle, case.model
    slots = np.flatnonzero(cycle.in_contact[segment])

    def there(values):
        return np.interp(phase, cycle.phase[segment], values)

    at = [there(cycle.pressure_angle[segment, :, i]) for i in slots]
    r = [there(cycle.signed_distance[segment, :, i]) for i in slots]
    matrix = np.array([[there(cycle.coupling[segment, :, i, j]) for j in slots] for i in slots])
    matrix += np.diag([there(cycle.compliance[segment, :, i]) for i in slots])
    rg = cycle.gear_pitch_radius
    n = len(slots)
    # unknown: F (n), x_p, y_p, x_g, y_g, ξ
    system = np.zeros((n + 5, n + 5))
    right = np.zeros(n + 5)
    for k in range(n):
        c, s = np.cos(at[k]), np.sin(at[k])
        system[k, :n] = matrix[k]
        system[k, n:] = [-c, -s, c, s, -c]
        f = friction[k] * np.sign(r[k])
        system[n, k] = -(c + f * s)
        system[n + 1, k] = -(s - f * c)
        system[n + 2, k] = c + f * s
        system[n + 3, k] = s - f * c
        system[n + 4, k] = rg * c + f * (rg * s - r[k])
    for row, k in enumerate(model.links.stiffness[:2, :TURN].ravel()):
        system[n + row, n + row] = -k
    right[n + 4] = cycle.gear_sense * model.bodies.load[1]
    return slots, np.linalg.solve(system, right)[:n]
