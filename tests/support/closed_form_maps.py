"""Maps with known answers, for the search for steady states."""

import numpy as np

from tribodyn.solve.orbit.motions import BLOCK, Marched, by_differences


class ClosedForm:
    """A map given as a function of the state and of one parameter."""

    blur, block = 0.0, BLOCK

    def __init__(self, step, parameters, size):
        self.step = step
        self.parameters = np.array(parameters, dtype=float)
        self.scale = np.ones((len(self.parameters), size))
        self.shooting_cost = 4.0 * (size + 2)
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
        return Marched(states, ["it runs away" if away else "" for away in lost])

    def tangent(self, states, cases, periods, fine=True):
        return by_differences(self.march, states, cases, periods, 1e-4 * self.scale)


def logistic(x, r):
    return r[:, None] * x * (1.0 - x)


def cubic(x, a):
    """x' = x + (a + x − x³)/4: a cusp's folds at a = ±2/√27."""
    return x + 0.25 * (a[:, None] + x - x**3)


def delayed(x, a):
    """The delayed logistic map x' = a x (1 − y), y' = x: multipliers on the unit circle at ±60° for a = 2."""
    return np.stack([a * x[:, 0] * (1.0 - x[:, 1]), x[:, 0]], axis=1)


class Lines:
    """A map with one parameter, the same on every line."""

    def __init__(self, step, size):
        self.step, self.size = step, size
        self.asked: list[float] = []

    def at(self, lines, values):
        self.asked += list(values)
        return ClosedForm(self.step, values, self.size), [""] * len(values)
