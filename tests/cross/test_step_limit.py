"""`solver.max_steps`: accepted steps in one mesh cycle, with every method, in lanes and in batches of JAX."""

import numpy as np
import pytest

from tests.support.compilations import compilations
from tribodyn.solve.ensemble import march
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.integrator import Status
from tribodyn.solve.jax import ensemble as jax_ensemble
from tribodyn.solve.methods import METHODS, Runs
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import make_integrator

RTOL, SAMPLES, MANY = 1e-4, 8, 10**6
JAX = [name for name, entry in METHODS.items() if entry.runs is Runs.JAX]
QUICK = [name for name, entry in METHODS.items() if entry.runs is not Runs.JAX]


@pytest.fixture(scope="module")
def case(prepared):
    """Model and state."""
    model = prepared("crc-23-47-300").model
    return model, static_equilibrium(model)


def integrated(case, method, max_steps, cycles):
    model, state = case
    tolerances = tolerances_from(model, state, RTOL, max_steps)
    return make_integrator(method, model, SAMPLES, tolerances).integrate(state, 0, cycles)


def assert_limit_is_per_cycle(case, method):
    """The steps that each of two cycles takes are just enough, and one step fewer is not."""
    first = integrated(case, method, MANY, 1).steps
    both = integrated(case, method, MANY, 2).steps
    most = max(first, both - first)
    enough = integrated(case, method, most, 2)
    assert enough.status == Status.DONE
    assert enough.steps == both > most
    hurried = integrated(case, method, most - 1, 2)
    assert hurried.status == Status.TOO_MANY_STEPS
    assert hurried.steps < both
    assert np.floor(hurried.reached) == (0.0 if first == most else 1.0)


@pytest.mark.parametrize("method", QUICK)
def test_a_cycle_may_take_so_many_steps(case, method):
    assert_limit_is_per_cycle(case, method)


@pytest.mark.soak
@pytest.mark.parametrize("method", JAX)
def test_a_cycle_may_take_so_many_steps_through_jax(case, method):
    """One program for every cycle and limit: what the first cycle takes compiles nothing for the others."""
    integrated(case, method, MANY, 1)
    before = len(compilations())
    assert_limit_is_per_cycle(case, method)
    assert len(compilations()) == before


def assert_batch_limit_is_per_cycle(case, method):
    model, state = case
    settings = {"window": 0, "samples": SAMPLES, "rtol": RTOL, "method": method}
    states = np.array([state, state])
    first = int(march([model] * 2, states, cycles=1, **settings).steps[0])
    both = int(march([model] * 2, states, cycles=2, **settings).steps[0])
    most = max(first, both - first)
    enough = march([model] * 2, states, cycles=2, max_steps=most, **settings)
    assert np.all(enough.status == Status.DONE)
    hurried = march([model] * 2, states, cycles=2, max_steps=most - 1, **settings)
    assert np.all(hurried.status == Status.TOO_MANY_STEPS)


def test_a_cycle_may_take_so_many_steps_in_lanes(case):
    assert_batch_limit_is_per_cycle(case, "dopri5")


@pytest.mark.soak
def test_a_cycle_may_take_so_many_steps_in_a_batch_of_jax(case, monkeypatch):
    monkeypatch.setattr(jax_ensemble, "WIDTH_ON_CPU", 2)
    model, state = case
    march([model] * 2, np.array([state] * 2), cycles=1, window=0, samples=SAMPLES, rtol=RTOL, method="tsit5")
    before = len(compilations())
    assert_batch_limit_is_per_cycle(case, "tsit5")
    assert len(compilations()) == before
