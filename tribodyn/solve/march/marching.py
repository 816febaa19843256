"""The march of the native methods through mesh cycles: segments, steps and samples, the same for all.

A method is seven functions, see `Method`, and a buffer whose first two rows are the new state and its error;
`NativeIntegrator` puts it behind the interface of integrators.
"""

from collections.abc import Callable
from importlib import import_module
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import SLIDING_DYNAMIC, Model, with_shared_code
from tribodyn.kernels.native import kernel, packed
from tribodyn.numerics.elementary import largest_slope, maximum, minimum
from tribodyn.numerics.shapes import Array, Float
from tribodyn.solve.integrator import IntegratedCycles, March, Status
from tribodyn.solve.march import step_control as rules
from tribodyn.solve.march.extreme_search import Search
from tribodyn.solve.march.reversal import stops
from tribodyn.solve.right_hand_side import engage, interval_at, work_array
from tribodyn.solve.tolerances import StepTolerances
from tribodyn.train.layout import TrainLayout

#: Rows of a method's buffer: the new state and its error; the method's own rows follow.
STATE, ERROR, SCRATCH = 0, 1, 2


class Method(NamedTuple):
    """What a method adds to the march: seven kernels."""

    #: (fresh, step, place, y, control, model, work, buffer) -> int Fills the first two rows of the buffer and
    #: returns how many right-hand sides that took; `fresh` says that nothing is known yet at the place and
    #: `y`. It leaves `work` as it is at the end of the step.
    attempt: Callable[..., Any]
    #: (theta, step, y, buffer, out, layout); writes the state at the share `theta` of the step last attempted
    sample: Callable[..., Any]
    #: (buffer, layout) -> bool Keeps what the next step can use of an accepted one; returns whether that one
    #: begins fresh.
    accept: Callable[..., Any]
    adapted: Callable[..., Any]  # (step, error, last_error, buffer) -> float The next step to try.
    #: (phase, interval, model, work, buffer); fills `work` with the contacts at the end of the step last
    #: attempted, if it is not so yet
    contacts: Callable[..., Any]
    #: opened, stepped: What seeks extremes at the start of an interval and over an accepted step, see
    #: `extreme_search`: its `open_segment` and `search_step`, or `ignore_segment` and `ignore_step`.
    opened: Callable[..., Any]
    stepped: Callable[..., Any]


class Place(NamedTuple):
    """Where in the reference mesh: phase, whole cycles before, the interval, and the phase at its end."""

    phase: float
    cycle: float
    interval: int
    end: float


class Control(NamedTuple):
    """What the step control of one case needs."""

    step: float  # first step to try, mesh cycles
    last_error: float  # of the step before
    atol: Float[Array, " state"]  # absolute tolerances
    scale: Float[Array, " state"]  # sizes of the states
    stops: Float[Array, "interval stop"]  # phases that steps end on, see `reversal.stops`
    #: of derivatives with respect to the start, where numbers carry them, over the scale of the states
    slope_tolerance: float = 1.0


