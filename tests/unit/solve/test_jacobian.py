"""The Jacobian from its structure and a few differences, against central differences of every column."""

import numpy as np
import pytest

from tests.support.plain_kernels import make_plain, plain
from tests.support.states import LAG, PAIR, TURN_G, altered, random_state
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import DRIVE_SPEED
from tribodyn.solve.initial import accelerations
from tribodyn.solve.march import jacobian
from tribodyn.solve.march.jacobian import Differences, differentiate
from tribodyn.solve.march.marching import Place
from tribodyn.solve.right_hand_side import contacts_of
from tribodyn.solve.tolerances import state_scales
from tribodyn.train.structure import BRAKES, DRIVES

#: Bearings of which no two are alike.
BEARINGS = np.array([[1.0, 1.2, 0.0], [1.4, 1.6, 0.0]])
SHAFT = {
    "operating.source": "torque",
    "operating.shaft_stiffness": "1e4 N*m/rad",
    "operating.drive_inertia": "0.01 kg*m**2",
    "operating.speed_regulation": "0.3 N*m*s/rad",
}
WAVES = {"operating.gear_torque_harmonics": [{"amplitude": "30 N*m", "frequency": "90 Hz"}]}


@pytest.mark.parametrize(
    ("more", "evaluations", "keeps"),
    [
        ({}, 6, 0),
        ({"operating.source": "torque"}, 7, 0),
        (SHAFT | WAVES, 8, 0),
        ({}, 6, DRIVES),
        ({"operating.source": "torque"}, 7, BRAKES),
    ],
    ids=["speed", "torque", "shaft", "two-drives", "brake"],
)
def test_every_column_is_that_of_central_differences(prepared, monkeypatch, rng, more, evaluations, keeps):
    """`keeps`: what the link of the gear, which has a bearing, does to its speed."""
    model = prepared("crc-23-47", **more, **{"friction.law": "none"}).model
    shafts = [values[2:] for values in (model.links.stiffness, model.links.damping)]
    links = (np.vstack([size * BEARINGS, own]) for size, own in zip((2e8, 3e3), shafts, strict=True))
    model = altered(model, links=dict(zip(("stiffness", "damping"), links, strict=True)))
    if keeps:
        model.links.stiffness[1, 2], model.links.damping[1, 2] = 3e4, 5.0  # arrays of this test
        layout = model.layout._replace(holds=type(model.layout.holds)([0, keeps]))
        model = model._replace(options=model.options._replace(layout=layout))
    layout, schedule = model.layout, model.schedule
    states, mechanical, slip = layout.states, layout.mechanical, layout.half + LAG
    make_plain(monkeypatch, jacobian)
    monkeypatch.setattr(jacobian, "rhs", derivatives)
    segment, phase = 0, 0.4 * float(schedule.end[0])
    y = random_state(rng, model, float(model.operation.nominal_speed))
    y[TURN_G] = -40e-6 / model.meshes[0].driven_radius  # well in contact
    f = accelerations(y, phase, segment, model)
    work = contacts_of(model)
    derivatives(phase, 0.0, segment, y, model, work, {})
    scale = state_scales(model, y)
    found = Differences(np.zeros(states), np.full((states, mechanical), np.nan), np.zeros(states))
    place = Place(phase, 0.0, segment, float(schedule.end[0]))
    kept = y.copy()
    count = plain(differentiate)(place, y, f, scale, model, work, found)
    assert count == evaluations
    np.testing.assert_array_equal(y, kept)
    step = 1e-5 * scale[:mechanical]
    step[slip] = min(step[slip], 1e-5 * float(model.operation.nominal_speed))
    shift = np.zeros((mechanical, states))
    shift[:, :mechanical] = np.diag(step)
    up, down = (accelerations(y + sign * shift, phase, segment, model) for sign in (1, -1))
    expected = (up - down).T / (2.0 * step)
    unknown = [slip] if model.options.drive == DRIVE_SPEED else []
    unknown += [] if len(model.operation.load_amplitudes) else [LAG]
    compared = [j for j in range(mechanical) if j not in unknown]
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
        out[:] = np.arange(PAIR.states) * phase

    monkeypatch.setattr(jacobian, "rhs", rates)
    end, states = float(model.schedule.end[0]), PAIR.states
    found = Differences(np.zeros(states), np.zeros((states, PAIR.mechanical)), np.zeros(states))
    at_rest, work = np.zeros(states), contacts_of(model)
    for phase, behind in ((end - 1e-9, False), (0.5 * end, True)):
        asked.clear()
        place = Place(phase, 0.0, 0, end)
        derivatives(phase, 0.0, 0, at_rest, model, work, {})
        plain(differentiate)(place, at_rest, np.arange(states) * phase, np.ones(states), model, work, found)
        assert (asked[-1] > phase) == behind
        assert asked[-1] < end
        np.testing.assert_allclose(found.slope, np.arange(states), rtol=1e-5)
