"""Indicators of a run's signals: for its summary, and as tables of its record's sensors."""

from collections.abc import Iterator, Mapping
from math import isfinite
from typing import Any

import numpy as np

from tribodyn.cases.results import TextTable
from tribodyn.quantities.catalogue import GROUPS
from tribodyn.record.reader import Record
from tribodyn.record.sensors import Sensed, SensorSignal
from tribodyn.sensing.sound import level_of, power_of
from tribodyn.signals.indicators import of_average, of_signal, synchronous_average
from tribodyn.signals.lines import MESH, SHAFT, SignalLine

#: In a summary: signals by name; in one of them shafts by name.
SENSORS, SHAFTS = "sensors", "shafts"
#: Turns of a shaft from which its average is worth a number.
FEWEST_TURNS = 2
#: Changes of a signal over its largest magnitude that are rounded digits.
ROUNDED = 1e-12


def signal_quantities(sensed: Sensed) -> dict[str, Any]:
    """Numbers of every signal, and of its average over the turns of every shaft that turned often enough."""
    if not sensed.signals:
        return {}
    return {
        SENSORS: {
            signal.name: {n: v for n, v in _of_signal(signal).items() if isfinite(v)}
            | _of_shafts(signal, sensed.lines)
            for signal in sensed.signals
            if len(signal.values) > 1
        }
    }


def _of_signal(signal: SensorSignal) -> dict[str, float]:
    values = signal.values
    constant = np.ptp(values) <= ROUNDED * np.max(np.abs(values))
    numbers = of_signal(np.zeros_like(values) if constant else values)
    if signal.kind == "sound":
        power = power_of(signal.values)
        numbers |= {"sound_power": power, "sound_power_level": level_of(power)}
    return numbers


def _of_shafts(signal: SensorSignal, lines: tuple[SignalLine, ...]) -> dict[str, Any]:
    shafts = {}
    for shaft, teeth in toothed_shafts(lines):
        if turns_of(signal, shaft) >= FEWEST_TURNS:
            average = synchronous_average(signal.values, signal.turns * shaft.order)
            indicators = of_average(average.values, teeth) | {"turns": average.turns}
            shafts[shaft.name] = {name: value for name, value in indicators.items() if isfinite(value)}
    return {SHAFTS: shafts} if shafts else {}


def toothed_shafts(lines: tuple[SignalLine, ...]) -> list[tuple[SignalLine, list[int]]]:
    """Shafts with the orders of the meshes of their gears, where these are whole."""
    meshes = [line for line in lines if line.sort == MESH]
    toothed = []
    for shaft in lines:
        if shaft.sort == SHAFT:
            teeth = sorted({shaft.teeth_of(mesh) for mesh in meshes} - {0})
            if teeth:
                toothed.append((shaft, teeth))
    return toothed


def turns_of(signal: SensorSignal, shaft: SignalLine) -> float:
    """Revolutions of a shaft in a signal."""
    return float(signal.turns[-1] - signal.turns[0]) * shaft.order if len(signal.turns) > 1 else 0.0


def on_silent(summary: Mapping[str, Any]) -> list[str]:
    """Say which sensors are where the scenario gives a constant."""
    sensors = summary.get(SENSORS)
    signals = sensors.items() if isinstance(sensors, Mapping) else ()
    silent = [str(name) for name, of in signals if isinstance(of, Mapping) and of.get("peak_to_peak") == 0.0]
    if not silent:
        return []
    names, hear = ", ".join(silent), "hears" if len(silent) == 1 else "hear"
    return [f"{names} {hear} nothing: what is measured there is given, and constant."]


def sensor_tables(record: Record) -> list[TextTable]:
    """Tables of the sensors of a record; none where it has none."""
    sensors = record.summary.get(SENSORS)
    if not isinstance(sensors, Mapping):
        return []
    signals = {name: numbers for name, numbers in sensors.items() if isinstance(numbers, Mapping)}
    kinds = {str(table.get("name")): str(table.get("kind")) for table in record.scenario.get(SENSOR, ())}
    ordered = [name for name in kinds if name in signals] or list(signals)
    rows = [
        [name, kinds.get(name, ""), *(_written(signals[name], quantity) for quantity in GROUPS["of_signal"])]
        for name in ordered
    ]
    head = ("sensor", "kind", *(quantity.label for quantity in GROUPS["of_signal"]))
    tables = [TextTable("Sensors, in SI units", head, rows)]
    loud = [
        [name, *(_written(signals[name], quantity) for quantity in GROUPS["of_sound"])]
        for name in ordered
        if GROUPS["of_sound"][0].name in signals[name]
    ]
    if loud:
        head = ("sensor", *(f"{quantity.label}, {quantity.unit}" for quantity in GROUPS["of_sound"]))
        tables.append(TextTable("Sound that the housing radiates", head, loud))
    shafts = [
        [name, shaft, *(_written(numbers, quantity) for quantity in GROUPS["of_shaft"])]
        for name in ordered
        for shaft, numbers in _shafts(signals[name])
    ]
    if shafts:
        head = ("sensor", "shaft", *(quantity.label for quantity in GROUPS["of_shaft"]))
        tables.append(TextTable("Averages over the turns of the shafts", head, shafts))
    return tables


#: List of the sensors in a scenario.
SENSOR = "sensor"


def _shafts(signal: Mapping[str, Any]) -> Iterator[tuple[str, Mapping[str, Any]]]:
    shafts = signal.get(SHAFTS)
    if isinstance(shafts, Mapping):
        yield from ((str(name), numbers) for name, numbers in shafts.items() if isinstance(numbers, Mapping))


def _written(numbers: Mapping[str, Any], quantity: Any) -> str:
    value = numbers.get(quantity.name)
    return "–" if value is None else quantity.written(value)
