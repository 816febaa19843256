"""Step-size controllers of diffrax: one ends an integration, one lets friction turn in short steps."""

from dataclasses import replace
from functools import partial
from typing import Any

import diffrax
import jax
import jax.numpy as jnp

from tribodyn.dynamics.approach import FRICTION_FORCE, TURNED
from tribodyn.dynamics.contact_forces import contact_forces
from tribodyn.dynamics.mesh_motion import motion_of, place_in_mesh
from tribodyn.dynamics.parameters import Model, Options
from tribodyn.solve.march.step_control import (
    MOST_TRIES,
    begin_turning,
    keep_turned,
    longest_step,
    reversals_in,
    turn_of_friction,
    unbounded,
)
from tribodyn.solve.right_hand_side import contacts_of

#: What stands for a motion that grew without bound: diffrax has no result of its own for it, and gives this
#: one only where rejected steps are stored, which is not done here.
GROWN = diffrax.RESULTS.max_steps_rejected
#: Untyped, as diffrax declares tolerances as variables where wrappers have properties.
_Controller: Any = diffrax.AbstractAdaptiveStepSizeController


class _CountingSteps(_Controller):
    """A controller around another one, with its tolerances, and a count in its state."""

    controller: Any

    @property
    def rtol(self) -> Any:
        return self.controller.rtol

    @property
    def atol(self) -> Any:
        return self.controller.atol

    @property
    def norm(self) -> Any:
        return self.controller.norm

    def wrap(self, direction: Any) -> Any:
        return replace(self, controller=self.controller.wrap(direction))  # pyright: ignore[reportArgumentType]

    def init(self, *arguments: Any) -> tuple[Any, Any]:
        first, inside = self.controller.init(*arguments)
        return first, (inside, jnp.zeros((), dtype=int))


class LimitedSteps(_CountingSteps):
    """Wraps a controller; the result is `max_steps_reached` where it would accept one step more than allowed.

    And `GROWN` where it would accept one to a state that `step_control.unbounded` is true of. diffrax's own
    limit counts rejected steps too, and is compiled in.
    """

    allowed: Any

    def adapt_step_size(self, *arguments: Any) -> tuple[Any, ...]:
        """Call the inner controller, count, and see how far the motion is."""
        *step, (inside, accepted) = arguments
        _, _, _, y1, (_, _, model), *_ = step
        keep, next_t0, next_t1, jump, inside, result = self.controller.adapt_step_size(*step, inside)
        accepted = accepted + jnp.where(keep, 1, 0)
        over = (accepted > self.allowed) & (result == diffrax.RESULTS.successful)
        result = diffrax.RESULTS.where(over, diffrax.RESULTS.max_steps_reached, result)
        grown = keep & unbounded(y1, model) & (result == diffrax.RESULTS.successful)
        result = diffrax.RESULTS.where(grown, GROWN, result)
        return keep, next_t0, next_t1, jump, (inside, accepted), result


class TurningSteps(_CountingSteps):
    """Wraps a controller; a step that turns friction too far is tried again, shorter, see `step_control`.

    It applies where the tolerance sees friction turn: `step_control.resolves_turns`.
    """

    applies: Any

    def adapt_step_size(self, *arguments: Any) -> tuple[Any, ...]:
        """Call the inner controller, and see how far the step has turned friction."""
        *step, (inside, tries) = arguments
        t0, t1, y0, y1, (_, interval, model), *_ = step
        keep, next_t0, next_t1, jump, inside, result = self.controller.adapt_step_size(*step, inside)
        too_far, shorter, longest = _turned(t0, t1, y0, y1, interval, model[:-1], model.options)
        again = keep & too_far & self.applies & (tries < MOST_TRIES)
        longest = jnp.where(self.applies, longest, jnp.inf)
        next_t1 = jnp.where(keep, jnp.minimum(next_t1, next_t0 + longest), next_t1)
        next_t0, next_t1 = jnp.where(again, t0, next_t0), jnp.where(again, t0 + shorter, next_t1)
        tries = jnp.where(again, tries + 1, jnp.where(keep, 0, tries))
        return keep & ~again, next_t0, next_t1, jump, (inside, tries), result


@partial(jax.jit, static_argnames="options")
def _turned(
    t0: Any, t1: Any, y0: Any, y1: Any, interval: Any, numbers: Any, options: Options
) -> tuple[Any, Any, Any]:
    """Whether a step has turned friction too far, the step to try instead, the longest one after it."""
    model = Model(*numbers, options=options)
    work, ends = contacts_of(model), contacts_of(model)
    begin_turning(t0, interval, y0, model, work)
    for m, (mesh, end) in enumerate(zip(model.meshes, ends, strict=True)):
        place, motion = place_in_mesh(m, t1, interval, model), motion_of(m, y1, model)
        contact_forces(place, motion, reversals_in(m, model), mesh, model, end)
        work[m] |= {key: value for key, value in end.items() if key[0] in (TURNED, FRICTION_FORCE)}
    step = t1 - t0
    too_far, shorter = turn_of_friction(step, interval, model, work)
    keep_turned(True, step, interval, model, work)
    return too_far, shorter, longest_step(interval, model, work)
