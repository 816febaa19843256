"""The right-hand side under every compiler: plain NumPy, numba for one case and for lanes, JAX."""

from functools import partial

import jax
import jax.numpy as jnp
import numpy as np

from tests.support.compile_fast import ONE_CALL
from tests.support.states import altered, random_place, random_state
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import Model, OutputDrive, with_shared_code
from tribodyn.kernels.lanes import functions  # noqa: F401  (its import gives the laws their functions over lanes)
from tribodyn.kernels.lanes.arrays import rows_of
from tribodyn.kernels.lanes.vectors import WIDTH
from tribodyn.kernels.native import kernel
from tribodyn.solve.jax.integrator import right_hand_side
from tribodyn.solve.lanes.batch import lane_model, pack
from tribodyn.solve.right_hand_side import contacts_of, rhs, work_array

#: Whole cycles before; the load may depend on time.
CYCLE = 2.0


@kernel
def _lanes(phase, interval, y, model, work, dy):
    derivatives(rows_of(phase)[0], CYCLE, interval, rows_of(y), model, rows_of(work), rows_of(dy))


@partial(jax.jit, static_argnames="options", compiler_options=ONE_CALL)
def _traced(phase, y, interval, numbers, options):
    return right_hand_side(phase, y, (CYCLE, interval, Model(*numbers, options=options)))


def assert_right_hand_sides_agree(models: list[Model], rng: np.random.Generator, rtol: float) -> None:
    """Every compiler's derivatives at random states of every model; small ones within 1e-12 of the maximum.

    The models are of one kind and run in the lanes of the same vectors. Machine code is that of runs, which
    models share; NumPy and JAX have the functions of the laws.
    """
    options, count = models[0].options, models[0].layout.states
    shared = [with_shared_code(model) for model in models]
    packed = pack(shared)
    lanes, numbers, addresses = lane_model(packed)
    work = work_array(models[0])
    lane_work = np.zeros((*work.shape, WIDTH))
    arrays = [jax.tree.map(jnp.asarray, model.numbers) for model in models]
    for interval in range(len(models[0].schedule.start)):
        for start in range(0, 2 * len(models), WIDTH):
            cases = [(start + lane) % len(models) for lane in range(WIDTH)]
            numbers[:], addresses[:] = packed.numbers[cases].T, packed.addresses[cases].T
            phases, rates = np.empty((1, WIDTH)), np.empty((count, WIDTH))
            states = np.stack([random_state(rng, models[case]) for case in cases], axis=1)
            for lane, case in enumerate(cases):
                phases[0, lane] = random_place(rng, models[case].schedule, interval)[0]
            _lanes(phases, interval, states, lanes, lane_work, rates)
            for lane, case in enumerate(cases):
                model, y, phase = models[case], states[:, lane].copy(), float(phases[0, lane])
                plain: dict = {}
                derivatives(phase, CYCLE, interval, y, model, contacts_of(model), plain)
                expected = np.array([plain[i] for i in range(count)])
                native = np.empty(count)
                rhs(phase, CYCLE, interval, y, shared[case], work, native)
                found = {
                    "native": native,
                    "lanes": rates[:, lane],
                    "jax": _traced(phase, y, interval, arrays[case], options),
                }
                scale = 1e-12 * np.abs(expected).max()
                for name, values in found.items():
                    np.testing.assert_allclose(values, expected, rtol=rtol, atol=scale, err_msg=name)


def at_several_conditions(model: Model, count: int = WIDTH) -> list[Model]:
    """The model at other speeds, loads, dampings and inputs, so that no two lanes are alike."""
    share = 1.0 + 0.4 * np.arange(count) / count
    speed, load, damping = model.operation.nominal_speed, model.bodies.load, model.meshes[0].damping
    return [
        altered(
            model,
            operation={
                "nominal_speed": speed * s,
                "acceleration": 40.0 * s,
                "output_torque": 3.0 / s,
                "output_drive": OutputDrive(2e3 * s, 5.0 / s, 1e-3 * s, 1e-3, 0.3 * s, 10.0),
            },
            bodies={"load": load * s},
            mesh={"damping": damping / s},
        )
        for s in share.tolist()
    ]
