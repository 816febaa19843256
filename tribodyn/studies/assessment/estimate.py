"""What an assessment takes, before any work."""

from tribodyn.studies.assessment.case import AssessmentCase
from tribodyn.studies.assessment.layout import LAYOUT
from tribodyn.studies.gears.estimate import FINITE_ELEMENTS, OUTLINES, pressed_memory, pressed_seconds
from tribodyn.studies.protocol.estimate import PROGRAM, Driver, Estimate, record_bytes

#: Positions of the slow rotation, and places of one pair's path among them.
POSITIONS, PLACES = 60, 120
#: Seconds of a steady state, of one friction law and of a sample of deviations, bytes of a steady state while
#: all are evaluated.
A_STATE, A_LAW, A_SAMPLE, STATE = 0.15, 0.5, 0.7, 100e3


def estimate(case: AssessmentCase) -> Estimate:
    """What a run of a case takes."""
    settings = case.settings
    seconds = pressed_seconds(float(POSITIONS) * (1 + len(settings.torque_shares)), 1.0)
    seconds += A_STATE * settings.speeds + A_LAW * len(settings.friction_laws) + A_SAMPLE * settings.samples
    return Estimate(
        PROGRAM + pressed_memory(POSITIONS, 1.0) + STATE * (settings.speeds + settings.samples),
        record_bytes(LAYOUT, {"roll_angle": PLACES}) + OUTLINES,
        seconds,
        (
            Driver("assessment.speeds", settings.speeds, 46),
            Driver("assessment.samples", settings.samples, 16),
        ),
        FINITE_ELEMENTS,
    )
