"""Tolerances of every state: also of bodies that hang on others by links, one behind the other."""

import numpy as np
import pytest

from tests.support.planet_sets import planet_set
from tests.support.train_scenarios import case_of_table
from tribodyn.solve.choice import choose
from tribodyn.solve.initial import initial_state
from tribodyn.solve.tolerances import tolerances_from
from tribodyn.studies.motion.prepare import prepare
from tribodyn.train.structure import turn_of

STIFFNESS, TORQUE = 1e5, 900.0  # N m/rad, N m


def test_a_carrier_drives_two_flywheels_in_a_row():
    table = planet_set(
        operating={"output": "second", "output_torque": f"{TORQUE} N*m"}, friction={"law": "none"}
    )
    table["friction"] = {"law": "none"}
    table["body"] += [
        {"name": name, "mass": "20 kg", "inertia": "0.3 kg*m**2"} for name in ("first", "second")
    ]
    table["link"] = [
        {"ends": ends, "stiffness": f"{STIFFNESS} N*m/rad"}
        for ends in (["first", "second"], ["carrier", "first"])  # the farther one before the nearer
    ]
    prepared = prepare(case_of_table(table))
    model, names = prepared.model, prepared.names
    state = initial_state(model, "static")
    carrier, first, second = (
        turn_of(names.index(name), model.layout) for name in ("carrier", "first", "second")
    )
    for nearer, farther in ((carrier, first), (first, second)):
        assert abs(state[nearer] - state[farther]) == pytest.approx(TORQUE / STIFFNESS, rel=1e-9)
    atol = tolerances_from(model, state, 1e-6, 1000).atol
    assert np.all(np.isfinite(atol))
    half = model.layout.half
    for nearer, farther in ((carrier, first), (carrier, second)):
        assert atol[farther] == atol[nearer]
        assert atol[half + farther] == atol[half + nearer]
    assert choose("auto", model, state).method == "dopri5"
