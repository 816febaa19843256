"""Transient runs: blocks of whole mesh cycles one after the other, and what happens on a failure."""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.equations import engagement
from tribodyn.dynamics.parameters import LAG, SLIP, STATES, WORK_IN, WORK_PARAMETRIC, XI, XI_RATE, Model
from tribodyn.kernels.native import laid_out
from tribodyn.solve.dormand_prince import FIRST_STEP
from tribodyn.solve.engine import (
    DONE,
    NOT_FINITE,
    REASONS,
    Block,
    Engine,
    Tolerances,
    absolute_tolerances,
    mean_stiffness,
)
from tribodyn.solve.initial import static_deflection
from tribodyn.solve.marching import Asked
from tribodyn.solve.reversal import stops
from tribodyn.solve.stiffness import EXPLICIT, STIFF, THROUGH_JAX


class Settings(NamedTuple):
    """What the user chooses about the integration; see `case.SolverData`."""

    method: str
    rtol: float
    cycles: int
    max_steps: int
    samples: int


class Chunk(NamedTuple):
    """Samples as they come: phases in mesh cycles since the start, and states."""

    cycles: np.ndarray
    states: np.ndarray
    evaluations: int
    steps: int


class Stop(NamedTuple):
    """The end of a run: the state, what it cost, and on a failure when and why."""

    state: np.ndarray
    reached: float
    steps: int
    evaluations: int
    reason: str
    time: float


class NativeEngine:
    """A compiled kernel behind the `engine.Engine` interface: Dormand-Prince, or Rosenbrock's method."""

    def __init__(self, model: Model, samples: int, tolerances: Tolerances, method: str = EXPLICIT):
        if method == STIFF:
            from tribodyn.solve.rodas4 import buffers, march
        else:
            from tribodyn.solve.dopri5 import buffers, march

        self._march = march
        self._buffers = buffers(model)
        self._stops = stops(model)
        self._laid = laid_out(model)
        self.model = model
        self.samples = samples
        self.tolerances = tolerances
        self.step = FIRST_STEP
        self.started = False

    def block(self, state: np.ndarray, first_cycle: int, cycles: int) -> Block:
        """See `engine.Engine`."""
        y = state.copy()
        out = np.empty((cycles * self.samples, STATES))
        rtol, atol, max_steps = self.tolerances
        asked = Asked(
            float(first_cycle),
            cycles,
            self.samples,
            self.started,
            rtol,
            atol,
            self.step,
            max_steps,
            self._stops,
        )
        status, reached, self.step, steps, evaluations, written = self._march(
            self._laid, y, asked, out, *self._buffers
        )
        self.started = True
        return Block(out[:written], y, status, reached, steps, evaluations)


def tolerances_from(model: Model, state: np.ndarray, rtol: float, max_steps: int) -> Tolerances:
    """Tolerances scaled by the deflection that the mesh has in `state` or would have under the load."""
    return Tolerances(rtol, tolerances_of_many([model], state[None], rtol)[0], max_steps)


def tolerances_of_many(models: Sequence[Model], states: np.ndarray, rtol: float) -> np.ndarray:
    """Absolute tolerances (C, STATES) of many cases; what only a table decides is found once a table."""
    known: dict[int, tuple[float, float]] = {}
    found = np.empty((len(models), STATES))
    for case, model in enumerate(models):
        if id(model.table) not in known:
            known[id(model.table)] = mean_stiffness(model), static_deflection(model, 1.0)
        stiffness, per_torque = known[id(model.table)]
        static = per_torque * abs(float(model.mechanics.load_torque))
        deflection = max(abs(float(states[case, XI])), static, 1e-9)
        found[case] = absolute_tolerances(model, rtol, deflection, stiffness)
    return found


def make_engine(method: str, model: Model, samples: int, tolerances: Tolerances) -> Engine:
    """The engine that a method's name stands for."""
    if method in (EXPLICIT, STIFF):
        return NativeEngine(model, samples, tolerances, method)
    if method in THROUGH_JAX:
        from tribodyn.solve.diffrax_engine import DiffraxEngine

        return DiffraxEngine(method, model, samples, tolerances)
    from tribodyn.solve.scipy_engine import ScipyEngine

    return ScipyEngine(method, model, samples, tolerances)


def cycles_per_block(method: str, cycles: int) -> int:
    """Whole mesh cycles between two writes: a quarter of the run, at most 50; one where a cycle is slow."""
    return max(1, min(cycles // 4, 50)) if method in (EXPLICIT, STIFF) else 1


def transient(model: Model, state: np.ndarray, settings: Settings, method: str) -> Iterator[Chunk | Stop]:
    """Integrate from `state`; yields chunks of samples as they are done, and a `Stop` last.

    Parameters
    ----------
    model : Model
    state : (STATES,)
        Start, at phase 0 with the pairs of the first segment in contact.
    settings : Settings
    method : str
        A definite method, see `choose`.

    Notes
    -----
    A complete run has cycles × samples + 1 samples, the last one at the start of the next mesh cycle, after
    its engagement. A run that stops early yields what it has and says why in `Stop.reason`.
    """
    tolerances = tolerances_from(model, state, settings.rtol, settings.max_steps)
    engine = make_engine(method, model, settings.samples, tolerances)
    size = cycles_per_block(method, settings.cycles)
    steps = evaluations = done = 0
    while done < settings.cycles:
        count = min(size, settings.cycles - done)
        block = engine.block(state, done, count)
        steps += block.steps
        evaluations += block.evaluations
        at = done + np.arange(len(block.samples)) / settings.samples
        finite = np.all(np.isfinite(block.samples), axis=1)
        kept = len(finite) if finite.all() else int(np.argmin(finite))
        yield Chunk(at[:kept], block.samples[:kept], block.evaluations, block.steps)
        if block.status != DONE or kept < len(finite):
            reached = done + block.reached
            reason = REASONS[NOT_FINITE if block.status == DONE else block.status]
            reason = f"{reason} ({block.message})" if block.message else reason
            time = reached * float(model.table.pitch_angle) / model.mechanics.nominal_speed
            last = block.samples[kept - 1] if kept else state
            yield Stop(last, reached, steps, evaluations, reason, time + float(last[LAG]))
            return
        state = block.state
        done += count
    state = state.copy()
    engage_next(state, model)
    yield Chunk(np.array([float(done)]), state[None], 0, 0)
    time = done * float(model.table.pitch_angle) / model.mechanics.nominal_speed + float(state[LAG])
    yield Stop(state, float(done), steps, evaluations, "", time)


def engage_next(state: np.ndarray, model: Model) -> None:
    """Take a state at the end of a mesh cycle over the engagement that begins the next, in place."""
    last = len(np.asarray(model.table.boundary)) - 2
    slip, xi_rate, work_in, parametric = engagement(last, 1.0, 0, 0.0, state, model, {})
    state[SLIP] += slip
    state[XI_RATE] += xi_rate
    state[WORK_IN] += work_in
    state[WORK_PARAMETRIC] += parametric
