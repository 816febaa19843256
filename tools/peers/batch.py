"""Programs that integrate many cases: the transmission error over the last mesh cycles of each."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from tools.peers.single import Problem
from tribodyn.dynamics.parameters import Model
from tribodyn.solve import ensemble

Array = Any

SAMPLES, WINDOW = 200, 2


class Batch(NamedTuple):
    """A way to run many cases, and how many for how long: fewer for slow ones, whose cost is in proportion.

    `run` takes models, states and what `ensemble.march` takes by name.
    """

    run: Callable[..., Any]
    cases: int
    cycles: int


def models_at(posed: Problem, speeds: Array) -> list[Model]:
    """The problem's model at pinion speeds, rad/s."""
    operation = posed.model.operation
    return [
        posed.model._replace(operation=operation._replace(nominal_speed=float(speed))) for speed in speeds
    ]


def together(method: str) -> Callable[..., Any]:
    """Vectors of cases on all cores, or, through JAX, vmapped over similar speeds."""
    return lambda models, states, **given: ensemble.march(models, states, method=method, **given)


def threads(method: str) -> Callable[..., Any]:
    """One case per thread, each with its own engine."""

    def run(
        models: Sequence[Model], states: Array, *, cycles: int, window: int, samples: int, rtol: float
    ) -> Any:
        settings = ensemble.March(0, cycles, window, samples, False, rtol, 10**6)
        return ensemble.one_by_one(models, states, method, settings, ensemble.usable_cores())

    return run


BATCHES = {
    "tribodyn, lanes": Batch(together("dopri5"), 256, 40),
    "tribodyn, one case per thread": Batch(threads("dopri5"), 256, 40),
    "SciPy LSODA, numba, one by one": Batch(threads("lsoda"), 8, 20),
    "diffrax Tsit5, vmapped": Batch(together("tsit5"), 128, 20),
}
