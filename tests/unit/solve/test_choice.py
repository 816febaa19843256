"""Where the stability of an explicit method is estimated."""

import numpy as np
import pytest

from tribodyn.dynamics.contact_forces import TURNED, contact_forces
from tribodyn.dynamics.equations import locate
from tribodyn.solve import choice
from tribodyn.solve.initial import static_equilibrium


def test_places_lie_closely_where_friction_reverses(prepared):
    """The outermost of those about the pitch point at the stated share of the width of reversal."""
    model = prepared("crc-23-47", **{"friction.sliding": "kinematic"}).model
    state = static_equilibrium(model)
    phases, segments = choice._places(model)
    turned = []
    for phase, segment in zip(phases, segments, strict=True):
        work = {}
        contact_forces(segment, *locate(phase, segment, model.table), state, model, work)
        turned.append(min(abs(work[TURNED, i]) for i in range(2) if (TURNED, i) in work))
    close = np.sort(turned)[: choice.REVERSAL_PHASES]
    assert close[0] == pytest.approx(0.0, abs=0.02)
    assert close[-1] == pytest.approx(choice.REVERSAL_REACH, rel=0.1)
