"""Numbers of a run's signals for its summary."""

from math import isfinite
from typing import Any

from tribodyn.record.sensors import Sensed, SensorSignal
from tribodyn.signals.indicators import of_average, of_signal
from tribodyn.signals.lines import MESH, SHAFT, SignalLine
from tribodyn.signals.synchronous import synchronous_average

#: In a summary: signals by name; in one of them shafts by name.
SENSORS, SHAFTS = "sensors", "shafts"
#: Turns of a shaft from which its average is worth a number.
FEWEST_TURNS = 2


def signal_quantities(sensed: Sensed) -> dict[str, Any]:
    """Numbers of every signal, and of its average over the turns of every shaft that turned often enough."""
    if not sensed.signals:
        return {}
    return {
        SENSORS: {
            signal.name: {n: v for n, v in of_signal(signal.values).items() if isfinite(v)}
            | _of_shafts(signal, sensed.lines)
            for signal in sensed.signals
            if len(signal.values) > 1
        }
    }


def _of_shafts(signal: SensorSignal, lines: tuple[SignalLine, ...]) -> dict[str, Any]:
    found = {}
    for shaft, teeth in toothed_shafts(lines):
        if turns_of(signal, shaft) >= FEWEST_TURNS:
            average = synchronous_average(signal.values, signal.turns * shaft.order)
            known = of_average(average.values, teeth) | {"turns": average.turns}
            found[shaft.name] = {name: value for name, value in known.items() if isfinite(value)}
    return {SHAFTS: found} if found else {}


def toothed_shafts(lines: tuple[SignalLine, ...]) -> list[tuple[SignalLine, list[int]]]:
    """Shafts with the orders of the meshes of their gears, where these are whole."""
    meshes = [line for line in lines if line.sort == MESH]
    found = []
    for shaft in lines:
        if shaft.sort == SHAFT:
            teeth = sorted({shaft.teeth_of(mesh) for mesh in meshes} - {0})
            if teeth:
                found.append((shaft, teeth))
    return found


def turns_of(signal: SensorSignal, shaft: SignalLine) -> float:
    """Revolutions of a shaft in a signal."""
    return float(signal.turns[-1] - signal.turns[0]) * shaft.order if len(signal.turns) > 1 else 0.0
