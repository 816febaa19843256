"""What a study of the solved contact takes, before any work."""

from tribodyn.studies.ehl.case import EhlCase
from tribodyn.studies.ehl.layout import PLACES, layout_of
from tribodyn.studies.protocol.estimate import PROGRAM, Driver, Estimate, record_bytes
from tribodyn.tribology.ehl.grid import STEP

#: Seconds of one solved position, contacts of the traction curve, and laws beside them.
A_POSITION, TRACTION, LAWS = 0.3, 9, 12
#: Seconds of a way with squeeze, and of each time step above those that the way takes anyway.
A_WAY, A_STEP = 8.0, 0.015


def estimate(case: EhlCase) -> Estimate:
    """What a run of a case takes."""
    sizes = {
        "phase": case.positions,
        "place": PLACES,
        "film_law": LAWS,
        "friction_law": LAWS,
        "slide_to_roll": TRACTION,
    }
    record = record_bytes(layout_of(case.transient), sizes)
    seconds = A_POSITION * (case.positions + TRACTION)
    if case.transient:
        seconds += A_WAY + A_STEP * case.positions
    seconds *= (STEP / case.step) ** 2
    return Estimate(
        PROGRAM + 4.0 * record, record, seconds, (Driver("output.positions", float(case.positions), 40),)
    )