@kernel
def march_with(method, march, control, model, y, out, work, buffer, search):
    """Integrate mesh cycles from the state `y` at the end of the one before, which becomes the state reached.

    `out` (cycles · samples, states) receives the states at the samples of all cycles, whatever the window;
    `work` and `buffer` are scratch, from `right_hand_side.work_array` and the method's `buffer`; `search` is
    used where `march.extremes` says that they are sought. Returns status, cycles reached since the first,
    step and error to go on with, steps, evaluations, samples written.
    """
    samples, schedule, layout = march.samples, model.schedule, model.options.layout
    nominal_speed = model.operation.nominal_speed
    step = control.step
    steps = 0
    evaluations = 0
    written = 0
    last_error = control.last_error
    turning = model.options.sliding == SLIDING_DYNAMIC and rules.resolves_turns(control.atol, model)
    for cycle in range(march.cycles):
        whole = float(march.first_cycle + cycle)
        steps_before = steps
        opening = interval_at(march.first_cycle + cycle, model)
        closing = interval_at(march.first_cycle + cycle + 1, model)
        if closing <= opening:  # the last cycle of the common period
            closing = schedule.start.shape[0]
        for interval in range(opening, closing):
            phase = schedule.start[interval]
            end = schedule.end[interval]
            if interval > opening or march.started or cycle > 0:
                engage(interval, True, y, model, work, y)
            if written < (cycle + 1) * samples and (written - cycle * samples) / samples <= phase:
                for i in range(layout.states):
                    out[written, i] = y[i]
                written += 1
            if march.extremes:
                method.opened(True, Place(phase, whole, interval, end), y, model, work, search)
            if turning:
                rules.begin_turning(phase, interval, y, model, work)
            fresh = True
            stop, tries = 0, 0.0
            while phase < end:
                limit = control.stops[interval, stop]
                uncut_step = step
                cut, step = rules.cut_at_stop(phase, step, limit)
                taken, speed = steps - steps_before, nominal_speed + y[layout.half + layout.lag]
                failure = rules.refusal(taken, march.max_steps, step, speed, nominal_speed)
                if failure > 0.0:
                    return int(failure), cycle + phase, step, last_error, steps, evaluations, written
                place = Place(phase, whole, interval, end)
                evaluations += method.attempt(fresh, step, place, y, control, model, work, buffer)
                fresh = False
                new = buffer[STATE]
                worst, total = rules.collected_errors(buffer[ERROR], y, new, control.atol, march.rtol, layout)
                for i in range(layout.mechanical):  # of the derivatives, where numbers carry them
                    weighed = rules.weighed_error(
                        largest_slope(buffer[ERROR, i]),
                        largest_slope(y[i]),
                        largest_slope(new[i]),
                        control.slope_tolerance * control.scale[i],
                        control.slope_tolerance,
                    )
                    worst, total = rules.collected(worst, total, weighed)
                error = rules.step_error(worst, total)
                accepted, undefined, failure = rules.step_outcome(error, step, new, model)
                if failure > 0.0:
                    return int(failure), cycle + phase, step, last_error, steps, evaluations, written
                if undefined:
                    step *= rules.RETRY
                    continue
                if not accepted:
                    step = method.adapted(step, error, last_error, buffer)
                    continue
                if turning:
                    too_far, shorter = rules.turn_of_friction(step, interval, model, work)
                    if too_far and tries < rules.MOST_TRIES:
                        step, tries = shorter, tries + 1.0
                        continue
                    tries = 0.0
                    rules.keep_turned(True, step, interval, model, work)
                next_phase = limit if cut else phase + step
                while written < (cycle + 1) * samples:
                    at = (written - cycle * samples) / samples
                    if at >= end or at > next_phase:
                        break
                    method.sample((at - phase) / step, step, y, buffer, out[written], layout)
                    written += 1
                if march.extremes:
                    place = Place(phase, whole, interval, next_phase)
                    method.stepped(method, True, place, step, y, model, work, buffer, search)
                phase = next_phase
                for i in range(layout.states):
                    y[i] = new[i]
                fresh = method.accept(buffer, layout)
                steps += 1
                if cut:
                    stop += 1
                step = rules.next_step(method.adapted(step, error, last_error, buffer), cut, uncut_step)
                if turning:
                    step = minimum(step, rules.longest_step(interval, model, work))
                last_error = maximum(error, rules.MINIMUM_ERROR)
    return Status.DONE.value, float(march.cycles), step, last_error, steps, evaluations, written


def scratch_buffer(rows: int, layout: TrainLayout) -> Float[Array, "row state"]:
    """Buffer with so many rows of a method's own."""
    return np.zeros((SCRATCH + rows, layout.states))


class NativeIntegrator:
    """Integrates with the kernel of a module of `methods`; see `integrator.Integrator`."""

    def __init__(self, method: str, model: Model, samples: int, tolerances: StepTolerances):
        file = import_module(f"tribodyn.solve.methods.{method}")
        self._integrate, self._buffer = file.integrate, file.buffer(model.layout)
        self._work = work_array(model)
        self._model = packed(with_shared_code(model))
        self._stops = stops(model)
        self.samples = samples
        self.tolerances = tolerances
        self.extremes = False
        self._layout, self._pairs = model.layout, model.pairs
        self.step, self.last_error = rules.FIRST_STEP, rules.MINIMUM_ERROR
        self.started = False

    def integrate(self, state: Float[Array, " state"], first_cycle: int, cycles: int) -> IntegratedCycles:
        """See `integrator.Integrator`."""
        y = state.copy()
        out = np.empty((cycles * self.samples, self._layout.states))
        rtol, atol, max_steps = self.tolerances
        march = March(first_cycle, cycles, cycles, self.samples, self.started, rtol, max_steps, self.extremes)
        search = Search.begun(self._layout, self._pairs)
        control = Control(self.step, self.last_error, atol, atol / rtol, self._stops)
        status, reached, self.step, self.last_error, steps, evaluations, written = self._integrate(
            march, control, self._model, y, out, self._work, self._buffer, search
        )
        self.started = True
        extremes = search.extremes if self.extremes else None
        return IntegratedCycles(out[:written], y, Status(status), reached, steps, evaluations, "", extremes)
