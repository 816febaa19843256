"""Reported quantities of a frequency sweep, and how far to trust them."""

from tribodyn.quantities.catalogue import quantities
from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record

_OF_THE_WAYS = (
    *("rms_max", "rms_max_frequency"),
    *("contact_loss_from", "contact_loss_to", "contact_loss_fraction_max", "back_contact_fraction_max"),
    *("bistable_from", "bistable_to"),
)
_COUNTED = ("points_quasi_periodic", "points_chaotic", "points_failed")
REPORTED: Reported = {
    "Response": quantities(
        "points", "points_of_longer_period", "points_not_periodic", *_COUNTED, *_OF_THE_WAYS
    ),
    "Solver": quantities("wall_time"),
}
SWEPT = quantities(*_OF_THE_WAYS, "points_not_periodic", "points_of_longer_period")


def sentences(record: Record) -> list[str]:
    """Say how well periodic motions close, and which points are none."""
    summary = record.summary
    lines = []
    if summary.get("residual_max") is not None:
        lines.append(f"Periodic motions close within {summary['residual_max']:.1e} of half a backlash.")
    numbers = sorted(int(name[4:]) for name in summary if name.startswith("end_"))
    for number in numbers:
        lines.append(f"A branch ends: {summary[f'end_{number}']}.")
        if f"unstable_{number}" in summary:
            lines.append(f"Beyond it is unstable: {summary[f'unstable_{number}']}.")
    lines += [f"At {summary[name]}." for name in sorted(summary) if name.startswith("remark_")]
    if "remarks_more" in summary:
        lines.append(f"And {summary['remarks_more']} more points that are not periodic or failed.")
    return lines
