"""From a case to its record: the axis of the record is the path of contact."""

from pathlib import Path
from typing import Any

from tribodyn.cases.results import target, writer
from tribodyn.geometry.body import GEOMETRY, geometry_arrays
from tribodyn.numerics.parameter import Variable
from tribodyn.record.schema import Layout
from tribodyn.studies.protocol.study import Progress, RunResult
from tribodyn_example.specific_sliding.scenario import SlidingCase
from tribodyn_example.specific_sliding.sliding import sliding_of, summary_of

_ALONG = ("signed_distance",)
LAYOUT = Layout(
    Variable(_ALONG, "m", "distance from the pitch point along the path of contact, negative in approach"),
    {
        "sliding_speed": Variable(_ALONG, "m/s", "speed of the pinion's flank over the gear's"),
        "pinion_specific_sliding": Variable(_ALONG, "1", "sliding over the pinion's own speed"),
        "gear_specific_sliding": Variable(_ALONG, "1", "sliding over the gear's own speed"),
    },
    groups={"geometry": GEOMETRY},
)


def run(
    case: SlidingCase,
    output: str | Path | None = None,
    *,
    force: bool = False,
    progress: Progress | None = None,
) -> RunResult:
    """Run a case and write its record; see `tribodyn.studies.protocol.study.Study.run`."""
    path = target(case, output, force)
    sliding = sliding_of(case)
    groups = {"geometry": geometry_arrays(sliding.assembly)}
    with writer(case, path, LAYOUT, case.positions, groups=groups, force=force) as record:
        record.write(
            0,
            {
                "signed_distance": sliding.signed_distance,
                "sliding_speed": sliding.sliding_speed,
                "pinion_specific_sliding": sliding.pinion,
                "gear_specific_sliding": sliding.gear,
            },
        )
        summary = summary_of(sliding)
        return RunResult(record.finish(summary), "complete", "", summary)


def quantities_of(case: SlidingCase) -> dict[str, Any]:
    """Quantities of a case without a record: what a sweep asks for."""
    return summary_of(sliding_of(case))
