"""Maps with known answers, for the search for steady states."""

import numpy as np

from tribodyn.solve.period_map import Marched, by_differences


class ClosedForm:
    """A map given as a function of the state and of one parameter."""

    blur = 0.0

    def __init__(self, step, parameters, size):
        self.step = step
        self.parameters = np.array(parameters, dtype=float)
        self.scale = np.ones((len(self.parameters), size))
        self.marched = np.zeros(len(self.parameters), dtype=int)

    def march(self, states, cases, periods, fine):
        x = states.copy()
        track = []
        with np.errstate(over="ignore", invalid="ignore"):
            for _ in range(periods):
                x = self.step(x, self.parameters[cases])
                track.append(x)
        np.add.at(self.marched, cases, periods)
        states = np.stack(track, axis=1)
        lost = ~np.all(np.abs(states) < 1e6, axis=(1, 2))
        return Marched(states, ["it runs away" if one else "" for one in lost])

    def tangent(self, states, cases, periods):
        return by_differences(self.march, states, cases, periods, 1e-4 * self.scale)


def logistic(x, r):
    return r[:, None] * x * (1.0 - x)
