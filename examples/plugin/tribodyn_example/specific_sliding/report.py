"""Lines and sentences of a record's summary, and the figures that a sweep keeps."""

from tribodyn.numerics.variable import Variable
from tribodyn.post.report import Line, Lines
from tribodyn.record.reader import Record

LINES: Lines = {
    "Geometry": (Line("contact_ratio", "Contact ratio", form=".4f"),),
    "Sliding": (
        Line("pinion_specific_sliding_min", "Minimum specific sliding, pinion"),
        Line("gear_specific_sliding_min", "Minimum specific sliding, gear"),
        Line("sliding_speed_max", "Maximum sliding speed", 1.0, "m/s"),
    ),
}

SWEPT: dict[str, Variable] = {
    "contact_ratio": Variable((), "1", "transverse contact ratio"),
    "pinion_specific_sliding_min": Variable((), "1", "minimum specific sliding of the pinion"),
    "gear_specific_sliding_min": Variable((), "1", "minimum specific sliding of the gear"),
    "sliding_speed_max": Variable((), "m/s", "maximum sliding speed"),
}


def sentences(record: Record) -> list[str]:
    """Say what the figures leave out."""
    return ["Rigid teeth on the theoretical path of contact: no load, no vibration."]
