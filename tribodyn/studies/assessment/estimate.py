"""What an assessment takes, before any work."""

from tribodyn.studies.assessment.case import AssessmentCase
from tribodyn.studies.assessment.layout import LAYOUT
from tribodyn.studies.estimate import PROGRAM, Driver, Estimate, record_bytes
from tribodyn.studies.gears_estimate import FINITE_ELEMENTS, OUTLINES, pressed_memory, pressed_seconds

#: Positions of the slow rotation, and places of one pair's path among them.
POSITIONS, PLACES = 60, 120
#: Seconds of a steady state and of one friction law, bytes of a steady state while all are evaluated.
A_STATE, A_LAW, STATE = 0.15, 0.5, 100e3


def estimate(case: AssessmentCase) -> Estimate:
    """What a run of a case takes."""
    settings = case.settings
    seconds = pressed_seconds(float(POSITIONS) * (1 + len(settings.torque_shares)), 1.0)
    seconds += A_STATE * settings.speeds + A_LAW * len(settings.friction_laws)
    return Estimate(
        PROGRAM + pressed_memory(POSITIONS, 1.0) + STATE * settings.speeds,
        record_bytes(LAYOUT, {"roll_angle": PLACES}) + OUTLINES,
        seconds,
        (Driver("assessment.speeds", settings.speeds, 46),),
        FINITE_ELEMENTS,
    )
