"""What a study of the solved contact takes, before any work."""

from tribodyn.studies.ehl.case import EhlCase
from tribodyn.studies.ehl.layout import LAYOUT, PLACES
from tribodyn.studies.estimate import PROGRAM, Driver, Estimate, record_bytes

#: Seconds of one solved position, contacts of the traction curve, and laws beside them.
A_POSITION, TRACTION, LAWS = 0.3, 9, 12


def estimate(case: EhlCase) -> Estimate:
    """What a run of a case takes."""
    sizes = {
        "phase": case.positions,
        "place": PLACES,
        "film_law": LAWS,
        "friction_law": LAWS,
        "slide_to_roll": TRACTION,
    }
    record = record_bytes(LAYOUT, sizes)
    seconds = A_POSITION * (case.positions + TRACTION)
    return Estimate(
        PROGRAM + 4.0 * record, record, seconds, (Driver("output.positions", float(case.positions), 40),)
    )
