"""Losses of meshes by standards at points of operation."""

import numpy as np
import pytest

from tribodyn.gears.prepare import assembled
from tribodyn.gears.rating.mesh_loss import loss_by_formula
from tribodyn.standards.mesh_loss.methods import MESH_LOSS_METHODS
from tribodyn.studies.protocol.load import load_data, load_scenario
from tribodyn.validation.books.stplus_fzg_c import BOOK, SCENARIO


def test_another_programs_pair():
    """STplus 11.1F, FZG type C: μ 0.045, 177.9 W at 130 N m, 1500 rpm, FVA 3A at 60 °C."""
    pair = load_data(SCENARIO, BOOK).case.pair
    speed = 1500.0 * np.pi / 30.0
    found = loss_by_formula(
        "iso-14179-2", pair, assembled(pair), np.array([195.0]), np.array([speed]), np.array([333.15])
    )
    assert float(found.drag[0] * speed) == pytest.approx(177.9, rel=1e-3)
    assert float(found.coefficient[0]) == pytest.approx(0.045, abs=5e-4)
    assert found.exceeded == ()


@pytest.mark.parametrize("name", MESH_LOSS_METHODS)
def test_torque_speed_and_temperature_go_together(name: str):
    pair = load_scenario("efficiency-helical-fzg-20-30").pair
    torque, speed, oil = np.array([0.0, -300.0, 300.0, 300.0]), np.array([100.0, 100.0, -100.0, 0.0]), 353.15
    found = loss_by_formula(name, pair, assembled(pair), torque, speed, np.full(4, oil))
    assert found.drag[0] == 0.0
    assert np.isnan(found.coefficient[0])
    assert found.drag[1] == found.drag[2] > 0.0
    assert 0.0 < found.drag[3] < np.inf
    warm = loss_by_formula(name, pair, assembled(pair), torque, speed, np.full(4, oil + 20.0))
    assert np.all(warm.drag[1:] != found.drag[1:])
