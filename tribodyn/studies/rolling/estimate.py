"""What a run of a gear with rolling elements takes, before any work."""

from tribodyn.studies.protocol.cost import in_memory, recorded, rolling_elements, total
from tribodyn.studies.protocol.estimate import Driver, Estimate, record_bytes
from tribodyn.studies.rolling.layout import LAYOUT
from tribodyn.studies.rolling.scenario import RollingCase


def estimate(case: RollingCase) -> Estimate:
    """What a run of a case takes."""
    cycle, elements = case.samples_per_cycle, case.drive.elements
    samples = 1 if case.mode == "as_published" else cycle * (elements + 1) + 1
    return total(
        (Driver("output.samples_per_cycle", cycle, 40), Driver("drive.elements", elements, 20)),
        recorded(LAYOUT, {"time": samples, "element": elements}, copies=0.05),  # what a picture reads
        in_memory(3.0, record_bytes(LAYOUT, {"time": cycle, "element": elements})),
        in_memory(samples, 32.0),  # what the summary keeps of every sample
        rolling_elements(float(samples) + cycle, elements),
    )
