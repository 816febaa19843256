"""What an efficiency study takes, before any work."""

from tribodyn.studies.efficiency.case import EfficiencyCase
from tribodyn.studies.gears.estimate import FINITE_ELEMENTS, OUTLINES, pressed_memory, pressed_seconds
from tribodyn.studies.gears.shared import LAYOUT
from tribodyn.studies.protocol.estimate import PROGRAM, Driver, Estimate, record_bytes

#: Pairs in contact at once; bytes and seconds of a sample while it is worked out; seconds of the cycle means,
#: and positions at which these share the load.
PAIRS, A_SAMPLE_HELD, A_SAMPLE, MEANS, POSITIONS = 2, 1250.0, 6e-5, 0.2, 3000.0
#: Bytes that places on the path take at once while they are sought.
PATH = 6 * 2.0**20


def estimate(case: EfficiencyCase) -> Estimate:
    """What a run of a case takes."""
    samples, slices = float(case.samples_per_cycle), case.mesh.slices
    record = record_bytes(LAYOUT, {"time": case.samples_per_cycle + 1, "pair": PAIRS, "dof": 6}) + OUTLINES
    memory, seconds, shared = PROGRAM + PATH + A_SAMPLE_HELD * samples, MEANS + A_SAMPLE * samples, 0.0
    if case.mesh.at_load:
        memory += pressed_memory(samples, slices)
        seconds += pressed_seconds(samples + POSITIONS, slices)
        shared = FINITE_ELEMENTS
    drivers = (
        Driver("output.samples_per_cycle", samples, 200),
        Driver("mesh.slices", slices, 21),
    )
    return Estimate(memory, record, seconds, drivers, shared)
