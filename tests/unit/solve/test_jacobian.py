"""The Jacobian from its structure and a few differences, against central differences of every column."""

from typing import Any, cast

import numpy as np
import pytest

from tests.support.plain_kernels import make_plain, plain
from tests.support.states import random_state
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import (
    DRIVE_SHAFT,
    DRIVE_SPEED,
    LAG,
    MECHANICAL,
    MOTOR_SLIP,
    SLIP,
    STATES,
    TWIST,
)
from tribodyn.solve.initial import accelerations
from tribodyn.solve.march import jacobian
from tribodyn.solve.march.jacobian import Differences, differentiate
from tribodyn.solve.march.marching import Place
from tribodyn.solve.tolerances import state_scales

#: Bearings of which no two are alike.
BEARINGS = {
    f"{gear}_{what}_{axis}": size * (1.0 + 0.2 * number)
    for number, (gear, axis) in enumerate((g, a) for g in ("pinion", "gear") for a in "xy")
    for what, size in (("stiffness", 2e8), ("damping", 3e3))
}
SHAFT = {
    "operating.source": "torque",
    "operating.shaft_stiffness": "1e4 N*m/rad",
    "operating.drive_inertia": "0.01 kg*m**2",
    "operating.speed_regulation": "0.3 N*m*s/rad",
}
WAVES = {"operating.gear_torque_harmonics": [{"amplitude": "30 N*m", "frequency": "90 Hz"}]}


@pytest.mark.parametrize(
    ("more", "evaluations"),
    [({}, 6), ({"operating.source": "torque"}, 7), (SHAFT | WAVES, 10)],
    ids=["speed", "torque", "shaft"],
)
def test_every_column_is_that_of_central_differences(prepared, monkeypatch, rng, more, evaluations):
    model = prepared("crc-23-47", **more, **{"friction.law": "none"}).model
    model = model._replace(mechanics=model.mechanics._replace(**BEARINGS))
    make_plain(monkeypatch, jacobian)
    monkeypatch.setattr(jacobian, "rhs", derivatives)
    segment, phase = 0, 0.4 * float(model.table.boundary[1])
    y = random_state(rng, float(model.mechanics.nominal_speed))
    y[5] = 40e-6  # well in contact
    f = accelerations(y, phase, segment, model)
    scale = state_scales(model, y)
    found = Differences(np.zeros(STATES), np.full((STATES, MECHANICAL), np.nan), np.zeros(STATES))
    place = Place(phase, 0.0, segment, float(model.table.boundary[1]))
    kept = y.copy()
    count = plain(differentiate)(place, y, f, scale, model, cast(Any, {}), found)
    assert count == evaluations
    np.testing.assert_array_equal(y, kept)
    step = 1e-5 * scale[:MECHANICAL]
    step[SLIP] = min(step[SLIP], 1e-5 * float(model.mechanics.nominal_speed))
    shift = np.zeros((MECHANICAL, STATES))
    shift[:, :MECHANICAL] = np.diag(step)
    up, down = (accelerations(y + sign * shift, phase, segment, model) for sign in (1, -1))
    expected = (up - down).T / (2.0 * step)
    drive = model.options.drive
    unknown = [] if drive == DRIVE_SHAFT else [TWIST, MOTOR_SLIP]
    unknown += [SLIP] if drive == DRIVE_SPEED else []
    unknown += [] if drive == DRIVE_SHAFT else [LAG]
    compared = [j for j in range(MECHANICAL) if j not in unknown]
    for j in compared:
        tolerance = 3e-6 * np.abs(expected[:, j]).max()
        np.testing.assert_allclose(found.jacobian[:, j], expected[:, j], rtol=3e-4, atol=tolerance, err_msg=j)
    later, earlier = (accelerations(y, phase + sign * 1e-6, segment, model) for sign in (1, -1))
    slope = (later - earlier) / 2e-6
    np.testing.assert_allclose(found.slope, slope, rtol=1e-4, atol=1e-6 * np.abs(slope).max())


def test_at_the_end_of_a_segment_the_slope_is_taken_backwards(prepared, monkeypatch):
    """Behind the end the table says nothing."""
    model = prepared("crc-23-47", **{"friction.law": "none"}).model
    make_plain(monkeypatch, jacobian)
    asked = []

    def rates(phase, cycle, segment, y, model, work, out):
        asked.append(phase)
        out[:] = np.arange(STATES) * phase

    monkeypatch.setattr(jacobian, "rhs", rates)
    end = float(model.table.boundary[1])
    found = Differences(np.zeros(STATES), np.zeros((STATES, MECHANICAL)), np.zeros(STATES))
    for phase, behind in ((end - 1e-9, False), (0.5 * end, True)):
        asked.clear()
        place = Place(phase, 0.0, 0, end)
        plain(differentiate)(
            place, np.zeros(STATES), np.arange(STATES) * phase, np.ones(STATES), model, cast(Any, {}), found
        )
        assert (asked[-1] > phase) == behind
        assert asked[-1] < end
        np.testing.assert_allclose(found.slope, np.arange(STATES), rtol=1e-5)
