"""A step-size controller of diffrax that lets friction turn in short steps, by the rule of `turning`."""

from functools import partial
from typing import Any

import jax
import jax.numpy as jnp

from tribodyn.dynamics.contact_forces import (
    FRICTION_FORCE,
    TURNED,
    contact_forces,
)
from tribodyn.dynamics.equations import locate
from tribodyn.dynamics.parameters import Model, Options
from tribodyn.solve.jax.wrapped_steps import WrappedSteps
from tribodyn.solve.march.turning import MOST_TRIES, begin_turning, keep_turned, longest_step, turn_of


class TurningSteps(WrappedSteps):
    """Wraps a controller; a step that turns friction too far is tried again, shorter.

    Parameters
    ----------
    applies : whether the tolerance sees friction turn, see `turning.resolves_turns`
    """

    applies: Any

    def wrap(self, direction: Any) -> "TurningSteps":
        """Return the controller for times that run in a direction."""
        return TurningSteps(self.controller.wrap(direction), self.applies)

    def init(self, *arguments: Any) -> tuple[Any, Any]:
        """First step, and the state: that of the controller inside, and no try."""
        first, inside = self.controller.init(*arguments)
        return first, (inside, jnp.zeros(()))

    def adapt_step_size(
        self,
        t0: Any,
        t1: Any,
        y0: Any,
        y1_candidate: Any,
        args: Any,
        y_error: Any,
        error_order: Any,
        controller_state: Any,
    ) -> tuple[Any, ...]:
        """Call the inner controller, and see how far the step has turned friction."""
        inside, tries = controller_state
        keep, next_t0, next_t1, jump, inside, result = self.controller.adapt_step_size(
            t0, t1, y0, y1_candidate, args, y_error, error_order, inside
        )
        _, segment, model = args
        too_far, shorter, longest = _turned(t0, t1, y0, y1_candidate, segment, model[:-1], model.options)
        again = keep & too_far & self.applies & (tries < MOST_TRIES)
        longest = jnp.where(self.applies, longest, jnp.inf)
        next_t1 = jnp.where(keep, jnp.minimum(next_t1, next_t0 + longest), next_t1)
        next_t0, next_t1 = jnp.where(again, t0, next_t0), jnp.where(again, t0 + shorter, next_t1)
        tries = jnp.where(again, tries + 1.0, jnp.where(keep, 0.0, tries))
        return keep & ~again, next_t0, next_t1, jump, (inside, tries), result


@partial(jax.jit, static_argnames="options")
def _turned(
    t0: Any, t1: Any, y0: Any, y1: Any, segment: Any, numbers: Any, options: Options
) -> tuple[Any, Any, Any]:
    """Whether a step has turned friction too far, the step to try instead, the longest one after it."""
    model = Model(*numbers, options=options)
    work: dict[Any, Any] = {}
    begin_turning(t0, segment, y0, model, work)
    end: dict[Any, Any] = {}
    cell, u, cells_per_radian = locate(t1, segment, model.table)
    contact_forces(segment, cell, u, cells_per_radian, y1, model, end)
    work |= {key: value for key, value in end.items() if key[0] in (TURNED, FRICTION_FORCE)}
    step = t1 - t0
    too_far, shorter = turn_of(step, segment, model, work)
    keep_turned(True, step, segment, model, work)
    return too_far, shorter, longest_step(segment, model, work)
