"""What was measured, as it is compared: samples of the scenario's sensors from a moment of its run on."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError, unknown_name
from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.reader import Record
from tribodyn.record.sensors import Sensed, read_sensed

#: How far a moment may lie from one at which the sensor has a sample, in samples.
_ASIDE = 1e-3


class MeasuredSignal(NamedTuple):
    """Samples of one sensor."""

    sensor: str
    first: int  # number of the first sample, counted at the sensor's rate from the start of the run
    values: Float[Array, " sample"]


def measured_of(measured: Any, case: Any, start: float, earliest: float) -> tuple[MeasuredSignal, ...]:
    """Read what was measured: a record with sensors, or arrays by the names of the scenario's sensors.

    Arrays begin `start` seconds after the start of the run. What lies before `earliest`, s, is left out.
    Raises InputError for what is no measurement of these sensors.
    """
    rates = {sensor.name: sensor.rate for sensor in case.sensors}
    if not rates:
        remedy = 'add [[sensor]] with name = "a", kind = "acceleration", at = "gear" and rate = "20 kHz"'
        raise InputError(
            "sensor", None, "missing: it says what was measured, where and at which rate", remedy
        )
    if isinstance(measured, (str, Path)):
        with Record(measured) as record:
            signals = _of_record(read_sensed(record), rates, str(measured))
    elif hasattr(measured, "keys"):
        signals = [_of_array(str(name), measured[name], rates, start) for name in measured]
    else:
        rule = "expected the path of a record, or arrays by the names of sensors"
        raise InputError("measured", type(measured).__name__, rule, 'write {"a": values}')
    cut = tuple(_from(each, earliest * rates[each.sensor]) for each in signals)
    if not cut or not all(len(each.values) for each in cut):
        rule = f"no sample is left behind {earliest:.4g} s, when the run in ends"
        raise InputError("measured", None, rule, "measure longer, or shorten run_in")
    return cut


def _of_record(sensed: Sensed, rates: Mapping[str, float], path: str) -> list[MeasuredSignal]:
    signals = [
        MeasuredSignal(signal.name, round(float(signal.time[0]) * signal.rate), signal.values)
        for signal in sensed.signals
        if signal.name in rates and len(signal.time) and signal.rate == rates[signal.name]
    ]
    if not signals:
        rule = f"holds no signal of {', '.join(rates)} at the scenario's rates"
        raise InputError("measured", path, rule, "run a scenario with these sensors")
    return signals


def _of_array(name: str, values: Any, rates: Mapping[str, float], start: float) -> MeasuredSignal:
    if name not in rates:
        raise unknown_name("measured", name, rates, "sensor")
    try:
        array = np.asarray(values)
        array = array.astype(float) if array.dtype.kind in "biufO" else None
    except (TypeError, ValueError, OverflowError):
        array = None
    if array is None:
        raise InputError("measured", name, "is no array of real numbers", "give one value per sample")
    if array.ndim != 1 or not array.size or not np.all(np.isfinite(array)):
        rule = (
            f"has shape {array.shape}" if array.ndim != 1 or not array.size else "has samples without value"
        )
        raise InputError("measured", name, rule, "give a row of finite values, one per sample")
    place = start * rates[name]
    if not start >= 0.0 or abs(place - round(place)) > _ASIDE:
        rule = (
            f"is no moment at which {name} has a sample: these are at multiples of {1.0 / rates[name]:.6g} s"
        )
        raise InputError("start", f"{start:.9g} s", rule, f"write {round(place) / rates[name]:.9g} s")
    return MeasuredSignal(name, round(place), array)


def _from(signal: MeasuredSignal, earliest: float) -> MeasuredSignal:
    left_out = max(0, int(np.ceil(earliest - 1e-6)) - signal.first)
    return MeasuredSignal(signal.sensor, signal.first + left_out, signal.values[left_out:])
