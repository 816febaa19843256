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

from tribodyn.dynamics.parameters import Model, with_shared_code
from tribodyn.kernels.duals import functions  # noqa: F401  (its import gives the laws their derivatives)
from tribodyn.kernels.duals.functions import duals_of, length_of
from tribodyn.kernels.duals.numbers import BLOCK
from tribodyn.kernels.native import PackedValue, kernel, packed
from tribodyn.numerics.elementary import StaticInt
from tribodyn.numerics.processes.work import in_threads
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.solve.integrator import March, Status
from tribodyn.solve.march import explicit_8
from tribodyn.solve.march.extreme_search import ignore_segment, ignore_step
from tribodyn.solve.march.marching import Control, march_with
from tribodyn.solve.march.reversal import stops_of_many
from tribodyn.solve.march.step_control import FIRST_STEP, MINIMUM_ERROR
from tribodyn.solve.methods import rodas4
from tribodyn.solve.right_hand_side import engage, interval_at, work_array
from tribodyn.solve.tolerances import tolerances_of_many
from tribodyn.train.layout import TrainLayout

#: Floats to a cache line, on which dual numbers begin: half the time of a march that lets them cross it.
CACHE_LINE = 8

#: Directions of a pass of trains: one number, so that all share machine code. A set of three planets takes a
#: tenth longer than with as many as it has.
OF_TRAINS = 24

EXPLICIT = explicit_8.METHOD
STIFF = rodas4.METHOD._replace(opened=ignore_segment, stepped=ignore_step)


@kernel
def explicit(march, control, model, y, out, work, buffer, directions):
    """`explicit_8` with derivatives; see `marching.march_with`."""
    states, contacts = directions.states, directions.contacts
    state, samples, rows = duals_of(y, states), duals_of(out, states), duals_of(buffer, states)
    return march_with(EXPLICIT, march, control, model, state, samples, duals_of(work, contacts), rows, out)


@kernel
def stiff(march, control, model, y, out, work, buffer, directions):
    """`methods.rodas4` with derivatives; see `marching.march_with`."""
    states, contacts = directions.states, directions.contacts
    state, samples, rows = duals_of(y, states), duals_of(out, states), duals_of(buffer, states)
    return march_with(STIFF, march, control, model, state, samples, duals_of(work, contacts), rows, out)


@kernel
def engage_with_derivative(interval, y, model, work, directions):
    """Take a state and its derivatives over the engagement that begins a mesh cycle."""
    state = duals_of(y, directions.states)
    engage(interval, True, state, model, duals_of(work, directions.contacts), state)


class Directions(NamedTuple):
    """Directions that numbers carry derivatives in."""

    states: StaticInt  # with respect to the start
    contacts: StaticInt  # with respect to the `Motion` of their mesh, in the plane its first 8 numbers


def directions_of(count: int, most: int, layout: TrainLayout) -> Directions:
    """Those for so many directions at the start, in as few passes of at most so many as there can be.

    Where the machine code reads sizes, `OF_TRAINS` or as many as there may be.
    """
    passes = max(1, -(-count // most))
    wide = BLOCK * max(1, -(-count // (passes * BLOCK)))
    if not isinstance(layout.meshes, StaticInt):
        wide = min(most, OF_TRAINS)
    return Directions(StaticInt(wide), StaticInt(BLOCK * (2 if layout.spatial else 1)))


class DualMethod(NamedTuple):
    """A native method over dual numbers."""

    integrate: Callable[..., Any]  # kernel
    buffer: Callable[[TrainLayout], Float[Array, "row state"]]  # (layout) -> its buffer over floats
    tolerance: float  # of the derivatives in a step, over the scale of the states
    directions: int  # of a pass at most; where matrices take the time, more would only compile for longer


#: What takes the place of a method, by the names of `methods`. With these tolerances multipliers of a mesh
#: cycle are exact to 2e-9 by the explicit one, loss of contact and friction that reverses with the vibration
#: included, and to a few 1e-8 by the stiff one (measured on drives of the tests' kind against DOP853 on the
#: variational equations through JAX).
METHODS = {
    "dopri5": DualMethod(explicit, explicit_8.buffer, 1e-10, 64),
    "rodas4": DualMethod(stiff, rodas4.buffer, 1e-8, 16),
    "switching": DualMethod(stiff, rodas4.buffer, 1e-8, 16),
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
    fine: bool = True,
    max_steps: int,
    methods: Sequence[str],
    workers: int,
) -> Derived:
    """March from the start of a mesh cycle, behind its engagement, with the derivatives in some directions.

    The error control takes a direction for a displacement of the state and measures its error likewise, so
    that it should be of the size of the states' scales. More than the method's are done in several passes.
    `rtol` is of the motion; that of the derivatives is the method's, or the same if not `fine`. `methods` has
    a key of `METHODS` for every row. All models have one layout.
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
        wide = directions_of(count, METHODS[methods[row]].directions, models[row].layout)
        for first in range(0, max(count, 1), wide.states):
            over(row, slice(first, min(first + wide.states, count)), wide)
            if result.status[row] != Status.DONE:
                return

    def over(row: int, part: slice, wide: Directions) -> None:
        method, layout = METHODS[methods[row]], models[row].layout
        y, work = _duals((size,), wide.states), _duals(work_array(models[row]).shape, wide.contacts)
        width = part.stop - part.start
        y[:, :width], y[:, wide.states] = directions[row][:, part], states[row]
        scales = atol[row], atol[row] / rtol
        control = Control(FIRST_STEP, MINIMUM_ERROR, *scales, stops[row], method.tolerance if fine else rtol)
        model = numbers[row]
        out = _duals((cycles * march.samples, size), wide.states)
        buffer = _duals(method.buffer(layout).shape, wide.states)
        status, reached, _, _, steps, _, _ = method.integrate(
            march, control, model, y, out, work, buffer, wide
        )
        if status == Status.DONE:
            engage_with_derivative(int(interval_at(cycles, models[row])), y, model, work, wide)
        result.state[row], result.slopes[row][:, part] = y[:, wide.states], y[:, :width]
        result.status[row], result.reached[row] = status, reached
        result.steps[row] += steps

    in_threads(integrate, range(rows), min(workers, rows))
    return result


def _packed(models: Sequence[Model]) -> list[PackedValue]:
    """The models as kernels read them; what several have in common is packed once."""
    packed_records: dict[int, PackedValue] = {}

    def once(record: Any) -> Any:
        if id(record) not in packed_records:
            packed_records[id(record)] = packed(record)
        return packed_records[id(record)]

    shared = map(with_shared_code, models)
    return [packed(Model(*map(once, model.numbers), options=model.options)) for model in shared]


def _duals(shape: tuple[int, ...], directions: int) -> Float[Array, "*shape dual"]:
    """Zeros for dual numbers of a shape, from the start of a cache line on."""
    size = int(np.prod(shape)) * length_of(directions)
    room = np.zeros(size + CACHE_LINE)
    first = (-room.ctypes.data // room.itemsize) % CACHE_LINE
    return room[first : first + size].reshape(*shape, length_of(directions))
