"""Reported quantities and sentences of a record's summary; a sweep keeps the same."""

from tribodyn.quantities.quantity import Quantity, Reported
from tribodyn.record.reader import Record

REPORTED: Reported = {
    "Geometry": (Quantity("contact_ratio", "Contact ratio", digits=".4f"),),
    "Sliding": (
        Quantity("pinion_specific_sliding_min", "Minimum specific sliding, pinion"),
        Quantity("gear_specific_sliding_min", "Minimum specific sliding, gear"),
        Quantity("sliding_speed_max", "Maximum sliding speed", "m/s"),
    ),
}

SWEPT = tuple(quantity for table in REPORTED.values() for quantity in table)


def sentences(record: Record) -> list[str]:
    """Say what the quantities leave out."""
    return ["Rigid teeth on the theoretical path of contact: no load, no vibration."]
