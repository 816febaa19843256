"""Reported quantities of a train, and how far to trust them."""

from tribodyn.quantities.quantity import Reported
from tribodyn.record.reader import Record

REPORTED: Reported = {}


def sentences(record: Record) -> list[str]:
    """Say how well the run satisfies what can be checked."""
    return []
