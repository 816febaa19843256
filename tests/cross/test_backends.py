"""The same law under every compiler: plain floats, NumPy arrays, numba, JAX."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from tests.support.closures import LIU_NI, MIXED, VECIANA, coulomb, under
from tests.support.compile_fast import ONE_CALL
from tests.support.right_hand_sides import assert_right_hand_sides_agree, at_several_conditions
from tests.support.states import PAIR
from tribodyn.dynamics.parameters import Model
from tribodyn.kernels.native import kernel
from tribodyn.solve.jax.integrator import right_hand_side
from tribodyn.tribology.contact import local_contact
from tribodyn.tribology.film import FILM_LAWS
from tribodyn.tribology.law import Closure


@kernel
def _films(film, surfaces, loads, curvatures, speeds, out):
    for i in range(len(loads)):
        contact = local_contact(loads[i], curvatures[i], speeds[i], 0.0, speeds[i], speeds[i])
        out[0, i], out[1, i], out[2, i] = film.functions.film(contact, surfaces, film.parameters)


def _states(rng, n):
    load, curvature = 10 ** rng.uniform(2, 6.5, n), 10 ** rng.uniform(1, 3.5, n)
    speed = 10 ** rng.uniform(-3, 2, n)
    sliding = speed * rng.uniform(-1, 1, n)
    return load, curvature, speed, sliding, speed + sliding / 2, speed - sliding / 2


# "solved" is made of a mesh: tests/unit/tribology/ehl/test_table.py
@pytest.mark.parametrize("name", [name for name in FILM_LAWS if name != "solved"])
def test_every_film_agrees_between_numpy_numba_and_jax(rng, name):
    n = 5000
    load, curvature, speed, *_ = _states(rng, n)
    state = load, curvature, speed, 0.0 * speed, speed, speed
    surfaces, film, _ = under("none", LIU_NI, film=name)

    def evaluate(*state):
        return film.functions.film(local_contact(*state), surfaces, film.parameters)

    native = np.empty((3, n))
    _films(film, surfaces, load, curvature, speed, native)
    traced = jax.jit(evaluate, compiler_options=ONE_CALL)(*map(jnp.asarray, state))
    for row, (values, other) in enumerate(zip(evaluate(*state), traced, strict=True)):
        np.testing.assert_allclose(native[row], values, rtol=2e-12, atol=1e-13)
        np.testing.assert_allclose(other, values, rtol=2e-12, atol=1e-13)


@kernel
def _coefficients(closure, loads, curvatures, speeds, slidings, out):
    surfaces, film, friction = closure.surfaces, closure.film, closure.friction
    for i in range(len(loads)):
        u, v = speeds[i], slidings[i]
        contact = local_contact(loads[i], curvatures[i], u, v, u + 0.5 * v, u - 0.5 * v)
        mu = friction.functions.coefficient(contact, film, surfaces, friction.parameters)
        out[0, i] = mu
        out[1, i] = friction.functions.flash_temperature(contact, film, surfaces, friction.parameters, mu)


def _coefficient_and_rise(closure: Closure, *state):
    contact = local_contact(*state)
    surfaces, film, friction = closure
    mu = friction.functions.coefficient(contact, film, surfaces, friction.parameters)
    return mu, friction.functions.flash_temperature(contact, film, surfaces, friction.parameters, mu)


CLOSURES = {
    "none": under("none"),
    "coulomb": coulomb(0.06),
    **{name: under(name, VECIANA) for name in (MIXED, f"{MIXED}-veciana-peak", f"{MIXED}-veciana")},
    "xu": under("xu"),
    "benedict-kelley": under("benedict-kelley"),
    **{film: under(MIXED, film=film) for film in ("moes", "dowson-higginson")},
}


@pytest.mark.parametrize("name", CLOSURES)
def test_every_law_agrees_between_numpy_numba_and_jax(rng, name):
    n, closure = 5000, CLOSURES[name]
    state = _states(rng, n)
    values = _coefficient_and_rise(closure, *state)
    native = np.empty((2, n))
    _coefficients(closure, *state[:4], native)
    evaluate = jax.jit(lambda *a: _coefficient_and_rise(closure, *a), compiler_options=ONE_CALL)
    traced = evaluate(*map(jnp.asarray, state))
    for row in (0, 1):
        np.testing.assert_allclose(native[row], values[row], rtol=1e-11, atol=1e-300)
        np.testing.assert_allclose(traced[row], values[row], rtol=1e-11, atol=1e-300)


def test_friction_has_a_gradient():
    def coefficient(u):
        return _coefficient_and_rise(under(MIXED), 3.85e5, 111.0, u, 0.05, 0.2, 0.15)[0]

    slope = jax.grad(coefficient)(0.134)
    step = 1e-6
    values = [coefficient(0.134 + s) for s in (step, -step)]
    assert float(slope) == pytest.approx((values[0] - values[1]) / (2 * step), rel=1e-6)


@pytest.mark.parametrize(
    "overrides",
    [
        {},
        {"friction.sliding": "dynamic", "mesh.formulation": "energy-consistent"},
        {"mesh.hertz": "load-dependent"},
        {"mesh.backlash": "12 um", "friction.law": "masjedi-khonsari-as-printed"},
        pytest.param({"friction.law": "none"}, marks=pytest.mark.soak),
        pytest.param({"friction.law": "xu", "film.law": "moes"}, marks=pytest.mark.soak),
        pytest.param({"friction.law": "benedict-kelley"}, marks=pytest.mark.soak),
        pytest.param({"friction.law": "niemann"}, marks=pytest.mark.soak),
        pytest.param({"friction.law": "masjedi-khonsari-veciana-peak"}, marks=pytest.mark.soak),
        pytest.param({"film.law": "moes"}, marks=pytest.mark.soak),
        pytest.param({"film.law": "dowson-higginson"}, marks=pytest.mark.soak),
    ],
    ids=[
        "default",
        "dynamic",
        "hertz",
        "backlash",
        "frictionless",
        "xu-moes",
        "benedict",
        "niemann",
        "veciana",
        "moes",
        "dowson-higginson",
    ],
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
        return right_hand_side(0.3, y, (0.0, 0, Model(*numbers, options=base.options)))

    base = prepared("crc-23-47").model
    others = [
        prepared("crc-23-47", **{"operating.pinion_speed": "33 rad/s", "mesh.damping_ratio": 0.11}).model,
        prepared("crc-23-47", **{"drive.pressure_angle": "23 deg"}).model,
    ]
    for model in (base, *others):
        numbers = jax.tree.map(jnp.asarray, model.numbers)
        f(jnp.zeros(PAIR.states), numbers)
    assert traces == 1
