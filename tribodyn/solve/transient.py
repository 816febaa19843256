"""Transient runs: whole mesh cycles one after the other, and what happens on a failure."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.dynamics.recorded.extremes import Extremes, no_extremes, take_in
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.choice import choose
from tribodyn.solve.integrator import REASONS, IntegratedCycles, Integrator, Status
from tribodyn.solve.march.marching import NativeIntegrator
from tribodyn.solve.methods import AUTO, Runs, integrator_class, runs
from tribodyn.solve.right_hand_side import engage_next
from tribodyn.solve.tolerances import StepTolerances, tolerances_from

#: Of a native run between two writes, at most: mesh cycles, samples, and steps, judged by those before.
MAXIMUM_CYCLES, MAXIMUM_SAMPLES, MAXIMUM_STEPS = 250, 20_000, 50_000
#: Mesh cycles before the first write, at most: how many steps they take is not known.
FIRST_CYCLES = 50


class TransientSettings(NamedTuple):
    """How to integrate; see `methods.SolverData`."""

    method: str  # a definite method, see `choice.choose`
    rtol: float
    cycles: int  # mesh cycles to do
    max_steps: int  # steps allowed in one mesh cycle
    samples: int  # samples per mesh cycle
    window: int = 0  # last mesh cycles that writes must not straddle the start of; 0: they may
    extremes: bool = False  # whether extremes are sought


class SampledStates(NamedTuple):
    """Samples as they come: phases in mesh cycles since the start, states, what they cost, and extremes."""

    cycles: Float[Array, " sample"]
    states: Float[Array, "sample state"]
    evaluations: int
    steps: int
    extremes: Extremes | None = None


class Stop(NamedTuple):
    """The end of a run: the state, what it cost, and on a failure when and why."""

    state: Float[Array, " state"]
    reached: float
    steps: int
    evaluations: int
    reason: str
    time: float


class MarchedAgain:
    """Wraps an integrator: where extremes are sought, a native one follows it, see `integrator.Integrator`.

    As it starts every mesh cycle where the other did, it goes astray by no more than a cycle's error.
    There is at least one sample in a mesh cycle.
    """

    def __init__(self, integrator: Integrator, model: Model, samples: int, tolerances: StepTolerances):
        self.started = self.extremes = False
        self._integrator = integrator
        self._model, self._samples, self._tolerances = model, samples, tolerances
        self._native: NativeIntegrator | None = None

    def integrate(self, state: Float[Array, " state"], first_cycle: int, cycles: int) -> IntegratedCycles:
        """See `integrator.Integrator`; what the second integration costs is not counted."""
        self._integrator.started = self.started
        part = self._integrator.integrate(state, first_cycle, cycles)
        self.started = True
        if not self.extremes:
            return part
        if self._native is None:
            method = choose(AUTO, self._model, state).method
            self._native = NativeIntegrator(method, self._model, 0, self._tolerances)
            self._native.extremes = True
        extremes = no_extremes(self._model.layout)
        for cycle in range(len(part.samples) // self._samples):
            self._native.started = False
            again = self._native.integrate(part.samples[cycle * self._samples], first_cycle + cycle, 1)
            assert again.extremes is not None
            take_in(extremes, again.extremes)
        return part._replace(extremes=extremes)


def make_integrator(
    method: str, model: Model, samples: int, tolerances: StepTolerances, extremes: bool = False
) -> Integrator:
    """Return the integrator that a method's name stands for; `extremes` says whether they are sought."""
    integrator = integrator_class(method)(method, model, samples, tolerances)
    if runs(method) is not Runs.NATIVE:
        integrator = MarchedAgain(integrator, model, samples, tolerances)
    integrator.extremes = extremes
    return integrator


def cycles_at_once(method: str, cycles: int, samples: int, steps: int = 0, done: int = 0) -> int:
    """Mesh cycles between two writes: up to a quarter of a native run, else 1, as a cycle is slow.

    The steps that the cycles done took say how many of them are worth a write. No result depends on it.
    """
    if runs(method) is not Runs.NATIVE:
        return 1
    allowed = MAXIMUM_STEPS * done // steps if steps else FIRST_CYCLES
    return max(1, min(cycles // 4, MAXIMUM_CYCLES, MAXIMUM_SAMPLES // max(samples, 1), allowed))


def transient(
    model: Model, state: Float[Array, " state"], settings: TransientSettings
) -> Iterator[SampledStates | Stop]:
    """Integrate from a state at phase 0, behind the engagement there; yields samples, and a `Stop` last.

    A complete run has cycles × samples + 1 samples, the last one at the start of the next mesh cycle, after
    its engagement. A run that stops early yields what it has and says why in `Stop.reason`.
    """
    tolerances = tolerances_from(model, state, settings.rtol, settings.max_steps)
    integrator = make_integrator(settings.method, model, settings.samples, tolerances, settings.extremes)
    cycle_time = float(model.operation.pitch_angle) / model.operation.nominal_speed
    opening = settings.cycles - settings.window
    steps = evaluations = done = 0
    while done < settings.cycles:
        end = settings.cycles if done >= opening else opening
        size = cycles_at_once(settings.method, settings.cycles, settings.samples, steps, done)
        count = min(size, end - done)
        part = integrator.integrate(state, done, count)
        steps += part.steps
        evaluations += part.evaluations
        at = done + np.arange(len(part.samples)) / settings.samples
        finite = np.all(np.isfinite(part.samples), axis=1)
        kept = len(finite) if finite.all() else int(np.argmin(finite))
        yield SampledStates(at[:kept], part.samples[:kept], part.evaluations, part.steps, part.extremes)
        if part.status != Status.DONE or kept < len(finite):
            reached = done + part.reached
            reason = REASONS[Status.NOT_FINITE if part.status == Status.DONE else part.status]
            reason = f"{reason} ({part.message})" if part.message else reason
            last = part.samples[kept - 1] if kept else state
            yield Stop(
                last,
                reached,
                steps,
                evaluations,
                reason,
                reached * cycle_time + float(last[model.layout.lag]),
            )
            return
        state = part.state
        done += count
    state = state.copy()
    engage_next(state, done, model)
    yield SampledStates(np.array([float(done)]), state[None], 0, 0)
    yield Stop(state, float(done), steps, evaluations, "", done * cycle_time + float(state[model.layout.lag]))
