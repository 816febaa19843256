"""What a sweep of the oscillator with backlash takes, before any work."""

import math

from tribodyn.studies.backlash_oscillator.case import BacklashOscillatorCase
from tribodyn.studies.backlash_oscillator.layout import LAYOUT
from tribodyn.studies.protocol.estimate import PROGRAM, Driver, Estimate, record_bytes

#: Seconds of a period of the excitation, and of a radian of the free oscillation in it.
A_PERIOD, A_RADIAN = 2e-6, 2e-7
#: Periods that a motion takes that settles; the least damping that is looked at.
SETTLED, LEAST_DAMPING = 30.0, 1e-6


def estimate(case: BacklashOscillatorCase) -> Estimate:
    """What a run of a case takes."""
    count = len(case.frequencies)
    record = record_bytes(LAYOUT, {"frequency": count, "direction": 2, "multiplier": 2})
    settling = min(float(case.max_periods), SETTLED / max(case.damping, LEAST_DAMPING))
    longest = sum(2.0 * math.pi / frequency for frequency in case.frequencies)
    seconds = 2.0 * settling * (A_PERIOD * count + A_RADIAN * longest)
    drivers = (
        Driver("frequency", count, 400),
        Driver("solver.max_periods", case.max_periods, 600),
        Driver("frequency", longest / count, 10.0, "leave out the lowest"),
    )
    return Estimate(PROGRAM + 4.0 * record, record, seconds, drivers)
