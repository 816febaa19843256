"""diffrax's solvers (Tsit5, Dopri8, Kvaerno5) on the same right-hand side, through JAX.

The reference solver, the stiff choice, and the way to gradients and to a GPU. A mesh cycle is one compiled
function: a scan over intervals, each solved from end to end with the interval passed explicitly, so
that no number of the scenario is compiled in. Steps end where friction reverses, as the native ones do.
"""

import os
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, NamedTuple

# the error branch of equinox cannot be cached between processes; NaNs are checked for below instead
os.environ.setdefault("EQX_ON_ERROR", "nan")

import diffrax
import jax
import jax.numpy as jnp
import numpy as np

from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import DRIVE_SPEED, SLIDING_DYNAMIC, Model, Options
from tribodyn.errors import InputError
from tribodyn.numerics.files.cache import use_compilation_cache
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.integrator import IntegratedCycles, Status
from tribodyn.solve.jax.controllers import GROWN, LimitedSteps, TurningSteps
from tribodyn.solve.march.reversal import SHARES, filled_up, stops_of_many
from tribodyn.solve.march.step_control import (
    FIRST_STEP,
    MINIMUM_STEP,
    STANDSTILL,
    relative_factor,
    resolves_turns,
)
from tribodyn.solve.right_hand_side import contacts_of, engaged
from tribodyn.solve.tolerances import StepTolerances
from tribodyn.train.schedule import Schedule, intervals, sample_phases

jax.config.update("jax_enable_x64", True)

#: Fills up the phases to sample: it passes diffrax's checks and is never due.
NEVER = np.nan
#: Samples that the compiled code has room for in an interval, or a multiple.
ROOM = 256


def right_hand_side(phase: Any, y: Any, args: Any) -> Any:
    """Derivative of the state as a JAX array; `args` is (cycle, interval, model)."""
    cycle, interval, model = args
    return _rates(phase, y, cycle, interval, model[:-1], model.options)


@partial(jax.jit, static_argnames="options")
def _rates(phase: Any, y: Any, cycle: Any, interval: Any, numbers: Any, options: Options) -> Any:
    """Traced once, however often a method's stages name it."""
    rates: dict[int, Any] = {}
    try:
        model = Model(*numbers, options=options)
        derivatives(phase, cycle, interval, y, model, contacts_of(model), rates)
    except (jax.errors.TracerArrayConversionError, jax.errors.ConcretizationTypeError) as error:
        rule = "a law calls what JAX cannot trace, such as functions of numpy"
        remedy = "write it with tribodyn.numerics.elementary, or solve natively"
        raise InputError("solver.method", None, rule, remedy) from error
    return jnp.stack([jnp.asarray(rates[i], dtype=y.dtype) for i in range(options.layout.states)])


class DiffraxMethod(NamedTuple):
    """A solver of diffrax."""

    solver: Callable[[], Any]
    #: evaluations of the right-hand side in a step, without those of an implicit method's iteration
    stages: int
    proportional: float  # this and the next: gains of the step-size controller
    integral: float


METHODS = {
    "tsit5": DiffraxMethod(diffrax.Tsit5, 6, 0.2, 0.4),
    "dopri8": DiffraxMethod(diffrax.Dopri8, 13, 0.2, 0.4),
    "kvaerno5": DiffraxMethod(diffrax.Kvaerno5, 7, 0.0, 1.0),
}


class Carried(NamedTuple):
    """What is handed from one interval to the next; all with leading axes for the cases of a batch."""

    #: at the end of the interval before; of a run that failed where the last whole one ended
    y: Float[Array, "*case state"]
    step: Float[Array, "*case"]  # first step to try, mesh cycles
    steps: Int[Array, "*case"]  # accepted in this mesh cycle so far
    status: Int[Array, "*case"]  # a `Status`


class IntervalControl(NamedTuple):
    """How to integrate, interval by interval; with a leading axis for the cases of a batch."""

    within: Int[Array, "*case place"]  # numbers of intervals in a cycle, up to the most of any
    at: Float[Array, "*case interval room"]  # phases to sample, filled up with `NEVER`
    stops: Float[Array, "*case interval stop"]  # phases that steps end on
    rtol: Float[Array, "*case"]
    atol: Float[Array, "*case state"]
    max_steps: Int[Array, "*case"]  # steps allowed in one mesh cycle


