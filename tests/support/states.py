"""States of the model: random but physically sensible ones, and those of a run."""

import numpy as np

from tribodyn.studies.gear_pair.outputs import outputs
from tribodyn.dynamics.parameters import (
    LAG,
    MECHANICAL,
    MOTOR_SLIP,
    SLIP,
    STATES,
    TWIST,
    VX_P,
    X_P,
    XI,
    XI_RATE,
    Y_G,
)
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.transient import SampledStates, Stop, TransientSettings, transient


def random_state(rng: np.random.Generator, speed: float = 10.0) -> np.ndarray:
    """Bodies displaced by micrometres and vibrating at up to 0.1 m/s; flanks loaded or apart."""
    y = np.zeros(STATES)
    y[X_P : Y_G + 1] = rng.uniform(-8e-6, 8e-6, 4)
    y[XI] = rng.uniform(-20e-6, 60e-6)
    y[TWIST] = rng.uniform(-1e-3, 1e-3)
    y[LAG] = rng.uniform(-1e-6, 1e-6)
    y[VX_P:SLIP] = rng.uniform(-0.05, 0.05, 4)
    y[SLIP] = rng.uniform(-0.05, 0.05) * speed
    y[XI_RATE] = rng.uniform(-0.1, 0.1)
    y[MOTOR_SLIP] = rng.uniform(-0.05, 0.05) * speed
    y[MECHANICAL:] = rng.uniform(0.0, 10.0, STATES - MECHANICAL)
    return y


def random_place(rng: np.random.Generator, boundary: np.ndarray) -> tuple[float, int]:
    """A phase, well inside its segment, and the segment."""
    segment = int(rng.integers(len(boundary) - 1))
    share = rng.uniform(0.02, 0.98)
    return float(boundary[segment] + share * (boundary[segment + 1] - boundary[segment])), segment


def sampled(model, settings: TransientSettings, start: np.ndarray | None = None):
    """Mesh cycles and states of all samples of a run, from the static equilibrium unless told otherwise."""
    *parts, stop = transient(model, static_equilibrium(model) if start is None else start, settings)
    assert isinstance(stop, Stop)
    assert stop.reason == ""
    chunks = [part for part in parts if isinstance(part, SampledStates)]
    return tuple(np.concatenate([getattr(chunk, of) for chunk in chunks]) for of in ("cycles", "states"))


def recorded(model, settings: TransientSettings, start: np.ndarray | None = None) -> dict[str, np.ndarray]:
    """What is recorded of these samples."""
    return outputs(*sampled(model, settings, start), model)
