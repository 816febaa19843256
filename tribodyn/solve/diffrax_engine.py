"""diffrax's solvers (Tsit5, Dopri8, Kvaerno5) on the same right-hand side, through JAX.

The reference solver, the stiff choice, and the way to gradients and to a GPU. A mesh cycle is one compiled
function: a scan over segments, each solved from boundary to boundary with the segment passed explicitly, so
that no number of the scenario is compiled in. Steps end where friction reverses, as the native ones do.
"""

import os
from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Any, NamedTuple

# the error branch of equinox cannot be cached between processes; NaNs are checked for below instead
os.environ.setdefault("EQX_ON_ERROR", "nan")

import diffrax
import jax
import jax.numpy as jnp
import numpy as np

from tribodyn.dynamics.equations import derivatives, engagement
from tribodyn.dynamics.parameters import (
    DRIVE_SPEED,
    SLIP,
    STATES,
    WORK_IN,
    WORK_PARAMETRIC,
    XI_RATE,
    Model,
    Options,
)
from tribodyn.numerics.cache import cache_folder
from tribodyn.solve.dormand_prince import FIRST_STEP, LEAST_STEP
from tribodyn.solve.engine import DONE, NOT_FINITE, STALLED, STEP_TOO_SMALL, TOO_MANY_STEPS, Block, Tolerances
from tribodyn.solve.reversal import SHARES, filled_up, stops_of_many

jax.config.update("jax_enable_x64", True)

SOLVERS = {"tsit5": diffrax.Tsit5, "dopri8": diffrax.Dopri8, "kvaerno5": diffrax.Kvaerno5}
EXPLICIT = ("tsit5", "dopri8")
#: Fills up the phases to sample: it passes diffrax's checks and is never due.
NEVER = np.nan
#: Samples that the compiled code has room for in a segment, or a multiple.
ROOM = 256


@lru_cache(maxsize=1)
def use_compilation_cache() -> None:
    """Keep XLA's compiled code between processes, beside the native kernel's."""
    jax.config.update("jax_compilation_cache_dir", str(cache_folder() / "xla"))
    jax.config.update("jax_persistent_cache_min_compile_time_secs", 0.2)


def right_hand_side(phase: Any, y: Any, args: Any) -> Any:
    """Derivative of the state as a JAX array; `args` is (cycle, segment, model)."""
    cycle, segment, model = args
    rates: dict[int, Any] = {}
    derivatives(phase, cycle, segment, y, model, {}, rates)
    return jnp.stack([jnp.asarray(rates[i], dtype=y.dtype) for i in range(STATES)])


def _engaged(y: Any, before: Any, segment: Any, model: Model) -> Any:
    boundary = model.table.boundary
    slip, xi_rate, work_in, parametric = engagement(
        before, boundary[before + 1], segment, boundary[segment], y, model, {}
    )
    return (
        y.at[SLIP]
        .add(slip)
        .at[XI_RATE]
        .add(xi_rate)
        .at[WORK_IN]
        .add(work_in)
        .at[WORK_PARAMETRIC]
        .add(parametric)
    )


class Carried(NamedTuple):
    """What is handed from one segment to the next.

    Attributes
    ----------
    y : (STATES,)
        At the end of the segment before; of a run that failed where the last whole segment ended.
    step : first step to try, mesh cycles
    steps : accepted in this mesh cycle so far
    status : `engine.DONE` or the kind of failure
    """

    y: Any
    step: Any
    steps: Any
    status: Any


class How(NamedTuple):
    """How to integrate, segment by segment."""

    at: Any  # (S, most), phases to sample, filled up with NEVER
    stops: Any  # (S, n), phases that steps end on
    rtol: Any
    atol: Any  # (STATES,)
    max_steps: Any


class Segment(NamedTuple):
    """What became of a segment: its samples, as many as were due, and what they cost."""

    samples: Any  # (most, STATES)
    status: Any
    steps: Any
    evaluations: Any


