"""What a run of a gear with rolling elements takes, before any work."""

from tribodyn.studies.protocol.estimate import PROGRAM, Driver, Estimate, record_bytes
from tribodyn.studies.rolling.layout import LAYOUT
from tribodyn.studies.rolling.scenario import RollingCase

#: How often a cycle's samples are held; seconds of an element at a sample.
HELD, A_SAMPLE = 3.0, 1e-6


def estimate(case: RollingCase) -> Estimate:
    """What a run of a case takes."""
    cycle, elements = case.samples_per_cycle, case.drive.elements
    samples = 1 if case.mode == "as_published" else cycle * (elements + 1) + 1
    record = record_bytes(LAYOUT, {"time": samples, "element": elements})
    part = record_bytes(LAYOUT, {"time": cycle, "element": elements})
    # what the summary keeps of every sample, and what a picture reads
    kept = 32.0 * samples + 0.05 * record
    seconds = 0.1 + A_SAMPLE * (float(samples) + cycle) * elements
    drivers = (Driver("output.samples_per_cycle", cycle, 40), Driver("drive.elements", elements, 20))
    return Estimate(PROGRAM + HELD * part + kept, record, seconds, drivers)
