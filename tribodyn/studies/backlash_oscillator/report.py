"""Lines and sentences of the summary of a frequency sweep, and the figures that a sweep over it keeps."""

from tribodyn.numerics.variable import Variable
from tribodyn.post.report import Line, Lines
from tribodyn.record.reader import Record

LINES: Lines = {
    "Response": (
        Line(
            "points",
            "Points, up and down",
            form="d",
            definition="Motions that were sought: every frequency on the way up and on the way down.",
        ),
        Line(
            "points_of_longer_period",
            "with a longer period than the excitation's",
            form="d",
            definition="Points whose motion repeats after several periods of the excitation.",
        ),
        Line(
            "points_not_periodic",
            "not periodic",
            form="d",
            definition="Points without a stable periodic motion of up to the longest period that is sought.",
        ),
        Line(
            "points_quasi_periodic",
            "of these quasi-periodic",
            form="d",
            definition="Points with a second frequency that no multiple of the excitation's meets; "
            "Lyapunov exponent zero.",
        ),
        Line(
            "points_chaotic",
            "of these chaotic",
            form="d",
            definition="Points with a positive Lyapunov exponent.",
        ),
        Line(
            "points_failed",
            "grown without bound",
            form="d",
            definition="Points whose motion grew without bound.",
        ),
        Line(
            "rms_max",
            "Maximum RMS about the mean, in half backlashes",
            definition="Maximum over all points of the root mean square of the displacement about its mean.",
        ),
        Line(
            "rms_max_frequency",
            "at the frequency",
            definition="Frequency of that point over the natural frequency of the oscillator in contact.",
        ),
        Line(
            "contact_loss_from",
            "Contact is lost from the frequency",
            definition="Lowest frequency at which contact is lost for part of the period.",
        ),
        Line(
            "contact_loss_to",
            "to the frequency",
            definition="Highest frequency at which contact is lost for part of the period.",
        ),
        Line(
            "contact_loss_fraction_max",
            "for at most this share of the time",
            100.0,
            "%",
            ".3g",
            definition="Maximum over all points of the share of the period without contact.",
        ),
        Line(
            "back_contact_fraction_max",
            "Contact on the back side, at most",
            100.0,
            "%",
            ".3g",
            definition="Maximum over all points of the share of the period in contact on the back side.",
        ),
        Line(
            "bistable_from",
            "Up and down differ from the frequency",
            definition="Lowest frequency at which the ways up and down end in different motions.",
        ),
        Line(
            "bistable_to",
            "to the frequency",
            definition="Highest frequency at which the ways up and down end in different motions.",
        ),
    ),
    "Solver": (
        Line(
            "wall_time",
            "Wall time",
            1.0,
            "s",
            ".3g",
            definition="Time that the computation took, without start and drawing.",
        ),
    ),
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
