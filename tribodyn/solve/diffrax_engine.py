"""diffrax's solvers (Tsit5, Dopri8, Kvaerno5) on the same right-hand side, through JAX.

The reference solver, the stiff choice, and the way to gradients and to a GPU. A block of cycles is one
compiled function: a scan over segments, each solved from boundary to boundary with the segment passed
explicitly, so that no number of the scenario is compiled in.
"""

import os
from functools import lru_cache, partial
from itertools import pairwise
from typing import Any

# the error branch of equinox cannot be cached between processes; NaNs are checked for below instead
os.environ.setdefault("EQX_ON_ERROR", "nan")

import diffrax
import jax
import jax.numpy as jnp
import numpy as np

from tribodyn.dynamics.equations import derivatives, engagement
from tribodyn.dynamics.parameters import (
    SLIP,
    STATES,
    WORK_IN,
    WORK_PARAMETRIC,
    XI_RATE,
    Model,
    Options,
)
from tribodyn.solve.engine import DONE, NOT_FINITE, STALLED, TOO_MANY_STEPS, Block, Tolerances
from tribodyn.tribology.contact import logarithms

jax.config.update("jax_enable_x64", True)

SOLVERS = {"tsit5": diffrax.Tsit5, "dopri8": diffrax.Dopri8, "kvaerno5": diffrax.Kvaerno5}
EXPLICIT = ("tsit5", "dopri8")


@lru_cache(maxsize=1)
def use_compilation_cache() -> None:
    """Keep XLA's compiled code between processes, beside the native kernel's."""
    from platformdirs import user_cache_path

    folder = os.environ.get("TRIBODYN_CACHE") or user_cache_path("tribodyn")
    jax.config.update("jax_compilation_cache_dir", os.path.join(folder, "xla"))
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


@partial(jax.jit, static_argnames=("method", "options", "cycles", "most"))
def march_segments(
    method, options, cycles, most, numbers, y, first_cycle, restart, at, rtol, atol, max_steps
):
    """Scan over the segments of `cycles` cycles; `at` (segments, most) holds each segment's sample phases."""
    table, mechanics, contact = numbers
    model = Model(table, mechanics, contact, options, logarithms(contact))
    segments = table.in_contact.shape[0]
    if method in EXPLICIT:
        controller = diffrax.PIDController(rtol=rtol, atol=atol, pcoeff=0.2, icoeff=0.4)
    else:
        controller = diffrax.PIDController(rtol=rtol, atol=atol)

    def one(carry, index):
        kept, dead = carry
        y = kept
        segment = index % segments
        cycle = first_cycle + index // segments
        start, end = table.boundary[segment], table.boundary[segment + 1]
        jumped = _engaged(y, (segment - 1) % segments, segment, model)
        y = jnp.where((index > 0) | restart, jumped, y)
        # a case that failed waits for the others of its batch at a harmless state, over next to nothing
        y = jnp.where(dead, 0.0, y)
        end = jnp.where(dead, start + 1e-9 * (end - start), end)
        solution = diffrax.diffeqsolve(
            diffrax.ODETerm(right_hand_side),
            SOLVERS[method](),
            start,
            end,
            (end - start) * 1e-3,
            y,
            args=(cycle.astype(float), segment, model),
            saveat=diffrax.SaveAt(ts=jnp.where(dead, start, at[segment]), t1=True),
            stepsize_controller=controller,
            max_steps=None,
            throw=False,
            event=diffrax.Event(lambda t, y, args, **kwargs: mechanics.nominal_speed + y[SLIP] <= 0.0),
        )
        states: Any = solution.ys
        reached = solution.stats["num_steps"]
        failed = (
            (solution.result != diffrax.RESULTS.successful)
            | ~jnp.all(jnp.isfinite(states[-1]))
            | (reached > max_steps)
        )
        stalled = solution.result == diffrax.RESULTS.event_occurred
        return (jnp.where(dead, kept, states[-1]), dead | failed), (
            states[:-1],
            jnp.asarray(failed),
            stalled,
            reached,
            states[-1],
        )

    return jax.lax.scan(one, (y, jnp.asarray(False)), jnp.arange(cycles * segments))


def sample_phases(boundary: np.ndarray, samples: int) -> tuple[np.ndarray, list[int]]:
    """Phases of the samples in every segment, filled up with its end, and how many are samples.

    Filled up to the whole cycle's number, so that another contact ratio compiles nothing again.
    """
    phases = np.arange(samples) / max(samples, 1)
    groups = [phases[(phases >= a) & (phases < b)] for a, b in pairwise(boundary)]
    filled = [
        np.append(group, np.full(max(samples, 1) - len(group), end))
        for group, end in zip(groups, boundary[1:], strict=True)
    ]
    return np.array(filled), [len(group) for group in groups]


def outcome(
    samples: np.ndarray,
    failed: np.ndarray,
    stalled: np.ndarray,
    steps: np.ndarray,
    boundary: np.ndarray,
    counts: list[int],
    cycles: int,
    max_steps: int,
    method: str,
) -> Block:
    """What `march_segments` brought, less the state: samples up to the first segment that failed, and why."""
    segments = len(counts)
    kept = []
    status, reached = DONE, float(cycles)
    for index in range(cycles * segments):
        if failed[index]:
            status = STALLED if stalled[index] else NOT_FINITE
            if steps[index] > max_steps:
                status = TOO_MANY_STEPS
            reached = index // segments + float(boundary[index % segments])
            break
        kept.append(samples[index, : counts[index % segments]])
    done = int(np.sum(steps[: len(kept)]))
    stages = {"tsit5": 6, "dopri8": 13, "kvaerno5": 7}[method]
    found = np.concatenate(kept) if kept else np.empty((0, STATES))
    return Block(found, np.full(STATES, np.nan), status, reached, done, done * stages)


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
        self.numbers = jax.tree.map(jnp.asarray, (model.table, model.mechanics, model.contact))
        at, self.counts = sample_phases(np.asarray(model.table.boundary), samples)
        self.at = jnp.asarray(at)
        self.tolerances = tolerances
        self.started = False

    def block(self, state: np.ndarray, first_cycle: int, cycles: int) -> Block:
        """See `engine.Engine`."""
        (y, _), (samples, failed, stalled, steps, _) = march_segments(
            self.method,
            self.options,
            cycles,
            self.at.shape[1],
            self.numbers,
            jnp.asarray(state),
            first_cycle,
            self.started,
            self.at,
            self.tolerances.rtol,
            jnp.asarray(self.tolerances.atol),
            self.tolerances.max_steps,
        )
        self.started = True
        return outcome(
            np.asarray(samples),
            np.asarray(failed),
            np.asarray(stalled),
            np.asarray(steps),
            np.asarray(self.numbers[0].boundary),
            self.counts,
            cycles,
            self.tolerances.max_steps,
            self.method,
        )._replace(state=np.array(y))
