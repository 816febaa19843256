"""What an assessment says in words: sentences that its record keeps, units as they are written."""

from collections.abc import Sequence

from tribodyn.quantities.quantity import Quantity
from tribodyn.record.reader import Record


def numbered(sentences: Sequence[str]) -> dict[str, str]:
    """Sentences as a summary keeps them, in order."""
    return {f"{number:02d}": sentence for number, sentence in enumerate(sentences, 1)}


def sentences(record: Record) -> list[str]:
    """Say what is assumed and what is extrapolated."""
    summary = record.summary
    return [str(text) for name in ("assumed", "extrapolated") for text in summary.get(name, {}).values()]


def unit_of(quantity: Quantity) -> str:
    """Its unit; temperatures by the standards are kept in °C."""
    return quantity.unit.replace("degC", "°C")
