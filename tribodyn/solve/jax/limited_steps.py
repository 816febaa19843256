"""A step-size controller of diffrax that ends an integration: after so many steps, or of a runaway motion."""

from typing import Any

import diffrax
import jax.numpy as jnp

from tribodyn.solve.jax.wrapped_steps import WrappedSteps
from tribodyn.solve.march.step_control import unbounded

#: What stands for a motion that grew without bound: diffrax has no result of its own for it, and gives this
#: one only where rejected steps are stored, which is not done here.
GROWN = diffrax.RESULTS.max_steps_rejected


class LimitedSteps(WrappedSteps):
    """Wraps a controller; the result is `max_steps_reached` where it would accept one step more than allowed.

    And `GROWN` where it would accept a step to a state that `step_control.unbounded` is true of.

    diffrax's own limit counts rejected steps too, and is compiled in.

    Parameters
    ----------
    allowed : accepted steps
    """

    allowed: Any

    def wrap(self, direction: Any) -> "LimitedSteps":
        """Return the controller for times that run in a direction."""
        return LimitedSteps(self.controller.wrap(direction), self.allowed)

    def init(self, *arguments: Any) -> tuple[Any, Any]:
        """First step, and the state: that of the controller inside, and no step accepted."""
        first, inside = self.controller.init(*arguments)
        return first, (inside, jnp.zeros((), dtype=int))

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
        """Call the inner controller, count, and see how far the motion is."""
        inside, accepted = controller_state
        keep, next_t0, next_t1, jump, inside, result = self.controller.adapt_step_size(
            t0, t1, y0, y1_candidate, args, y_error, error_order, inside
        )
        accepted = accepted + jnp.where(keep, 1, 0)
        over = (accepted > self.allowed) & (result == diffrax.RESULTS.successful)
        result = diffrax.RESULTS.where(over, diffrax.RESULTS.max_steps_reached, result)
        grown = keep & unbounded(y1_candidate, args[2].table) & (result == diffrax.RESULTS.successful)
        result = diffrax.RESULTS.where(grown, GROWN, result)
        return keep, next_t0, next_t1, jump, (inside, accepted), result