class IntervalResult(NamedTuple):
    """What became of a cycle's intervals: their samples, as many as were due, and what they cost."""

    samples: Float[Array, "*case place room state"]
    status: Int[Array, "*case place"]
    steps: Int[Array, "*case place"]
    evaluations: Int[Array, "*case place"]


def over_cycle(
    method: DiffraxMethod,
    options: Options,
    numbers: Any,
    carried: Carried,
    cycle: Any,
    started: Any,
    control: IntervalControl,
) -> tuple[Carried, IntervalResult]:
    """Integrate over one mesh cycle: a scan over its intervals, each solved from end to end.

    `numbers` are the model's but for its options; `started` says whether the engagement at phase 0 comes
    first.
    """
    model = Model(*numbers, options=options)
    schedule, layout = model.schedule, options.layout
    slip = layout.half + layout.lag
    relative = np.array([relative_factor(i, layout) for i in range(layout.states)])
    pid: Any = diffrax.PIDController(
        control.rtol * relative,
        control.atol,
        pcoeff=method.proportional,
        icoeff=method.integral,
        dtmin=MINIMUM_STEP,
        force_dtmin=False,
    )
    if options.sliding == SLIDING_DYNAMIC:
        pid = TurningSteps(pid, resolves_turns(control.atol, model))
    stall = None
    if options.drive != DRIVE_SPEED:
        stall = diffrax.Event(lambda t, y, args, **kwargs: model.operation.nominal_speed + y[slip] <= 0.0)

    first = jnp.asarray(schedule.first).astype(int)
    cycle_of_period = jnp.asarray(cycle).astype(int) % (first.shape[0] - 1)
    opening, closing = first[cycle_of_period], first[cycle_of_period + 1]

    def over_interval(carried: Carried, k: Any) -> tuple[Carried, IntervalResult]:
        # a cycle of fewer intervals than another of the period waits for the rest of the scan
        interval = jnp.minimum(opening + k, closing - 1)
        beyond = opening + k >= closing
        dead = (carried.status != Status.DONE) | beyond
        start, end = schedule.start[interval], schedule.end[interval]
        y = jnp.stack(engaged(interval, (k > 0) | started, carried.y, model))
        # a case that failed waits for the others of its batch at a harmless state, over next to nothing
        y = jnp.where(dead, 0.0, y)
        end = jnp.where(dead, start + 1e-9 * (end - start), end)
        at = jnp.where(dead, NEVER, control.at[interval])
        clipped = diffrax.ClipStepSizeController(pid, step_ts=control.stops[interval])
        solution = diffrax.diffeqsolve(
            diffrax.ODETerm(right_hand_side),
            method.solver(),
            start,
            end,
            jnp.minimum(carried.step, end - start),
            y,
            args=(jnp.asarray(cycle, dtype=float), interval, model),
            saveat=diffrax.SaveAt(ts=at, t1=True),
            stepsize_controller=LimitedSteps(clipped, control.max_steps - carried.steps),
            max_steps=None,
            throw=False,
            event=stall,
        )
        states: Any = solution.ys
        last = states[jnp.sum(jnp.isfinite(at))]  # the end stands behind the samples that were due
        accepted = solution.stats["num_accepted_steps"]
        steps = carried.steps + accepted
        status = jnp.where(jnp.all(jnp.isfinite(last)), Status.DONE, Status.NOT_FINITE)
        failures = (
            (diffrax.RESULTS.dt_min_reached, Status.STEP_TOO_SMALL),
            (diffrax.RESULTS.event_occurred, Status.STALLED),
            (diffrax.RESULTS.max_steps_reached, Status.TOO_MANY_STEPS),
            (GROWN, Status.UNBOUNDED),
        )
        status = jnp.where(solution.result == diffrax.RESULTS.successful, status, Status.NOT_FINITE)
        for result, meaning in failures:
            status = jnp.where(solution.result == result, meaning, status)
        if stall is not None:
            ts: Any = solution.ts
            reached = states[jnp.maximum(jnp.sum(jnp.isfinite(ts)) - 1, 0)]
            slow = model.operation.nominal_speed + reached[slip] < STANDSTILL * model.operation.nominal_speed
            status = jnp.where((status == Status.STEP_TOO_SMALL) & slow, Status.STALLED, status)
        status = jnp.where(dead, carried.status, status)
        good = (status == Status.DONE) & ~beyond
        mean_step = (end - start) / jnp.maximum(accepted, 1)
        went_on = Carried(
            jnp.where(good, last, carried.y),
            jnp.where(good, mean_step, carried.step),
            jnp.where(good, steps, carried.steps),
            status,
        )
        counted = jnp.minimum(
            accepted, control.max_steps - carried.steps
        )  # the step too many is counted there
        cost = jnp.where(dead, 0, solution.stats["num_steps"] * method.stages)
        return went_on, IntervalResult(states[:-1], status, jnp.where(dead, 0, counted), cost)

    return jax.lax.scan(over_interval, carried._replace(steps=jnp.zeros_like(carried.steps)), control.within)


