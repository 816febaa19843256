"""Many cases whose sensors are listened to: a row of signals for each, for data sets.

A case runs in from its start, and its signals begin at a moment of their own within the turn behind: what a
damaged tooth does is then not at the same place of every signal.
"""

import dataclasses
from collections.abc import Hashable, Sequence
from itertools import chain
from math import pi
from typing import Any, NamedTuple

import numpy as np

from tribodyn.cases import cost
from tribodyn.cases.cost import Estimate
from tribodyn.cases.results import CaseHead
from tribodyn.errors import InputError, SimulationError
from tribodyn.gears.sensing.listening import BLOCK, Heard, listen
from tribodyn.gears.sensing.sensor_places import FEWEST
from tribodyn.numerics.parameter import Variable
from tribodyn.record.sensors import Sensed
from tribodyn.record.sweep_schema import CASE, DONE, FAILED, OF_EVERY_SWEEP, SweepLayout
from tribodyn.record.withheld_efficiency import remarked, warned
from tribodyn.sensing.data import KINDS
from tribodyn.studies.motion.batch.gearboxes import (
    MOST_STATES,
    keys_of_tables,
    refuse_by_time,
    run_speed_of,
    states_of,
)
from tribodyn.studies.motion.batch.stretch import (
    HeardStretch,
    ListenedStretch,
    between,
    few_enough,
    samples_per_cycle,
    stretch_of,
)
from tribodyn.studies.motion.estimate import cost_keys, marching_of
from tribodyn.studies.motion.heat.settled import prepare_settled
from tribodyn.studies.motion.sensors import listener_of
from tribodyn.studies.protocol.batch import Chunk, SignalRequest

#: Cases that are marched together.
TOGETHER = 32
#: Seconds of one core in which a second of a sensor's signal is filtered, per sample.
_FILTERED = 8e-6

ANGLE = "reference_angle"
#: What is recorded of every case beside its signals.
OF_CASES: dict[str, Variable] = {
    "start_time": Variable((), "s", "time from the start of the run to the first sample"),
    "noise_seed": Variable((), "1", "seed of the noise of the case's sensors", "<i8", -1),
    "line_frequency": Variable(("line",), "Hz", "nominal frequency of a line: meshes, shafts, planets"),
}
_LINE = Variable(("line",), "1", "name of a line")


class SignalSettings(NamedTuple):
    """How the cases of a data set are listened to; plain data."""

    duration: float  # s
    run_in: float  # turns of the reference body
    seed: int
    samples: int  # of a reference cycle, by the slowest case at the ends of the axes
    #: sensors: names, units, meanings and rates, Hz
    names: tuple[str, ...]
    units: tuple[str, ...]
    about: tuple[str, ...]
    rates: tuple[float, ...]
    lines: tuple[str, ...]  # names
    cycles: int  # of the longest run, at the ends of the axes


