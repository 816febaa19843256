"""Signals of sensors in a record: groups by rate with a time axis of their own, and the lines to be named.

``sensors/at_20000_Hz`` holds `time`, `reference_angle` and one dataset per sensor of that rate, with its
unit, its meaning and how it was made. A filter needs samples before and behind: sensors of the same rate with
another one have other times, and a group of their own. ``sensors/lines`` has the orders of meshes and shafts.
"""

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

import h5py
import numpy as np

from tribodyn.errors import harmless
from tribodyn.numerics.parameter import Variable
from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.layout import attach, describe, scale
from tribodyn.record.open_record import attributes
from tribodyn.record.reader import Record
from tribodyn.signals.lines import SORTS, SignalLine

SENSORS, LINES = "sensors", "lines"
_RATE, _FILTER = "at_{:.12g}_Hz", "filter"
#: Orders, rates (Hz) and shares of an interval by which it may differ from others that no sensor exceeds.
LARGEST_ORDER, LARGEST_RATE, EVEN = 1e6, 1e9, 1e-2
_TIME = Variable(("time",), "s", "time of the samples of sensors, even")
_ANGLE = Variable(("time",), "rad", "rotation of the reference body at these times")
_ORDER = Variable(("line",), "1", "order of a line: cycles per turn of the reference body")
_LINE = Variable(("line",), "1", "name of a line")


class SensorSignal(NamedTuple):
    """What a sensor gave."""

    name: str
    kind: str
    about: str  # what was measured
    units: str  # SI
    rate: float  # samples per second
    time: Float[Array, " sample"]  # s, even
    angle: Float[Array, " sample"]  # rotation of the reference, rad
    values: Float[Array, " sample"]
    made: Mapping[str, Any] = MappingProxyType({})  # filter, noise, seed and what else says how

    @property
    def turns(self) -> Float[Array, " sample"]:
        """Revolutions of the reference."""
        return self.angle / (2.0 * np.pi)


class Sensed(NamedTuple):
    """The signals of a run, and what the lines in their spectra are."""

    signals: tuple[SensorSignal, ...] = ()
    lines: tuple[SignalLine, ...] = ()
    reference: str = ""  # body that the orders count turns of

    def __getitem__(self, name: Any) -> Any:
        """A signal by its name; by a number as of any tuple."""
        if not isinstance(name, str):
            return tuple(self)[name]
        match = next((signal for signal in self.signals if signal.name == name), None)
        if match is None:
            raise KeyError(name)
        return match


def write_sensed(sensed: Sensed, file: h5py.File) -> None:
    """Put signals into a record; nothing where there are none."""
    if not sensed.signals:
        return
    group = file.create_group(SENSORS)
    group.attrs["reference"] = sensed.reference
    lines = group.create_group(LINES)
    lines.attrs["sorts"] = " ".join(line.sort for line in sensed.lines)
    names = scale(lines, "line", _LINE, np.array([line.name for line in sensed.lines], dtype="U"))
    order = lines.create_dataset("order", data=np.array([line.order for line in sensed.lines], dtype="<f8"))
    describe(order, _ORDER)
    attach(order, _ORDER, {"line": names})
    alike: dict[tuple[float, Any], list[SensorSignal]] = {}
    for signal in sensed.signals:
        alike.setdefault((signal.rate, signal.made.get(_FILTER)), []).append(signal)
    for (rate, filtered_by), signals in alike.items():
        name = _RATE.format(rate)
        _write_times(group.create_group(f"{name}_{filtered_by}" if name in group else name), rate, signals)


def _write_times(part: h5py.Group, rate: float, signals: Sequence[SensorSignal]) -> None:
    """Write signals of the same times into a group."""
    part.attrs["rate"], part.attrs["rate_units"] = rate, "Hz"
    scales = {"time": scale(part, "time", _TIME, signals[0].time)}
    arrays = {"reference_angle": (signals[0].angle, _ANGLE)}
    arrays |= {
        signal.name: (signal.values, Variable(("time",), signal.units, signal.about)) for signal in signals
    }
    for name, (values, variable) in arrays.items():
        dataset = part.create_dataset(name, data=np.asarray(values, dtype="<f8"))
        describe(dataset, variable)
        attach(dataset, variable, scales)
    for signal in signals:
        part[signal.name].attrs["kind"] = signal.kind
        for key, value in signal.made.items():
            part[signal.name].attrs[key] = value


def read_sensed(record: Record) -> Sensed:
    """The signals of a record, in the order of its scenario; none where it has no sensors.

    Raises InputError where what the file holds is none.
    """
    if SENSORS not in record.groups:
        return Sensed()
    with record.reading(SENSORS) as group:
        lines = group[LINES]
        names = [harmless(bytes(name).decode("utf-8", "replace")) for name in lines["line"][...]]
        sorts = str(lines.attrs["sorts"]).split()
        orders = np.asarray(lines["order"][...], dtype=float).tolist()
        if not np.all(np.abs(orders) < LARGEST_ORDER):
            raise ValueError("the order of a line is out of bounds")
        signal_lines = tuple(
            SignalLine(name, sort, order)
            for name, sort, order in zip(names, sorts, orders, strict=True)
            if sort in SORTS
        )
        signals = tuple(
            signal for name, part in group.items() if name != LINES for signal in _read_rate(part)
        )
        order = [str(table.get("name")) for table in _tables(record.scenario.get("sensor", ()))]
        place = {name: number for number, name in enumerate(order)}
        ordered = sorted(signals, key=lambda signal: place.get(signal.name, len(place)))
        return Sensed(tuple(ordered), signal_lines, harmless(str(group.attrs["reference"])))


def _tables(listed: Any) -> Iterable[Mapping[str, Any]]:
    return [table for table in listed if isinstance(table, Mapping)]


def _read_rate(part: Any) -> Iterable[SensorSignal]:
    time, angle = (np.asarray(part[name][...], dtype=float) for name in ("time", "reference_angle"))
    rate = float(part.attrs["rate"])
    if not 0.0 < rate < LARGEST_RATE or time.ndim != 1 or time.shape != angle.shape:
        raise ValueError("the rate of sensors is out of bounds, or time and rotation differ in length")
    if not np.all(np.abs(np.diff(time) * rate - 1.0) < EVEN):
        raise ValueError("the time of sensors is not even, or of another rate")
    if not np.all(np.diff(angle) > 0.0):
        raise ValueError("the rotation of sensors does not increase")
    for name, dataset in part.items():
        if name in ("time", "reference_angle"):
            continue
        held = attributes(dataset)
        settings = {
            key: value
            for key, value in held.items()
            if key not in ("units", "long_name", "kind") and key.islower()
        }
        values = np.asarray(dataset[...], dtype=float)
        if values.shape != time.shape or not np.all(np.isfinite(values)):
            raise ValueError(f"{name} is not a finite number throughout its time")
        yield SensorSignal(
            harmless(name), str(held["kind"]), str(held["long_name"]), str(held["units"]), rate, time, angle,
            values, settings,
        )  # fmt: skip
