"""Where the stability of an explicit method is estimated."""

import re
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from tribodyn.dynamics.approach import TURNED
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import SLIDING_DYNAMIC, SLIDING_KINEMATIC
from tribodyn.solve import choice
from tribodyn.solve.initial import accelerations, static_equilibrium
from tribodyn.solve.methods import AUTO, EXPLICIT, STIFF, SWITCHING
from tribodyn.solve.right_hand_side import contacts_of
from tribodyn.solve.tolerances import state_scales


def test_places_lie_closely_where_friction_reverses(prepared):
    """The outermost of those about the pitch point at the stated share of the width of reversal."""
    model = prepared("crc-23-47", **{"friction.sliding": "kinematic"}).model
    state = static_equilibrium(model)
    _, phases, segments = choice._places(model, choice.REVERSAL)
    turned = []
    for phase, segment in zip(phases, segments, strict=True):
        (work,) = works = contacts_of(model)
        derivatives(phase, 0.0, segment, state, model, works, {})
        turned.append(min(abs(work[TURNED, i]) for i in range(2) if (TURNED, i) in work))
    close = np.sort(turned)[: len(choice.REVERSAL)]
    assert close[0] == pytest.approx(0.0, abs=0.02)
    assert close[-1] == pytest.approx(choice.REVERSAL[-1], rel=0.1)


def test_steps_are_those_of_the_largest_eigenvalue_at_every_place(prepared):
    """Jacobians column by column, the radius integrated over the cycle by trapezoids."""
    model = prepared("crc-23-47", **{"friction.sliding": "kinematic", "mesh.points": 5}).model
    state = static_equilibrium(model)
    _, phases, segments = choice._places(model, choice.REVERSAL)
    mechanical = model.layout.mechanical
    scale = state_scales(model, state)
    radii = []
    for phase, segment in zip(phases[::12], segments[::12], strict=True):
        columns = []
        for i in range(mechanical):
            shift = np.zeros_like(state)
            shift[i] = 1e-3 * scale[i]
            up, down = (accelerations(state + by, phase, segment, model) for by in (shift, -shift))
            columns.append((up - down)[:mechanical] / (2.0 * shift[i]))
        radii.append(np.max(np.abs(np.linalg.eigvals(np.array(columns).T))))
    steps = np.sum(0.5 * np.diff(phases[::12]) * (np.array(radii)[1:] + np.array(radii)[:-1])) / 3.3
    last = phases[::12][-1]
    assert choice.stability_steps(model, state) * last == pytest.approx(steps, rel=0.1)


@pytest.mark.parametrize(
    ("sliding", "steps", "method", "said"),
    [
        (
            SLIDING_KINEMATIC,
            4999.0,
            EXPLICIT,
            "not stiff: explicit stability needs 4999 steps .*, below 5000",
        ),
        (SLIDING_KINEMATIC, 5001.0, STIFF, "^stiff: explicit stability needs 5001 steps .*, above 5000"),
        (SLIDING_DYNAMIC, 99.0, EXPLICIT, "below 100$"),
        (SLIDING_DYNAMIC, 101.0, SWITCHING, "stiff where flanks stick: .* above 100$"),
        (SLIDING_DYNAMIC, 10001.0, STIFF, "above 10000$"),
    ],
)
def test_the_method_follows_from_the_steps(monkeypatch, sliding, steps, method, said):
    monkeypatch.setattr(choice, "stability_steps", lambda *_: steps)
    model: Any = SimpleNamespace(options=SimpleNamespace(sliding=sliding))
    found = choice.choose(AUTO, model, np.zeros(1))
    assert found.method == method
    assert re.search(said, found.reason)
    assert choice.choose("bdf", model, np.zeros(1)) == ("bdf", "chosen in the scenario")
