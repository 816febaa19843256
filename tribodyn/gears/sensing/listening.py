"""Sensors while a run goes on, which take its blocks; signals of many cases marched side by side."""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.dynamics.recorded.outputs import (
    Evaluated,
    Sampled,
    evaluated,
    reaction,
    sampled,
)
from tribodyn.gears.sensing.sensor_places import DRIVE, OUTPUT, Placed, Sensible
from tribodyn.numerics.processes.work import in_threads, usable_cores
from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.sensors import Sensed, SensorSignal
from tribodyn.sensing.data import DIRECTIONS, KINDS, HousingData
from tribodyn.sensing.sampler import (
    Sampler,
    as_measured,
    force_on_bearing,
    heard,
    housing_acceleration,
    output_torque,
    time_of,
    torque_of_link,
    velocity,
)
from tribodyn.sensing.sound import radiated_pressure
from tribodyn.signals.lines import SignalLine
from tribodyn.solve.ensemble import march
from tribodyn.solve.initial import initial_state
from tribodyn.solve.integrator import REASONS, Status
from tribodyn.train.bearing_forces import bearing_answers
from tribodyn.train.schedule import interval_of
from tribodyn.train.structure import rotational_error, turned

#: What is sampled: the kind of sensor that has it, its place, its direction, angle at a ring and window.
_Channel = tuple[str, str, int, float, str]
#: Velocity of a point of a housing by matrices; and what is sampled as a velocity and given as its slope.
STRUCTURE = "structure"
#: Rate of a coordinate of a housing by matrices, by its number in place of a direction.
SOUND = "sound"
_SLOPES = ("acceleration", STRUCTURE)