def over_cycle(
    method: str, options: Options, numbers: Any, carried: Carried, cycle: Any, restart: Any, how: How
) -> tuple[Carried, Segment]:
    """Integrate over one mesh cycle: a scan over its segments, each solved from boundary to boundary.

    `restart` says whether the engagement at phase 0 comes first; `Segment` gets a leading axis of segments.
    """
    model = Model(*numbers, options=options)
    table, mechanics = model.table, model.mechanics
    segments = table.in_contact.shape[0]
    gains = (0.2, 0.4) if method in EXPLICIT else (0.0, 1.0)
    pid = diffrax.PIDController(
        how.rtol, how.atol, pcoeff=gains[0], icoeff=gains[1], dtmin=LEAST_STEP, force_dtmin=False
    )
    stall = None
    if options.drive != DRIVE_SPEED:
        stall = diffrax.Event(lambda t, y, args, **kwargs: mechanics.nominal_speed + y[SLIP] <= 0.0)

    def one(carried: Carried, segment: Any) -> tuple[Carried, Segment]:
        dead = carried.status != DONE
        start, end = table.boundary[segment], table.boundary[segment + 1]
        jumped = _engaged(carried.y, (segment - 1) % segments, segment, model)
        y = jnp.where((segment > 0) | restart, jumped, carried.y)
        # a case that failed waits for the others of its batch at a harmless state, over next to nothing
        y = jnp.where(dead, 0.0, y)
        end = jnp.where(dead, start + 1e-9 * (end - start), end)
        at = jnp.where(dead, NEVER, how.at[segment])
        solution = diffrax.diffeqsolve(
            diffrax.ODETerm(right_hand_side),
            SOLVERS[method](),
            start,
            end,
            jnp.minimum(carried.step, end - start),
            y,
            args=(jnp.asarray(cycle, dtype=float), segment, model),
            saveat=diffrax.SaveAt(ts=at, t1=True),
            stepsize_controller=diffrax.ClipStepSizeController(pid, step_ts=how.stops[segment]),
            max_steps=None,
            throw=False,
            event=stall,
        )
        states: Any = solution.ys
        last = states[jnp.sum(jnp.isfinite(at))]  # the end stands behind the samples that were due
        accepted = solution.stats["num_accepted_steps"]
        steps = carried.steps + accepted
        status = jnp.where(jnp.all(jnp.isfinite(last)), DONE, NOT_FINITE)
        status = jnp.where(solution.result == diffrax.RESULTS.successful, status, NOT_FINITE)
        status = jnp.where(solution.result == diffrax.RESULTS.dt_min_reached, STEP_TOO_SMALL, status)
        status = jnp.where(solution.result == diffrax.RESULTS.event_occurred, STALLED, status)
        status = jnp.where((status == DONE) & (steps > how.max_steps), TOO_MANY_STEPS, status)
        status = jnp.where(dead, carried.status, status)
        good = status == DONE
        mean_step = (end - start) / jnp.maximum(accepted, 1)
        went_on = Carried(
            jnp.where(good, last, carried.y),
            jnp.where(good, mean_step, carried.step),
            jnp.where(good, steps, carried.steps),
            status,
        )
        stages = {"tsit5": 6, "dopri8": 13, "kvaerno5": 7}[method]
        cost = jnp.where(dead, 0, solution.stats["num_steps"] * stages)
        return went_on, Segment(states[:-1], status, jnp.where(good, accepted, 0), cost)

    return jax.lax.scan(one, carried._replace(steps=jnp.zeros_like(carried.steps)), jnp.arange(segments))


over_one_cycle = jax.jit(over_cycle, static_argnames=("method", "options"))


def beginning(state: np.ndarray) -> Carried:
    """What is handed to the first segment; leading axes are those of the state."""
    shape = state.shape[:-1]
    none = jnp.zeros(shape, dtype=int)
    return Carried(jnp.asarray(state, dtype=float), jnp.full(shape, FIRST_STEP), none, none + DONE)


def sample_phases(boundary: np.ndarray, samples: int) -> tuple[np.ndarray, list[int]]:
    """Phases of the samples in every segment (S, most), filled up with `NEVER`, and how many are samples.

    `most` is a multiple of `ROOM`, so that neither another contact ratio nor another number of samples
    compiles anything again.
    """
    phases = np.arange(samples) / max(samples, 1)
    groups = [phases[(phases >= a) & (phases < b)] for a, b in pairwise(boundary)]
    most = ROOM * max(1, -(-samples // ROOM))
    filled = [np.append(group, np.full(most - len(group), NEVER)) for group in groups]
    return np.array(filled), [len(group) for group in groups]


def steps_end_on(models: Sequence[Model]) -> np.ndarray:
    """Phases (C, S, n) that steps end on, see `reversal.stops`, with an n that only the pair slots decide."""
    most = 1 + len(SHARES) * np.asarray(models[0].table.in_contact).shape[1]
    return filled_up(stops_of_many(models), most)


class DiffraxEngine:
    """Integrates with diffrax; see `engine.Engine`.

    Parameters
    ----------
    method : {"tsit5", "dopri8", "kvaerno5"}
    model : Model
    samples : int
        Samples per mesh cycle.
    tolerances : Tolerances
    """

    def __init__(self, method: str, model: Model, samples: int, tolerances: Tolerances):
        use_compilation_cache()
        self.method = method
        self.options: Options = model.options
        self.numbers = jax.tree.map(jnp.asarray, model.numbers)
        at, self.counts = sample_phases(np.asarray(model.table.boundary), samples)
        self.how = How(
            jnp.asarray(at),
            jnp.asarray(steps_end_on([model])[0]),
            tolerances.rtol,
            jnp.asarray(tolerances.atol),
            tolerances.max_steps,
        )
        self.boundary = np.asarray(model.table.boundary)
        self.step = FIRST_STEP
        self.started = False

    def block(self, state: np.ndarray, first_cycle: int, cycles: int) -> Block:
        """See `engine.Engine`."""
        carried = beginning(state)._replace(step=self.step)
        samples, reached, steps, evaluations = [np.empty((0, STATES))], 0.0, 0, 0
        for cycle in range(first_cycle, first_cycle + cycles):
            carried, segments = over_one_cycle(
                self.method, self.options, self.numbers, carried, cycle, self.started, self.how
            )
            self.started = True
            status, found = np.asarray(segments.status), np.asarray(segments.samples)
            whole = len(status) if status[-1] == DONE else int(np.argmax(status != DONE))
            samples += [found[k, : self.counts[k]] for k in range(whole)]
            steps += int(np.sum(segments.steps))
            evaluations += int(np.sum(segments.evaluations))
            reached += float(self.boundary[whole])
            if whole < len(status):
                break
        self.step = float(carried.step)
        found, end = np.concatenate(samples), np.array(carried.y)
        return Block(found, end, int(carried.status), reached, steps, evaluations)
