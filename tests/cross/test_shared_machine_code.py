"""Trains of several meshes share machine code: what one has compiled, no other layout compiles again."""

import sys

import numpy as np
import pytest

from tests.support.train_scenarios import prepared_train
from tribodyn.dynamics.parameters import Model
from tribodyn.kernels.native import Kernel
from tribodyn.solve.ensemble import march
from tribodyn.solve.initial import static_equilibrium
from tribodyn.solve.integrator import Status
from tribodyn.solve.orbit.periodic import steady_states
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.solve.transient import make_integrator

#: Laws that all of them have, under which a steady state takes little.
LAWS = {"film.law": "dowson-higginson", "friction.law": "coulomb", "friction.coefficient": 0.0}
#: Derivatives in more directions at once than a reducer has, 40 in place of 24.
WIDER = {f"tribodyn.solve.march.variational.{each}" for each in ("explicit", "engage_with_derivative")}
LOOSE = {"shaft.0.law": "play", "shaft.0.play": "0.02 deg", "shaft.0.stiffness": "4e5 N*m/rad"}


def train(name: str, **overrides: str) -> Model:
    return prepared_train(name, **LAWS | overrides).model


def machine_codes() -> dict[str, int]:
    """How many machine codes of every kernel this process has compiled or read from disk."""
    modules = [module for name, module in sys.modules.items() if name.startswith("tribodyn.")]
    kernels = {each for module in modules for each in vars(module).values() if isinstance(each, Kernel)}
    return {f"{each.__module__}.{each.__name__}": len(each._codes) for each in kernels if each._codes}


def solve(model: Model) -> None:
    """A run by either method, a sweep in lanes, a steady state with its multipliers."""
    state = static_equilibrium(model)
    for method in ("dopri5", "rodas4"):
        integrator = make_integrator(method, model, 8, tolerances_from(model, state, 1e-4, 10**5))
        integrator.extremes = True
        assert integrator.integrate(state, 0, 1).status == Status.DONE
    swept = march(
        [model] * 3, np.array([state] * 3), cycles=1, window=1, samples=8, rtol=1e-4, method="dopri5"
    )
    assert np.all(swept.status == Status.DONE)
    (steady,) = steady_states([model], workers=1)
    assert steady.kind == "period-1"


@pytest.fixture(scope="module")
def of_the_first() -> dict[str, int]:
    """What a two-stage reducer takes."""
    solve(train("two-stage-reducer"))
    return machine_codes()


@pytest.mark.parametrize(
    ("name", "overrides", "further"),
    [
        ("idler-train", {}, set()),
        ("planetary-24-84", {}, WIDER),
        ("two-stage-reducer", LOOSE, set()),
        ("two-stage-reducer", {"film.law": "moes"}, set()),
        ("two-stage-reducer", {"film.law": "masjedi-khonsari"}, set()),
    ],
)
def test_a_second_layout_compiles_nothing(of_the_first, name, overrides, further):
    """Other bodies, meshes, links, states, intervals; a link that has play; a film that is recorded only."""
    assert {name.rpartition(".")[2] for name in of_the_first} >= {"integrate", "march_lanes", "explicit"}
    before = machine_codes()
    solve(train(name, **overrides))
    after = machine_codes()
    # a wider code that an earlier test of this process has loaded is not loaded again
    assert {each for each in after if after[each] != before.get(each)} <= further