class Listener:
    """Sensors of a case at their places; samplers, one per rate and filter."""

    def __init__(self, sensors: Sequence[Placed], housing: HousingData, sensible: Sensible) -> None:
        self._sensors, self._housing, self._sensible = sensors, housing, sensible
        self._channels: dict[tuple[float, str], list[_Channel]] = {}
        for one in sensors:
            wanted = self._channels.setdefault((one.sensor.rate, one.sensor.filter), [])
            wanted += [channel for channel in self._needed(one) if channel not in wanted]
        self._samplers = {
            key: Sampler(key[0], [kind in _SLOPES for kind, *_ in channels], filtered=key[1] != "none")
            for key, channels in self._channels.items()
        }

    @property
    def sensors(self) -> Sequence[Placed]:
        """The sensors at their places."""
        return self._sensors

    @property
    def lines(self) -> tuple[SignalLine, ...]:
        """Orders of meshes and shafts, per turn of body 0."""
        return self._sensible.lines

    @property
    def kinds(self) -> set[str]:
        """Kinds of what is sampled."""
        return {channel[0] for channels in self._channels.values() for channel in channels}

    def _needed(self, one: Placed) -> list[_Channel]:
        sensor = one.sensor
        if one.at in self._sensible.structure and sensor.kind == "housing":
            return [(STRUCTURE, one.at, DIRECTIONS[sensor.direction], 0.0, "")]
        if sensor.kind == SOUND and self._sensible.radiator is not None:
            return [(SOUND, one.at, number, 0.0, "") for number in range(len(self._sensible.radiator.moved))]
        if sensor.kind != "housing":
            return [(sensor.kind, one.at, DIRECTIONS[sensor.direction], sensor.angle, sensor.window)]
        return [
            (
                "ring" if name in self._sensible.rings else "force",
                name,
                direction,
                sensor.angle,
                sensor.window,
            )
            for name, direction in self._housing.inputs(one.at)
        ]

    def add(self, samples: Evaluated, block: Sampled) -> None:
        """Take in a block of the run and the states that it was made of, of which it has the first."""
        signals: dict[_Channel, np.ndarray] = {}
        for key, channels in self._channels.items():
            for channel in channels:
                if channel not in signals:
                    values = np.broadcast_to(self._values(channel, samples, block), samples.size)
                    signals[channel] = values[: len(block.cycles)]
            whole = np.stack([signals[channel] for channel in channels], axis=1)
            self._samplers[key].add(block.whole["time"], block.whole["reference_angle"], whole)

    def _values(self, channel: _Channel, samples: Evaluated, block: Sampled) -> Float[Array, " sample"]:
        kind, at, direction, angle, window = channel
        parts = self._sensible
        match kind:
            case "acceleration":
                return velocity(parts.bodies[at], direction, samples)
            case "structure":
                half = samples.model.layout.half
                return parts.structure[at][direction] @ samples.y[half : 2 * half]
            case "sound" if parts.radiator is not None:
                half = samples.model.layout.half
                return parts.radiator.moved[direction] @ samples.y[half : 2 * half]
            case "force" if at not in parts.bearings:
                return reaction(parts.reactions[at], direction, samples)
            case "force":
                return force_on_bearing(parts.bearings[at], direction, samples)
            case "encoder":
                return _encoder(parts.bodies[at], samples)
            case "transmission-error":
                return _padded(block.meshes[parts.meshes[at]]["transmission_error_rotational"], samples.size)
            case "ring":
                return _padded(self._ring(at, angle, window, block), samples.size)
            case _ if at == DRIVE:
                return samples.powers["drive_torque"]
            case _ if at == OUTPUT:
                return output_torque(samples)
            case _:
                return torque_of_link(parts.shafts[at], samples)

    def _ring(self, stage: str, angle: float, window: str, block: Sampled) -> Float[Array, " sample"]:
        """Forces of a ring's meshes, each weighted by its planet's angle from the sensor."""
        ring = self._sensible.rings[stage]
        turned = ring.sense * block.whole["angle"][:, ring.carrier]
        away = turned[:, None] + np.asarray(ring.angles) - angle
        forces = np.stack([np.sum(block.meshes[m]["tangent_load"], axis=1) for m in ring.meshes], axis=1)
        return np.sum(heard(away, window, len(ring.angles)) * forces, axis=1)

    def sensed(self) -> Sensed:
        """The signals so far."""
        if not self._sensors:
            return Sensed()
        signals = tuple(self._signal(one) for one in self._sensors)
        return Sensed(signals, self._sensible.lines, self._sensible.reference)

    def _signal(self, one: Placed) -> SensorSignal:
        sensor, kind = one.sensor, KINDS[one.sensor.kind]
        key = (sensor.rate, sensor.filter)
        time, angle, values = self._samplers[key].sampled()
        columns = [self._channels[key].index(channel) for channel in self._needed(one)]
        by_matrices = sensor.kind == "housing" and one.at in self._sensible.structure
        radiator = self._sensible.radiator
        if sensor.kind == SOUND and radiator is not None:
            whole = values[:, columns]
            clean = np.zeros(0)
            if len(whole):
                clean = radiated_pressure(whole, sensor.rate, radiator.radiation, radiator.efficiency)
        elif sensor.kind != "housing" or by_matrices:
            clean = values[:, columns[0]]
        elif columns and len(values):
            inputs = self._housing.inputs(one.at)
            clean = housing_acceleration(self._housing, one.at, inputs, values[:, columns], sensor.rate)
        else:
            clean = np.zeros(len(values))
        settings = {"at": one.at, "filter": sensor.filter, "seed": sensor.seed}
        if kind.directed or by_matrices:
            settings["direction"] = sensor.direction
        if sensor.kind == "ring":
            settings |= {"angle": sensor.angle, "window": sensor.window}
        if radiator is not None and sensor.kind == SOUND and not len(radiator.radiation.frequency):
            settings["radiation_efficiency"] = radiator.efficiency
        if sensor.noise:
            settings["noise"] = sensor.noise
        for name in ("snr", "bits", "full_scale"):
            if getattr(sensor, name) is not None:
                settings[name] = getattr(sensor, name)
        about = kind.about.format(at=one.at, direction=sensor.direction)
        return SensorSignal(
            sensor.name,
            sensor.kind,
            about,
            kind.units,
            sensor.rate,
            time,
            angle,
            as_measured(clean, sensor),
            settings,
        )


def _encoder(body: int, samples: Evaluated) -> Float[Array, " sample"]:
    """Rotation of a body less a uniform one, rad: its micro-rotation, and the reference's lag in time."""
    model, y, layout = samples.model, samples.y, samples.model.layout
    behind = model.operation.nominal_speed * y[layout.lag]
    return turned(body, y, layout) - model.bodies.ratio[body] * behind


