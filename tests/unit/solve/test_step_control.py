"""When no step is possible any more, and why."""

import pytest

from tribodyn.solve.step_control import MINIMUM_STEP, refused

SMALL, USUAL, LIMIT = MINIMUM_STEP / 2, 1e-3, 10


@pytest.mark.parametrize(
    ("steps", "step", "speed", "reasons"),
    [
        (0, USUAL, 1.0, (False, False, False)),
        (LIMIT, USUAL, 1.0, (True, False, False)),
        (0, SMALL, 1.0, (False, True, False)),
        # steps vanish as the pinion stops; a light one still turns at a hundredth of its nominal speed then
        (0, SMALL, 0.01, (False, True, True)),
        (0, USUAL, 0.01, (False, False, False)),
        # an engagement has taken all its kinetic energy
        (0, USUAL, 0.0, (False, False, True)),
    ],
)
def test_reasons(steps, step, speed, reasons):
    """Too many steps, steps too small, the pinion at rest; speeds over a nominal 1 rad/s."""
    assert refused(steps, LIMIT, step, speed, 1.0) == reasons
