"""The same law under every compiler: plain floats, NumPy arrays, numba, JAX."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from tests.support.right_hand_sides import assert_right_hand_sides_agree, at_several_conditions
from tests.unit.tribology.test_tribology import LIU_NI
from tribodyn.dynamics.parameters import STATES
from tribodyn.kernels.native import kernel
from tribodyn.solve.diffrax_integrator import right_hand_side
from tribodyn.tribology.contact import logarithms
from tribodyn.tribology.friction import (
    BENEDICT_KELLEY,
    COULOMB,
    MASJEDI_KHONSARI,
    NONE,
    XU,
    friction,
    mixed_film,
)

LOGS = logarithms(LIU_NI)


@kernel
def _films(loads, curvatures, speeds, slidings, contact, logs, out):
    for i in range(len(loads)):
        u, v = speeds[i], slidings[i]
        out[i] = mixed_film(loads[i], curvatures[i], u, v, u + 0.5 * v, u - 0.5 * v, contact, logs)[0]


def test_friction_agrees_between_numpy_numba_and_jax(rng):
    n = 20000
    load = 10 ** rng.uniform(2, 6.5, n)
    curvature = 10 ** rng.uniform(1, 3.5, n)
    speed = 10 ** rng.uniform(-3, 2, n)
    sliding = speed * rng.uniform(-1, 1, n)
    state = load, curvature, speed, sliding, speed + sliding / 2, speed - sliding / 2
    numpy = mixed_film(*state, LIU_NI, LOGS)[0]
    native = np.empty(n)
    _films(load, curvature, speed, sliding, LIU_NI, LOGS, native)
    traced = jax.jit(lambda *a: mixed_film(*a, LIU_NI, LOGS)[0])(*map(jnp.asarray, state))
    np.testing.assert_allclose(native, numpy, rtol=2e-12, atol=1e-300)
    np.testing.assert_allclose(traced, numpy, rtol=2e-12, atol=1e-300)


@kernel
def _coefficients(law, loads, curvatures, speeds, slidings, contact, out):
    for i in range(len(loads)):
        u, v = speeds[i], slidings[i]
        values = friction(law, loads[i], curvatures[i], u, v, u + 0.5 * v, u - 0.5 * v, contact)
        out[0, i] = values[0]
        out[1, i] = values[3]


@pytest.mark.parametrize("law", [NONE, COULOMB, MASJEDI_KHONSARI, XU, BENEDICT_KELLEY])
def test_every_law_agrees_between_numpy_numba_and_jax(rng, law):
    n = 5000
    load, curvature = 10 ** rng.uniform(2, 6.5, n), 10 ** rng.uniform(1, 3.5, n)
    speed = 10 ** rng.uniform(-3, 2, n)
    sliding = speed * rng.uniform(-1, 1, n)
    contact = LIU_NI._replace(peclet_sliding=1.0, viscosity_pressure_factor=4 / np.pi)
    state = (load, curvature, speed, sliding, speed + sliding / 2, speed - sliding / 2)
    values = friction(law, *state, contact)
    native = np.empty((2, n))
    _coefficients(law, load, curvature, speed, sliding, contact, native)
    traced = jax.jit(lambda *a: jnp.stack(friction(law, *a, contact)))(*map(jnp.asarray, state))
    for row, which in ((0, 0), (1, 3)):
        np.testing.assert_allclose(native[row], values[which], rtol=1e-11, atol=1e-300)
        np.testing.assert_allclose(traced[which], values[which], rtol=1e-11, atol=1e-300)


def test_friction_has_a_gradient():
    slope = jax.grad(lambda u: mixed_film(3.85e5, 111.0, u, 0.05, 0.2, 0.15, LIU_NI, LOGS)[0])(0.134)
    step = 1e-6
    values = [mixed_film(3.85e5, 111.0, 0.134 + s, 0.05, 0.2, 0.15, LIU_NI, LOGS)[0] for s in (step, -step)]
    assert float(slope) == pytest.approx((values[0] - values[1]) / (2 * step), rel=1e-6)


@pytest.mark.parametrize(
    "overrides",
    [
        {},
        {"friction.sliding": "dynamic", "mesh.formulation": "energy-consistent"},
        {"mesh.hertz": "load-dependent"},
        {"mesh.backlash": "12 um", "friction.law": "masjedi-khonsari-as-printed"},
        {"friction.law": "none"},
        {"friction.law": "xu"},
        {"friction.law": "benedict-kelley"},
        {"friction.law": "niemann"},
        {"friction.law": "masjedi-khonsari-veciana-peak"},
    ],
    ids=["default", "dynamic", "hertz", "backlash", "frictionless", "xu", "benedict", "niemann", "veciana"],
)
def test_right_hand_sides_agree_over_random_states(prepared, rng, overrides):
    model = prepared("crc-23-47", **overrides).model
    assert_right_hand_sides_agree(at_several_conditions(model), rng, 1e-12)


def test_a_changed_number_compiles_nothing_again(prepared):
    """JAX's right-hand side is traced once for all speeds, torques and drives of the same family and size."""
    traces = 0

    @jax.jit
    def f(y, numbers):
        nonlocal traces
        traces += 1
        table, mechanics, contact = numbers
        model = base._replace(table=table, mechanics=mechanics, contact=contact)
        return right_hand_side(0.3, y, (0.0, 0, model))

    base = prepared("crc-23-47").model
    others = [
        prepared("crc-23-47", **{"operating.pinion_speed": "33 rad/s", "mesh.damping_ratio": 0.11}).model,
        prepared("crc-23-47", **{"drive.pressure_angle": "23 deg"}).model,
    ]
    for model in (base, *others):
        numbers = jax.tree.map(jnp.asarray, (model.table, model.mechanics, model.contact))
        f(jnp.zeros(STATES), numbers)
    assert traces == 1
