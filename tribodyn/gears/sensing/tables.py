"""Tables of a record's sensors: what they gave, and the indicators of every shaft."""

from collections.abc import Iterator, Mapping
from typing import Any

from tribodyn.cases.results import TextTable
from tribodyn.gears.sensing.numbers import SENSORS, SHAFTS
from tribodyn.quantities.signals import OF_SHAFT, OF_SIGNAL
from tribodyn.record.reader import Record


def sensor_tables(record: Record) -> list[TextTable]:
    """Tables of the sensors of a record; none where it has none."""
    known = record.summary.get(SENSORS)
    if not isinstance(known, Mapping):
        return []
    signals = {name: own for name, own in known.items() if isinstance(own, Mapping)}
    kinds = {str(table.get("name")): str(table.get("kind")) for table in record.scenario.get(SENSOR, ())}
    ordered = [name for name in kinds if name in signals] or list(signals)
    rows = [
        [name, kinds.get(name, ""), *(_written(signals[name], quantity) for quantity in OF_SIGNAL)]
        for name in ordered
    ]
    head = ("sensor", "kind", *(quantity.label for quantity in OF_SIGNAL))
    tables = [TextTable("Sensors, in SI units", head, rows)]
    shafts = [
        [name, shaft, *(_written(own, quantity) for quantity in OF_SHAFT)]
        for name in ordered
        for shaft, own in _shafts(signals[name])
    ]
    if shafts:
        head = ("sensor", "shaft", *(quantity.label for quantity in OF_SHAFT))
        tables.append(TextTable("Averages over the turns of the shafts", head, shafts))
    return tables


#: List of the sensors in a scenario.
SENSOR = "sensor"


def _shafts(signal: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    found = signal.get(SHAFTS)
    if isinstance(found, Mapping):
        yield from ((str(name), own) for name, own in found.items() if isinstance(own, Mapping))


def _written(own: Mapping[str, Any], quantity: Any) -> str:
    value = own.get(quantity.name)
    return "–" if value is None else quantity.written(value)
