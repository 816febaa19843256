"""Reported quantities of a frequency sweep, and how far to trust them."""

from tribodyn.post.verdict import numbers, share
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


def verdict(record: Record) -> list[str]:
    """Say where the response is largest, where contact is lost, where it jumps, and what does not repeat."""
    summary, lines = numbers(record.summary), []
    if {"rms_max", "rms_max_frequency"} <= set(summary):
        largest, place = summary["rms_max"], summary["rms_max_frequency"]
        lines.append(
            f"The response is largest at Ω = {place:.4g}: {largest:.3g} half backlashes RMS about the mean."
        )
    if {"contact_loss_from", "contact_loss_to", "contact_loss_fraction_max"} <= set(summary):
        ends = " to ".join(f"{summary[f'contact_loss_{end}']:.4g}" for end in ("from", "to"))
        longest = share(summary["contact_loss_fraction_max"])
        lines.append(f"The teeth separate from Ω = {ends}, for {longest} of the time at most.")
    elif "rms_max" in summary:
        lines.append("The teeth stay in contact at all frequencies.")
    if {"bistable_from", "bistable_to"} <= set(summary):
        ends = " to ".join(f"{summary[f'bistable_{end}']:.4g}" for end in ("from", "to"))
        lines.append(f"Two motions exist from Ω = {ends}: which one is met depends on the way there.")
    points = summary.get("points", 0.0)
    if wandering := summary.get("points_not_periodic"):
        chaotic = summary.get("points_chaotic", 0)
        lines.append(f"{wandering:.0f} of {points:.0f} points do not repeat, {chaotic:.0f} of them chaotic.")
    if failed := summary.get("points_failed"):
        lines.append(
            f"{failed:.0f} of {points:.0f} points grow without bound: there is no steady motion there."
        )
    return lines


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
