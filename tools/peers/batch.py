"""Programs that integrate many cases: the transmission error over the last WINDOW mesh cycles of each."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from tools.peers.single import Problem
from tribodyn.dynamics.parameters import XI, Model
from tribodyn.solve import ensemble
from tribodyn.solve.initial import static_equilibrium

Array = Any

SAMPLES, WINDOW = 200, 2


class Batch(NamedTuple):
    """A way to run many cases.

    Attributes
    ----------
    march : callable
        (models, states, cycles, rtol) to samples (case, WINDOW · SAMPLES), m.
    cases, cycles : int
        Of the measurement: fewer for the slow ones, whose cost is in proportion.
    """

    march: Callable[[Sequence[Model], Array, int, float], Array]
    cases: int
    cycles: int


def speeds(posed: Problem, count: int) -> tuple[list[Model], Array]:
    """Models at so many pinion speeds from 100 to 600 rad/s, and their static equilibria."""
    mechanics = posed.model.mechanics
    models = [
        posed.model._replace(mechanics=mechanics._replace(nominal_speed=float(speed)))
        for speed in np.linspace(100.0, 600.0, count)
    ]
    return models, np.array([static_equilibrium(model) for model in models])


def lanes(models: Sequence[Model], states: Array, cycles: int, rtol: float) -> Array:
    """Vectors of cases on all cores."""
    return _together("dopri5", models, states, cycles, rtol)


def _together(method: str, models: Sequence[Model], states: Array, cycles: int, rtol: float) -> Array:
    result = ensemble.march(
        models, states, cycles=cycles, window=WINDOW, samples=SAMPLES, rtol=rtol, method=method
    )
    return result.samples[..., XI]


def threads(method: str) -> Callable[[Sequence[Model], Array, int, float], Array]:
    """One case per thread, each with its own engine."""

    def march(models: Sequence[Model], states: Array, cycles: int, rtol: float) -> Array:
        settings = ensemble.March(0, cycles, WINDOW, SAMPLES, False, rtol, 10**6)
        result = ensemble.one_by_one(models, states, method, settings, ensemble.usable_cores())
        return result.samples[..., XI]

    return march


def diffrax(models: Sequence[Model], states: Array, cycles: int, rtol: float) -> Array:
    """Vmapped over 64 similar speeds at a time, one core each; steps end where friction reverses."""
    return _together("tsit5", models, states, cycles, rtol)


BATCHES = {
    "tribodyn, lanes": Batch(lanes, 256, 40),
    "tribodyn, one case per thread": Batch(threads("dopri5"), 256, 40),
    "SciPy LSODA, numba, one by one": Batch(threads("lsoda"), 8, 20),
    "diffrax Tsit5, vmapped": Batch(diffrax, 128, 20),
}
