"""The right-hand side of trains under every compiler, and its derivative by their numbers."""

from functools import partial
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from tests.support.compile_fast import ONE_CALL
from tests.support.right_hand_sides import assert_right_hand_sides_agree, at_several_conditions
from tests.support.train_scenarios import prepared_train
from tribodyn.dynamics.parameters import Model
from tribodyn.solve.initial import initial_state
from tribodyn.solve.jax.integrator import right_hand_side

MOTOR = {
    "operating.source": "torque",
    "operating.drive_inertia": "0.05 kg*m**2",
    "operating.shaft_stiffness": "2e4 N*m/rad",
    "operating.shaft_damping": "2 N*m*s/rad",
}
#: A compound shaft with a gear as driven and one as driving, and a motor behind a shaft; a gear that drives
#: both meshes, with back flanks.
TRAINS: dict[str, dict[str, Any]] = {
    "two-stage-reducer": MOTOR | {"friction.law": "iso-14179-1"},
    "two-pinions-bull-gear": {
        "friction.law": "iso-14179-1",
        "mesh.formulation": "energy-consistent",
        "mesh.backlash": "20 um",
    },
}


@pytest.mark.parametrize(
    ("name", "overrides"),
    [
        *((name, {}) for name in TRAINS),
        pytest.param("two-stage-reducer", {"friction.law": "masjedi-khonsari"}, marks=pytest.mark.soak),
    ],
    ids=[*TRAINS, "mixed-friction"],
)
def test_every_compiler_makes_the_same_of_a_train(name, overrides, rng):
    model = prepared_train(name, **TRAINS[name] | overrides).model
    assert_right_hand_sides_agree(at_several_conditions(model), rng, rtol=1e-11)


@pytest.mark.slow
def test_it_is_differentiated_by_the_numbers_of_every_mesh():
    """By a factor on inertias, and on damping and tables of each mesh, against central differences."""
    model = prepared_train("two-stage-reducer", **TRAINS["two-stage-reducer"]).model
    state = jnp.asarray(initial_state(model, "static"))
    numbers = jax.tree.map(partial(jnp.asarray, dtype=float), model.numbers)

    def rates(factors: Any) -> Any:
        first = Model(*numbers, options=model.options)
        meshes = [
            mesh._replace(
                damping=factor * mesh.damping, table=mesh.table._replace(channel=factor * mesh.table.channel)
            )
            for mesh, factor in zip(first.meshes, factors[:2], strict=True)
        ]
        bodies = first.bodies._replace(inertia=factors[2] * first.bodies.inertia)
        return right_hand_side(0.3, state, (0.0, 1, first._replace(meshes=tuple(meshes), bodies=bodies)))

    at, step = np.ones(3), 1e-6
    found = jax.jit(jax.jacfwd(rates), compiler_options=ONE_CALL)(at)
    both = jax.jit(jax.vmap(rates), compiler_options=ONE_CALL)(at + step * np.vstack([np.eye(3), -np.eye(3)]))
    expected = (both[:3] - both[3:]).T / (2.0 * step)
    scale = np.max(np.abs(expected), axis=0)
    assert np.all(scale > 0.0)
    np.testing.assert_allclose(found / scale, expected / scale, rtol=0.0, atol=1e-7)