class SignalBatch:
    """See `protocol.batch.Batch`."""

    states = 0

    def __init__(self, request: SignalRequest | None = None) -> None:
        self.request = request

    def settings(self, cases: Sequence[Any], transient: int | None, engine: str) -> SignalSettings:
        """How the cases are listened to; the sensors are those of the first."""
        assert self.request is not None
        duration, run_in, seed = self.request
        base = cases[0]
        refuse_by_time(base)
        if transient is not None:
            raise InputError("--transient", transient, "contradicts --signals", "give one of them")
        if engine == "jax":
            raise InputError("--engine", "jax", "signals come from the native solver", "omit it")
        if not base.sensors:
            remedy = 'add [[sensor]] with name = "a", kind = "acceleration", at = "gear" and rate = "20 kHz"'
            raise InputError("sensor", None, "missing: what a data set holds is what sensors hear", remedy)
        rates = [sensor.rate for sensor in base.sensors]
        paces = [run_speed_of(case) for case in cases]
        samples = samples_per_cycle(rates, paces)
        plain = SignalSettings(duration, run_in, seed, samples, (), (), (), tuple(rates), (), 0)
        longest = max(stretch_of(case, 0, self.request, rates).blocks for case in cases)
        plain = plain._replace(cycles=round(run_in * max(p.cycles for p in paces)) + BLOCK * (longest + 1))
        prepared = self._prepared(base, plain)
        listener = listener_of(prepared)
        if duration * min(rates) < FEWEST:
            rule = f"too short for {FEWEST} samples of the slowest sensor, {min(rates):g} in a second"
            raise InputError(
                "--signals", f"{duration:g} s", rule, f"use at least {FEWEST / min(rates):.3g} s"
            )
        placed = listener.sensors
        structures = {states_of(case): case for case in reversed(cases)}
        del structures[states_of(base)]
        listeners = [listener, *(listener_of(self._prepared(case, plain)) for case in structures.values())]
        return plain._replace(
            names=tuple(one.sensor.name for one in placed),
            units=tuple(KINDS[one.sensor.kind].units for one in placed),
            about=tuple(
                KINDS[one.sensor.kind].about.format(at=one.at, direction=one.sensor.direction)
                for one in placed
            ),
            lines=tuple(dict.fromkeys(line.name for each in listeners for line in each.lines)),
        )

    def following(self, settings: SignalSettings, unstable: bool) -> SignalSettings:
        """Refused: signals are of runs that begin by themselves."""
        raise InputError("--direction", None, "contradicts --signals", "omit one")

    def hearing(self, request: SignalRequest) -> "SignalBatch":
        """The batch for a request."""
        return SignalBatch(request)

    def layout(self, settings: SignalSettings) -> SweepLayout:
        """Signals, the rotation of the reference beside them, and what `OF_CASES` names."""
        variables, scales = {}, {}
        several = len(set(settings.rates)) > 1
        angles = {_angle_name(settings, rate) for rate in settings.rates}
        times = {f"time_{rate:.12g}_Hz" for rate in settings.rates}
        for name in {CASE, "line", *angles, *times, *OF_CASES, *OF_EVERY_SWEEP}.intersection(settings.names):
            rule = "names something that the data set has beside the signals"
            raise InputError("sensor", f'"{name}"', rule, "give the sensor another name")
        for rate in dict.fromkeys(settings.rates):
            time = f"time_{rate:.12g}_Hz" if several else "time"
            about = f"time from the first sample on, at {rate:.12g} samples per second"
            steps = np.arange(samples_of(settings, rate)) / rate
            scales[time] = (Variable((time,), "s", about), steps)
            rotation = f"rotation of the reference body since the first sample, at {rate:.12g} Hz"
            variables[_angle_name(settings, rate)] = Variable((time,), "rad", rotation, "<f4")
            for name, units, text, signal_rate in zip(
                settings.names, settings.units, settings.about, settings.rates, strict=True
            ):
                if signal_rate == rate:
                    variables[name] = Variable((time,), units, text, "<f4")
        scales["line"] = _LINE, settings.lines
        attributes = {"run_in": settings.run_in, "sensors": " ".join(settings.names)}
        if not several:
            attributes |= {"sampling_rate": settings.rates[0], "sampling_rate_units": "Hz"}
        return SweepLayout(variables | OF_CASES, scales, attributes)

    def size_of_chunk(self, settings: SignalSettings, total: int, width: int) -> int:
        """Cases to be marched together."""
        return max(1, min(TOGETHER, total))

    def estimate(self, case: Any, settings: SignalSettings, total: int, width: int) -> Estimate:
        """What one of so many cases takes."""
        together = min(total, TOGETHER)
        signal = sum(samples_of(settings, rate) for rate in settings.rates)
        one = cost.total(
            (*cost_keys(case), cost.CostKey("--signals", settings.cycles, 1000.0)),
            *marching_of(case, float(settings.cycles)),
            cost.in_memory(together * BLOCK * settings.samples, 8.0 * MOST_STATES),
            cost.in_memory(together * signal, 3 * 8.0),
            cost.Estimate(seconds=_FILTERED * signal),
        )
        return one._replace(record=8.0 * signal)

    def sharing(self, case: Any) -> Hashable:
        """Cases for which this is equal have the same tables."""
        return keys_of_tables(case)

    def check(self, case: Any, settings: SignalSettings) -> None:
        """Prepare a case, and place its sensors."""
        listener_of(self._prepared(case, settings))

    def evaluate(self, chunk: Chunk, settings: SignalSettings, workers: int | None) -> dict[str, np.ndarray]:
        """Return a row for every case of a chunk, for all datasets of its layout; by default by all cores."""
        rows = self.layout(settings).empty_rows(len(chunk.cases))
        ready: dict[int, Heard] = {}
        stretches: dict[int, ListenedStretch] = {}
        asked = SignalRequest(settings.duration, settings.run_in, settings.seed)
        valid = {i: case for i, case in enumerate(chunk.cases) if not isinstance(case, str)}
        for i, case in valid.items():
            stretches[i] = stretch_of(case, int(chunk.numbers[i]), asked, settings.rates)
        # of one length, so that the tables of their teeth's numbers have one shape
        ends = [stretch.first + BLOCK * stretch.blocks for stretch in stretches.values()]
        for i, case in enumerate(chunk.cases):
            if isinstance(case, str):
                _fail(rows, i, case)
                continue
            stretch = stretches[i]
            try:
                finer = self._finer(case, settings)
                extended = settings._replace(cycles=max(ends), samples=finer)
                prepared = self._prepared(case, extended, stretch.noise_seed)
                listener = listener_of(prepared)
                if tuple(one.sensor.name for one in listener.sensors) != settings.names:
                    rule = "the sensors are not those of the first case"
                    raise InputError("sensor", None, rule, "give all cases the same")
                solver = prepared.case.solver
                ready[i] = Heard(prepared.model, listener, solver, stretch.first, stretch.blocks, finer)
            except (InputError, SimulationError) as error:
                _fail(rows, i, str(error))
        alike: dict[Any, list[int]] = {}  # by structure
        for i in ready:
            alike.setdefault(states_of(chunk.cases[i]), []).append(i)
        listened = (
            zip(some, listen([ready[i] for i in some], workers), strict=True) for some in alike.values()
        )
        for i, sensed in chain.from_iterable(listened):
            if isinstance(sensed, str):
                _fail(rows, i, sensed)
                continue
            rows["noise_seed"][i] = stretches[i].noise_seed
            operation = ready[i].model.operation
            shaft = float(operation.nominal_speed) / (2.0 * pi)
            for line in sensed.lines:
                if line.name in settings.lines:  # of a structure that was looked at before
                    rows["line_frequency"][i, settings.lines.index(line.name)] = line.order * shaft
            _fill(rows, i, sensed, stretches[i].start, settings, chunk.cases[i])
        return rows

    def heard(
        self, cases: Sequence[Any], earliest: float, last: float, workers: int | None = None
    ) -> list[Sensed | str]:
        """Signals of cases from one time of their runs to another, s; a text where one fails: why.

        The motion is sampled as a case's `output` says or finer, for its sensors at its speed.
        """
        signals: list[Sensed | str] = [""] * len(cases)
        stretches = [between(case, earliest, last) for case in cases]
        cycles = max(stretch.cycles for stretch in stretches)
        for part in range(0, len(cases), TOGETHER):
            ready: dict[int, Heard] = {}
            for i in range(part, min(part + TOGETHER, len(cases))):
                try:
                    ready[i] = self._ready(cases[i], stretches[i], cycles)
                except (InputError, SimulationError) as error:
                    signals[i] = str(error)
            for i, sensed in zip(ready, listen(list(ready.values()), workers), strict=True):
                signals[i] = sensed
        return signals

    def taken(self, case: Any, earliest: float, last: float, total: int) -> Estimate:
        """What so many cases take of which `heard` gives the signals; InputError for one that is too slow."""
        stretch = between(case, earliest, last)
        samples = few_enough(stretch)
        one = cost.total(
            cost_keys(case),
            *marching_of(case, float(stretch.cycles)),
            cost.in_memory(min(total, TOGETHER) * stretch.block * samples, 8.0 * MOST_STATES),
            cost.in_memory(stretch.block * samples, cost.SAMPLE_BYTES),
            cost.Estimate(seconds=_FILTERED * last * sum(sensor.rate for sensor in case.sensors)),
        )
        return one._replace(seconds=total * one.seconds)

    def _ready(self, case: Any, stretch: HeardStretch, cycles: int) -> Heard:
        """Prepare a case to be listened to, its schedule so many cycles long."""
        samples = few_enough(stretch)
        plain = SignalSettings(0.0, 0.0, 0, samples, *_NOBODY, cycles)
        prepared = self._prepared(case, plain)
        return Heard(
            prepared.model,
            listener_of(prepared),
            prepared.case.solver,
            stretch.first,
            stretch.blocks,
            samples,
            stretch.block,
        )

    def _finer(self, case: Any, settings: SignalSettings) -> int:
        """Samples of a cycle of a case: those of the settings, doubled while it is too slow for so few."""
        needed, samples = samples_per_cycle(settings.rates, [run_speed_of(case)]), settings.samples
        while samples < needed:
            samples *= 2
        return samples

    def _prepared(self, case: Any, settings: SignalSettings, noise_seed: int | None = None) -> Any:
        """The case, sampled and as long as the settings say, its sensors with noise of a seed."""
        sensors = case.sensors
        if noise_seed is not None:
            sensors = tuple(dataclasses.replace(sensor, seed=noise_seed) for sensor in sensors)
        output = dataclasses.replace(case.output, samples_per_cycle=settings.samples)
        solver = dataclasses.replace(case.solver, cycles=settings.cycles)
        sampled_case = dataclasses.replace(case, sensors=sensors, output=output, solver=solver)
        return prepare_settled(sampled_case)


