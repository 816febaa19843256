"""Datasets of a load contact study, from loads that are given."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tribodyn.studies.load_contact import run


def test_a_pair_has_a_face_load_factor_wherever_it_carries(monkeypatch: pytest.MonkeyPatch):
    """Gears of clocks carry less than a newton."""
    monkeypatch.setattr(run, "torque_residual", lambda study, loaded: np.zeros(2))
    drive = SimpleNamespace(pinion=SimpleNamespace(teeth=20))
    study: Any = SimpleNamespace(case=SimpleNamespace(drive=drive))
    at_each = np.zeros(2)
    loaded: Any = SimpleNamespace(
        phase=np.array([0.25, 0.75]),
        roll=at_each,
        deflection=at_each,
        unloaded=at_each,
        normal_load=np.array([[0.0, 3e-3], [0.4, 5e3]]),
        line_load=at_each,
        pressure=at_each,
        half_width=at_each,
        face_load_factor=np.full((2, 2), 1.2),
        root_tension=np.zeros((2, 2, 2)),
        root_compression=np.zeros((2, 2, 2)),
        mesh_stiffness=at_each,
    )
    arrays = run.record_arrays(study, loaded)
    np.testing.assert_array_equal(arrays["face_load_factor"], [[np.nan, 1.2], [1.2, 1.2]])
    np.testing.assert_allclose(arrays["phase"], [0.0, 0.5])
    np.testing.assert_allclose(arrays["pinion_angle"], [0.0, np.pi / 20.0])
