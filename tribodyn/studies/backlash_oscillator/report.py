"""Lines and sentences of the summary of a frequency sweep, and the figures that a sweep over it keeps."""

from tribodyn.numerics.variable import Variable
from tribodyn.post.report import Line, Lines
from tribodyn.record.reader import Record

LINES: Lines = {
    "Response": (
        Line("points", "Points, up and down", form="d"),
        Line("points_of_longer_period", "with a longer period than the excitation's", form="d"),
        Line("points_not_periodic", "not periodic", form="d"),
        Line("points_quasi_periodic", "of these quasi-periodic", form="d"),
        Line("points_chaotic", "of these chaotic", form="d"),
        Line("points_failed", "grown without bound", form="d"),
        Line("rms_max", "Maximum RMS about the mean, in half backlashes"),
        Line("rms_max_frequency", "at the frequency"),
        Line("contact_loss_from", "Contact is lost from the frequency"),
        Line("contact_loss_to", "to the frequency"),
        Line("contact_loss_fraction_max", "for at most this share of the time", 100.0, "%", ".3g"),
        Line("back_contact_fraction_max", "Contact on the back side, at most", 100.0, "%", ".3g"),
        Line("bistable_from", "Up and down differ from the frequency"),
        Line("bistable_to", "to the frequency"),
    ),
    "Solver": (Line("wall_time", "Wall time", 1.0, "s", ".3g"),),
}

SWEPT: dict[str, Variable] = {
    "rms_max": Variable((), "1", "maximum root mean square of the displacement, in half backlashes"),
    "rms_max_frequency": Variable((), "1", "frequency of the maximum root mean square"),
    "contact_loss_from": Variable((), "1", "lowest frequency at which contact is lost"),
    "contact_loss_to": Variable((), "1", "highest frequency at which contact is lost"),
    "contact_loss_fraction_max": Variable((), "1", "maximum share of the time without contact"),
    "back_contact_fraction_max": Variable((), "1", "maximum share of the time in contact on the back side"),
    "bistable_from": Variable((), "1", "lowest frequency at which up and down differ"),
    "bistable_to": Variable((), "1", "highest frequency at which up and down differ"),
    "points_not_periodic": Variable((), "1", "points whose motion is not periodic"),
    "points_of_longer_period": Variable((), "1", "points with a longer period than the excitation's"),
}


def sentences(record: Record) -> list[str]:
    """Say how well periodic motions close, and which points are none."""
    summary = record.summary
    said = []
    if summary.get("residual_max") is not None:
        said.append(f"Periodic motions close within {summary['residual_max']:.1e} of half a backlash.")
    numbers = sorted(int(name[4:]) for name in summary if name.startswith("end_"))
    for number in numbers:
        said.append(f"A branch ends: {summary[f'end_{number}']}.")
        if f"unstable_{number}" in summary:
            said.append(f"Beyond it is unstable: {summary[f'unstable_{number}']}.")
    said += [f"At {summary[name]}." for name in sorted(summary) if name.startswith("remark_")]
    if "remarks_more" in summary:
        said.append(f"And {summary['remarks_more']} more points that are not periodic or failed.")
    return said
