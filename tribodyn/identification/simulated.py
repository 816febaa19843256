"""What sensors measured, and residuals: that less what those of a scenario hear, at shares of ranges."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases.cost import Estimate
from tribodyn.errors import InputError, SimulationError, unknown_name
from tribodyn.identification.fit import MARGIN
from tribodyn.identification.unknowns import Unknown, case_at, shares_of
from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.reader import Record
from tribodyn.record.sensors import Sensed, read_sensed
from tribodyn.studies import study_of
from tribodyn.studies.protocol.batch import SignalRequest

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


def turn_of(case: Any) -> float:
    """Time of a turn of the body that drives the first mesh, s."""
    batch: Any = study_of({"kind": case.kind}).batch()
    return batch.turn(case)


#: Residual of a place at which there is no run, over the deviation of what was measured.
FAR = 100.0


class SignalComparison:
    """Compares a scenario with what was measured, at several places side by side."""

    def __init__(
        self,
        case: Any,
        unknowns: Sequence[Unknown],
        measured: Sequence[MeasuredSignal],
        run_in: float,
        without_mean: bool,
        workers: int | None,
    ) -> None:
        # noise and steps of a converter belong to what was measured
        clean = (replace(each, noise=0.0, snr=None, bits=None, full_scale=None) for each in case.sensors)
        self._sensors = {each.name: each for each in clean}
        self._case, self._unknowns, self._measured = case, unknowns, measured
        self._run_in, self._without_mean, self._workers = run_in, without_mean, workers
        batch = study_of({"kind": case.kind}).batch()
        if batch is None:
            raise InputError(
                "kind", f'"{case.kind}"', "such a study has no sensors", "use gear-pair or gear-train"
            )
        self._batch: Any = batch.hearing(SignalRequest(1.0, run_in))
        self._last = max((one.first + len(one.values)) / self._sensors[one.sensor].rate for one in measured)
        self.scales = [max(float(np.std(one.values)), 1e-300) for one in measured]
        self.failure = ""
        base = replace(case, sensors=tuple(self._sensors.values()))
        self._batch.check(base, self._batch.settings([base], None, "native"))  # what no values will mend
        self._earliest = run_in * turn_of(case)

    @property
    def names(self) -> tuple[str, ...]:
        """Sensors that are compared."""
        return tuple(one.sensor for one in self._measured)

    def estimate(self, evaluations: int) -> Estimate:
        """What so many runs take at the dearest end of the ranges, each unknown moved by itself.

        Raises InputError for an end at which no run can be listened to.
        """
        shares, ends = shares_of(self._unknowns), []
        for i, unknown in enumerate(self._unknowns):
            for end, share in (("lower", MARGIN), ("upper", 1.0 - MARGIN)):
                place = shares.copy()
                place[i] = share
                try:
                    case = case_at(self._case, self._unknowns, place)
                except InputError:  # an end that no scenario has, such as no speed at all
                    continue
                case = replace(case, sensors=tuple(self._sensors.values()))
                try:
                    ends.append(self._batch.taken(case, self._earliest, self._last, evaluations))
                except InputError as error:
                    value = f"{unknown.low:g} to {unknown.high:g}"
                    raise InputError(
                        unknown.name, value, f"near its {end} end {error.rule}", "narrow the range"
                    ) from None
        return max(ends, key=lambda one: one.seconds, default=Estimate())

    def apart(self, shares: Float[Array, "place unknown"]) -> list[list[Float[Array, " sample"]]]:
        """Residuals of each sensor at places, in its own unit."""
        cases: list[Any] = []
        for place in shares:
            try:
                case = case_at(self._case, self._unknowns, place)
                cases.append(
                    replace(case, sensors=tuple(self._sensors[one.sensor] for one in self._measured))
                )
            except InputError as error:
                cases.append(str(error))
        sound = [i for i, case in enumerate(cases) if not isinstance(case, str)]
        signals_of: dict[int, Sensed | str] = dict(enumerate(cases)) if len(sound) < len(cases) else {}
        if sound:
            signals = self._batch.heard([cases[i] for i in sound], self._earliest, self._last, self._workers)
            signals_of |= dict(zip(sound, signals, strict=True))
        return [self._residuals(signals_of[i]) for i in range(len(cases))]

    def __call__(self, shares: Float[Array, "place unknown"]) -> list[Float[Array, " residual"]]:
        """Residuals at places over the scales of their sensors, one after the other."""
        every = self.apart(shares)
        return [
            np.concatenate([part / scale for part, scale in zip(parts, self.scales, strict=True)])
            for parts in every
        ]

    def _residuals(self, sensed: Sensed | str) -> list[np.ndarray]:
        if isinstance(sensed, str):
            self.failure = sensed
            pairs = zip(self._measured, self.scales, strict=True)
            return [np.full(len(one.values), FAR * scale) for one, scale in pairs]
        residuals = []
        for one in self._measured:
            signal = sensed[one.sensor]
            first = one.first - round(float(signal.time[0]) * signal.rate)
            values = signal.values[first : first + len(one.values)]
            if first < 0:
                rule = f"{one.sensor} has its first value {float(signal.time[0]):.4g} s after the run's start"
                raise InputError("run_in", f"{self._run_in:g}", rule, "leave out more turns")
            if len(values) < len(one.values):
                raise SimulationError("the run ends before what was measured", float(signal.time[-1]))
            rest = one.values - values
            residuals.append(rest - np.mean(rest) if self._without_mean else rest)
        return residuals