#: Sensors and lines of settings that need none.
_NOBODY = (), (), (), (), ()


def samples_of(settings: SignalSettings, rate: float) -> int:
    """Samples of a signal of so many in a second."""
    return max(1, round(settings.duration * rate))


def _angle_name(settings: SignalSettings, rate: float) -> str:
    return ANGLE if len(set(settings.rates)) == 1 else f"{ANGLE}_{rate:.12g}_Hz"


def _fill(
    rows: dict[str, Any], i: int, sensed: Sensed, start: float, settings: SignalSettings, case: CaseHead
) -> None:
    """Put the signals of a case into its row."""
    for signal in sensed.signals:
        count = samples_of(settings, signal.rate)
        time = signal.time
        first = int(np.searchsorted(time, start - 1e-6 / signal.rate))
        if len(time) < first + count or (first == 0 and time[0] > start + 1.0 / signal.rate):
            end = f"{time[-1]:.4g} s" if len(time) else "none"
            _fail(
                rows,
                i,
                f"the signal of {signal.name} ends too early ({end}): the drive runs ahead of its speed",
            )
            return
        part = slice(first, first + count)
        rows[signal.name][i] = signal.values[part]
        rows[_angle_name(settings, signal.rate)][i] = signal.angle[part] - signal.angle[first]
    rows["start_time"][i] = start
    rows["message"][i] = remarked(*map(warned, case.remarks_in_brief()))
    rows["status"][i] = DONE


def _fail(rows: dict[str, Any], i: int, reason: str) -> None:
    rows["status"][i] = FAILED
    rows["message"][i] = reason
