"""What a sweep of the oscillator with backlash takes, before any work."""

import math

from tribodyn.studies.backlash_oscillator.case import BacklashOscillatorCase
from tribodyn.studies.backlash_oscillator.layout import LAYOUT
from tribodyn.studies.protocol.cost import forced_periods, recorded, total
from tribodyn.studies.protocol.estimate import Driver, Estimate

#: Periods that a motion takes that settles; the least damping that is looked at.
SETTLED, LEAST_DAMPING = 30.0, 1e-6


def estimate(case: BacklashOscillatorCase) -> Estimate:
    """What a run of a case takes."""
    count = len(case.frequencies)
    settling = min(float(case.max_periods), SETTLED / max(case.damping, LEAST_DAMPING))
    longest = sum(2.0 * math.pi / frequency for frequency in case.frequencies)
    drivers = (
        Driver("frequency", count, 400),
        Driver("solver.max_periods", case.max_periods, 600),
        Driver("frequency", longest / count, 10.0, "leave out the lowest"),
    )
    record = recorded(LAYOUT, {"frequency": count, "direction": 2, "multiplier": 2}, copies=4.0)
    return total(drivers, record, forced_periods(2.0 * settling * count, 2.0 * settling * longest))
