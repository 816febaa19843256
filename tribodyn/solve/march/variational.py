"""Marches with their derivatives with respect to the start: variational equations beside those of motion.

The march of the native methods is compiled for dual numbers (`kernels.duals`), whose slopes are the columns
of the fundamental matrix Φ: every operation of the right-hand side, of a step and of an engagement acts on
both, so that Φ' = (∂f/∂y) Φ is integrated with the stages of the motion, and no derivative is written down
anywhere. The step control looks at Φ too. Steps, and the phases at which they end, are held: the result is
the exact derivative of the method with these steps.

Pairs enter and leave at given values of the phase, which is the independent variable: the derivative is taken
over an engagement by that of the engagement itself. Between engagements forces are continuous, so that Φ
passes their corners (a kink of a friction law, flanks that begin to touch) without a jump, and the step
control resolves them as it does those of the motion.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.kernels.duals import functions  # noqa: F401  (its import gives the laws their derivatives)
from tribodyn.kernels.duals.functions import LENGTH, VALUE, duals_of
from tribodyn.kernels.duals.numbers import DIRECTIONS
from tribodyn.kernels.native import PackedValue, kernel, packed
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.numerics.work import in_threads
from tribodyn.solve.integrator import March, Status
from tribodyn.solve.march import explicit_8
from tribodyn.solve.march.extreme_search import ignore_segment, ignore_step
from tribodyn.solve.march.marching import Control, march_with
from tribodyn.solve.march.reversal import stops_of_many
from tribodyn.solve.march.step_control import FIRST_STEP, MINIMUM_ERROR
from tribodyn.solve.methods import rodas4
from tribodyn.solve.right_hand_side import engage, interval_at, work_array
from tribodyn.solve.tolerances import tolerances_of_many
from tribodyn.train.structure import TrainLayout

#: Floats to a cache line, on which dual numbers begin: half the time of a march that lets them cross it.
CACHE_LINE = 8

EXPLICIT = explicit_8.METHOD
STIFF = rodas4.METHOD._replace(opened=ignore_segment, stepped=ignore_step)


@kernel
def explicit(march, control, model, y, out, work, buffer):
    """`explicit_8` with derivatives; see `marching.march_with`."""
    return march_with(
        EXPLICIT, march, control, model, duals_of(y), duals_of(out), duals_of(work), duals_of(buffer), out
    )


@kernel
def stiff(march, control, model, y, out, work, buffer):
    """`methods.rodas4` with derivatives; see `marching.march_with`."""
    return march_with(
        STIFF, march, control, model, duals_of(y), duals_of(out), duals_of(work), duals_of(buffer), out
    )


@kernel
def engage_with_derivative(interval, y, model, work):
    """Take a state and its derivatives over the engagement that begins a mesh cycle."""
    duals = duals_of(y)
    engage(interval, True, duals, model, duals_of(work), duals)


class DualMethod(NamedTuple):
    """A native method over dual numbers."""

    integrate: Callable[..., Any]  # kernel
    buffer: Callable[[TrainLayout], Float[Array, "row state"]]  # (layout) -> its buffer over floats
    tolerance: float  # of the derivatives in a step, over the scale of the states


#: What takes the place of a method, by the names of `methods`. With these tolerances multipliers of a mesh
#: cycle are exact to 2e-9 by the explicit one, loss of contact and friction that reverses with the vibration
#: included, and to a few 1e-8 by the stiff one (measured on drives of the tests' kind against DOP853 on the
#: variational equations through JAX).
METHODS = {
    "dopri5": DualMethod(explicit, explicit_8.buffer, 1e-10),
    "rodas4": DualMethod(stiff, rodas4.buffer, 1e-8),
    "switching": DualMethod(stiff, rodas4.buffer, 1e-8),
}


class Derived(NamedTuple):
    """The ends of marches and their derivatives."""

    state: Float[Array, "row state"]  # behind the engagement that ends the last mesh cycle
    slopes: Float[Array, "row state direction"]  # its derivatives in the directions given
    status: Int[Array, " row"]  # a `Status`
    reached: Float[Array, " row"]  # mesh cycles done
    steps: Int[Array, " row"]  # accepted steps, of all passes


def march_with_derivative(
    models: Sequence[Model],
    states: Float[Array, "row state"],
    directions: Float[Array, "row state direction"],
    *,
    cycles: int,
    rtol: float,
    max_steps: int,
    methods: Sequence[str],
    workers: int,
) -> Derived:
    """March from the start of a mesh cycle, behind its engagement, with the derivatives in some directions.

    The error control takes a direction for a displacement of the state and measures its error likewise, so
    that it should be of the size of the states' scales. More than `DIRECTIONS` are done in several passes.
    `rtol` is of the motion; that of the derivatives is the method's. `methods` has a key of `METHODS` for
    every row. All models have one layout.
    """
    count = directions.shape[-1]
    atol, stops = tolerances_of_many(models, states, rtol), stops_of_many(models)
    march = March(0, cycles, cycles, 0, False, rtol, max_steps)
    rows, size = states.shape
    numbers = _packed(models)
    result = Derived(
        np.empty((rows, size)),
        np.empty((rows, size, count)),
        np.zeros(rows, dtype=int),
        np.zeros(rows),
        np.zeros(rows, dtype=int),
    )

    def integrate(row: int) -> None:
        for first in range(0, max(count, 1), DIRECTIONS):
            over(row, slice(first, min(first + DIRECTIONS, count)))
            if result.status[row] != Status.DONE:
                return

    def over(row: int, part: slice) -> None:
        method, layout = METHODS[methods[row]], models[row].layout
        y, work = _duals((size,)), _duals(work_array(models[row]).shape)
        width = part.stop - part.start
        y[:, :width], y[:, VALUE] = directions[row][:, part], states[row]
        scales = atol[row], atol[row] / rtol
        control = Control(FIRST_STEP, MINIMUM_ERROR, *scales, stops[row], method.tolerance)
        model = numbers[row]
        out, buffer = _duals((cycles * march.samples, size)), _duals(method.buffer(layout).shape)
        status, reached, _, _, steps, _, _ = method.integrate(march, control, model, y, out, work, buffer)
        if status == Status.DONE:
            engage_with_derivative(int(interval_at(cycles, models[row])), y, model, work)
        result.state[row], result.slopes[row][:, part] = y[:, VALUE], y[:, :width]
        result.status[row], result.reached[row] = status, reached
        result.steps[row] += steps

    in_threads(integrate, range(rows), min(workers, rows))
    return result


def _packed(models: Sequence[Model]) -> list[PackedValue]:
    """The models as kernels read them; what several have in common is packed once."""
    known: dict[int, PackedValue] = {}

    def once(record: Any) -> Any:
        if id(record) not in known:
            known[id(record)] = packed(record)
        return known[id(record)]

    return [packed(Model(*map(once, model.numbers), options=model.options)) for model in models]


def _duals(shape: tuple[int, ...]) -> Float[Array, "*shape dual"]:
    """Zeros for dual numbers of a shape, from the start of a cache line on."""
    size = int(np.prod(shape)) * LENGTH
    room = np.zeros(size + CACHE_LINE)
    first = (-room.ctypes.data // room.itemsize) % CACHE_LINE
    return room[first : first + size].reshape(*shape, LENGTH)