over_one_cycle = jax.jit(over_cycle, static_argnames=("method", "options"))


def beginning(state: Float[Array, "*case state"]) -> Carried:
    """What is handed to the first interval; leading axes are those of the state.

    Of the types that a mesh cycle hands on: a plain number's weak one would compile everything once more.
    """
    shape = state.shape[:-1]
    none = jnp.zeros(shape, dtype=int)
    step = jnp.full(shape, FIRST_STEP, dtype=float)
    return Carried(jnp.asarray(state, dtype=float), step, none, none + Status.DONE)


def padded_phases(schedule: Schedule, samples: int) -> tuple[Float[Array, "interval room"], list[int]]:
    """Phases of the samples in every interval, filled up with `NEVER`, and how many are samples.

    The room is a multiple of `ROOM`, so that neither another contact ratio nor another number of samples
    compiles anything again.
    """
    groups = sample_phases(schedule, samples)
    room = ROOM * max(1, -(-samples // ROOM))
    filled = [np.append(group, np.full(room - len(group), NEVER)) for group in groups]
    return np.array(filled), [len(group) for group in groups]


def places_in_cycle(schedule: Schedule) -> Int[Array, " place"]:
    """Numbers of intervals in a reference cycle, up to the most of any."""
    return np.arange(int(max(np.diff(schedule.first).tolist())))


def steps_end_on(models: Sequence[Model]) -> Float[Array, "case interval stop"]:
    """Phases that steps end on, see `reversal.stops`; their number depends on the pair slots only."""
    count = 1 + len(SHARES) * sum(mesh.table.side.shape[0] for mesh in models[0].meshes)
    return filled_up(stops_of_many(models), count)


class DiffraxIntegrator:
    """Integrates with diffrax; see `integrator.Integrator`."""

    def __init__(self, method: str, model: Model, samples: int, tolerances: StepTolerances):
        use_compilation_cache()
        self.method = METHODS[method]
        self.options: Options = model.options
        self.numbers = jax.tree.map(partial(jnp.asarray, dtype=float), model.numbers)
        self.schedule = model.schedule
        at, self.counts = padded_phases(model.schedule, samples)
        self.control = IntervalControl(
            jnp.asarray(places_in_cycle(model.schedule)),
            jnp.asarray(at),
            jnp.asarray(steps_end_on([model])[0]),
            jnp.asarray(tolerances.rtol, dtype=float),
            jnp.asarray(tolerances.atol, dtype=float),
            jnp.asarray(tolerances.max_steps, dtype=int),
        )
        self.step = FIRST_STEP
        self.started = False

    def integrate(self, state: Float[Array, " state"], first_cycle: int, cycles: int) -> IntegratedCycles:
        """See `integrator.Integrator`."""
        carried = beginning(state)._replace(step=jnp.asarray(self.step, dtype=float))
        samples, reached, steps, evaluations = [np.empty((0, state.shape[-1]))], 0.0, 0, 0
        for cycle in range(first_cycle, first_cycle + cycles):
            numbers = intervals(self.schedule, cycle)
            carried, marched = over_one_cycle(
                self.method, self.options, self.numbers, carried, cycle, self.started, self.control
            )
            self.started = True
            status, sampled = np.asarray(marched.status)[: len(numbers)], np.asarray(marched.samples)
            failed = status != Status.DONE
            whole = int(np.argmax(failed)) if failed.any() else len(numbers)
            samples += [sampled[k, : self.counts[numbers[k]]] for k in range(whole)]
            steps += int(np.sum(marched.steps))
            evaluations += int(np.sum(marched.evaluations))
            reached += (
                1.0 if whole == len(numbers) else float(np.asarray(self.schedule.start)[numbers[whole]])
            )
            if whole < len(numbers):
                break
        self.step = float(carried.step)
        status = Status(int(carried.status))
        return IntegratedCycles(
            np.concatenate(samples), np.array(carried.y), status, reached, steps, evaluations
        )
