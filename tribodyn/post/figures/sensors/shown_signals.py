"""Which signals of a record a figure shows, in which unit, and where its shafts and meshes turn."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.post.style import literal
from tribodyn.record.reader import Record
from tribodyn.record.sensors import SENSORS, Sensed, SensorSignal, read_sensed
from tribodyn.signals.lines import MESH, SHAFT, SignalLine

#: Signals in a figure, at most.
MOST = 6
#: Samples that a spectrum needs.
FEWEST = 32
#: SI unit of a signal -> that of a figure and the factor to it.
UNITS = {"m/s2": ("m/s²", 1.0), "m": ("µm", 1e6), "rad": ("µrad", 1e6), "N*m": ("N m", 1.0)}


class ShownSignal(NamedTuple):
    """A signal as a figure shows it."""

    signal: SensorSignal
    values: Float[Array, " sample"]  # in `unit`
    unit: str
    name: str  # as figures write it

    @property
    def turning(self) -> float:
        """Mean turns of the reference in a second."""
        turns, time = self.signal.turns, self.signal.time
        return float((turns[-1] - turns[0]) / (time[-1] - time[0]))


def has_signals(record: Record) -> bool:
    """Whether a record holds signals that are long enough for a spectrum."""
    return SENSORS in record.groups and any(len(s.values) >= FEWEST for s in read_sensed(record).signals)


def shown_signals(records: Sequence[Record]) -> tuple[Sensed, list[ShownSignal]]:
    """The signals of the first record that has some; InputError where none has."""
    for record in records:
        sensed = read_sensed(record)
        signals = [_shown(signal) for signal in sensed.signals if len(signal.values) >= FEWEST][:MOST]
        if signals:
            return sensed, signals
    path = str(records[0].path)
    raise InputError("record", path, "holds no signals of sensors", "add a [[sensor]] and run it again")


def _shown(signal: SensorSignal) -> ShownSignal:
    unit, factor = UNITS.get(signal.units, (signal.units, 1.0))
    return ShownSignal(signal, signal.values * factor, unit, literal(signal.name))


def shafts_of(lines: Sequence[SignalLine]) -> list[SignalLine]:
    """Shafts that turn."""
    return [line for line in lines if line.sort == SHAFT and line.order > 0.0]


def toothed(lines: Sequence[SignalLine]) -> list[tuple[SignalLine, list[int]]]:
    """Shafts with the orders of the meshes of their gears, where these are whole."""
    meshes = [line for line in lines if line.sort == MESH]
    shafts = [(shaft, sorted({shaft.teeth_of(mesh) for mesh in meshes} - {0})) for shaft in shafts_of(lines)]
    return [(shaft, teeth) for shaft, teeth in shafts if teeth]


def turns_of(signal: SensorSignal, shaft: SignalLine) -> float:
    """Revolutions of a shaft in a signal."""
    return float(np.ptp(signal.turns)) * shaft.order
