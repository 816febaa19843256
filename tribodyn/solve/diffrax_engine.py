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
def _march(method, options, cycles, most, numbers, y, first_cycle, restart, at, rtol, atol, max_steps):
    """Scan over the segments of `cycles` cycles; `at` (segments, most) holds each segment's sample phases."""
    table, mechanics, contact = numbers
    model = Model(table, mechanics, contact, options, logarithms(contact))
    segments = table.in_contact.shape[0]
    if method in EXPLICIT:
        controller = diffrax.PIDController(rtol=rtol, atol=atol, pcoeff=0.2, icoeff=0.4)
    else:
        controller = diffrax.PIDController(rtol=rtol, atol=atol)

    def one(carry, index):
        y, dead = carry
        segment = index % segments
        cycle = first_cycle + index // segments
        start, end = table.boundary[segment], table.boundary[segment + 1]
        jumped = _engaged(y, (segment - 1) % segments, segment, model)
        y = jnp.where((index > 0) | restart, jumped, y)
        solution = diffrax.diffeqsolve(
            diffrax.ODETerm(right_hand_side),
            SOLVERS[method](),
            start,
            end,
            (end - start) * 1e-3,
            y,
            args=(cycle.astype(float), segment, model),
            saveat=diffrax.SaveAt(ts=at[segment], t1=True),
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
        return (jnp.where(dead, y, states[-1]), dead | failed), (
            states[:-1],
            jnp.asarray(failed),
            stalled,
            reached,
            states[-1],
        )

    return jax.lax.scan(one, (y, jnp.asarray(False)), jnp.arange(cycles * segments))


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
        boundary = np.asarray(model.table.boundary)
        phases = np.arange(samples) / samples
        groups = [phases[(phases >= a) & (phases < b)] for a, b in pairwise(boundary)]
        self.counts = [len(group) for group in groups]
        # padded to the whole cycle, so that another contact ratio compiles nothing again
        self.most = samples
        self.at = jnp.asarray(
            [np.append(g, np.full(self.most - len(g), b)) for g, b in zip(groups, boundary[1:], strict=True)]
        )
        self.tolerances = tolerances
        self.started = False

    def block(self, state: np.ndarray, first_cycle: int, cycles: int) -> Block:
        """See `engine.Engine`."""
        (y, _), (samples, failed, stalled, steps, _) = _march(
            self.method,
            self.options,
            cycles,
            self.most,
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
        samples, failed, stalled, steps = (np.asarray(x) for x in (samples, failed, stalled, steps))
        segments = len(self.counts)
        kept = []
        status, reached = DONE, float(cycles)
        for index in range(cycles * segments):
            if failed[index]:
                status = STALLED if stalled[index] else NOT_FINITE
                if steps[index] > self.tolerances.max_steps:
                    status = TOO_MANY_STEPS
                reached = index // segments + float(self.numbers[0].boundary[index % segments])
                break
            kept.append(samples[index, : self.counts[index % segments]])
        done = int(np.sum(steps[: len(kept)]))
        stages = {"tsit5": 6, "dopri8": 13, "kvaerno5": 7}[self.method]
        return Block(
            np.concatenate(kept) if kept else np.empty((0, STATES)),
            np.array(y),
            status,
            reached,
            done,
            done * stages,
        )