def _padded(values: Float[Array, " sample"], size: int) -> Float[Array, " sample"]:
    return np.concatenate([values, np.full(size - len(values), np.nan)])


#: Cycles that cases are marched before they are listened to again. Fixed, so that the steps of a case, which
#: begin anew behind each, do not depend on the cases beside it; short, because all states between are held.
BLOCK = 48
#: Kinds of sensors that need nothing but the states: not the forces of the teeth, nor what drives.
_OF_STATES = ("acceleration", "force", "encoder", "transmission-error", STRUCTURE, SOUND)


class Heard(NamedTuple):
    """A case that is made ready to be listened to."""

    model: Model
    listener: Listener
    solver: Any  # a `methods.SolverData`
    first: int  # reference cycles before it is listened to
    blocks: int  # in which it is
    samples: int  # of a reference cycle
    block: int = BLOCK  # cycles of a block


def listen(cases: Sequence[Heard], workers: int | None = None) -> list[Sensed | str]:
    """March cases from their starts and listen to them; a text where one fails: why.

    What a case gives does not depend on those beside it.
    """
    results: list[Sensed | str] = [""] * len(cases)
    groups: dict[tuple[Any, ...], list[int]] = {}
    for i, case in enumerate(cases):
        solver = case.solver
        key = case.first, case.samples, case.block, solver.rtol, solver.method, solver.max_steps
        groups.setdefault(key, []).append(i)
    for (*_, rtol, method, max_steps), places in groups.items():
        how = {"rtol": rtol, "method": method, "max_steps": max_steps, "workers": workers}
        for place, result in zip(places, _listen([cases[i] for i in places], how), strict=True):
            results[place] = result
    return results


def _listen(cases: Sequence[Heard], how: dict[str, Any]) -> list[Sensed | str]:
    """March cases of one solver, `first` and block, block by block; those at their ends drop out."""
    first, samples, block = cases[0].first, cases[0].samples, cases[0].block
    states = np.array([initial_state(case.model, case.solver.initial) for case in cases])
    failed: dict[int, str] = {}
    going = list(range(len(cases)))
    done = 0
    while going:
        count, kept = (first, 0) if done < first else (block, block)
        part = march(
            [cases[i].model for i in going],
            states[going],
            cycles=count,
            window=kept,
            samples=samples if kept else 0,
            started=done > 0,
            first_cycle=done,
            **how,
        )
        states[going] = part.state
        for row, i in enumerate(going):
            if part.status[row] != Status.DONE:
                reason = REASONS[Status(int(part.status[row]))]
                failed[i] = f"stopped after {done + float(part.reached[row]):.4g} mesh cycles: {reason}"
        sound = [(row, i) for row, i in enumerate(going) if i not in failed]
        if kept:
            cycles = done + np.arange(kept * samples) / samples

            def hear(item: tuple[int, int], part: Any = part, cycles: Any = cycles) -> None:
                row, i = item
                add(cases[i].listener, cases[i].model, cycles, part.samples[row])

            in_threads(hear, sound, how["workers"] or usable_cores())
        done += count
        going = [i for _, i in sound if first + block * cases[i].blocks > done]
    return [failed[i] if i in failed else case.listener.sensed() for i, case in enumerate(cases)]


def add(
    listener: Listener, model: Model, cycles: Float[Array, " sample"], states: Float[Array, "sample state"]
) -> None:
    """Let a listener hear some states; of these no more is worked out than its sensors need."""
    if not all(kind in _OF_STATES for kind in listener.kinds):
        whole = evaluated(cycles, states, model)
        listener.add(whole, sampled(whole))
        return
    _, phase, interval = interval_of(cycles, model.schedule)
    y = np.ascontiguousarray(states.T)
    answers = bearing_answers(cycles, y, model) if "force" in listener.kinds else ()
    plain = Evaluated(cycles, phase, interval, y, [], {}, model, answers)
    angle = cycles * float(model.operation.pitch_angle)
    meshes = [
        {"transmission_error_rotational": rotational_error(states, m, model)}
        for m in range(len(model.meshes))
    ]
    listener.add(plain, Sampled(cycles, {"time": time_of(plain), "reference_angle": angle}, meshes))
