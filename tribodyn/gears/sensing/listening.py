"""Sensors while a run goes on: they take its blocks as they come, and give their signals at its end."""

from collections.abc import Sequence

import numpy as np

from tribodyn.dynamics.recorded.outputs import Evaluated
from tribodyn.gears.motion.samples import Sampled
from tribodyn.gears.sensing.sensor_places import DRIVE, OUTPUT, Placed, Sensible
from tribodyn.numerics.shapes import Array, Float
from tribodyn.record.sensors import Sensed, SensorSignal
from tribodyn.sensing.data import DIRECTIONS, KINDS, HousingData
from tribodyn.sensing.sampler import Sampler, as_measured, heard, housing_acceleration
from tribodyn.sensing.sensed_motion import force_on_bearing, output_torque, torque_of_link, velocity
from tribodyn.signals.lines import SignalLine
from tribodyn.train.structure import turned

#: What is sampled: the kind of sensor that has it, its place, its direction, angle at a ring and window.
_Channel = tuple[str, str, int, float, str]


class Listener:
    """Sensors of a case at their places; samplers, one per rate and filter."""

    def __init__(self, sensors: Sequence[Placed], housing: HousingData, sensible: Sensible) -> None:
        self._sensors, self._housing, self._sensible = sensors, housing, sensible
        self._channels: dict[tuple[float, str], list[_Channel]] = {}
        for one in sensors:
            wanted = self._channels.setdefault((one.sensor.rate, one.sensor.filter), [])
            wanted += [channel for channel in self._needed(one) if channel not in wanted]
        self._samplers = {
            key: Sampler(key[0], [kind == "acceleration" for kind, *_ in channels], filtered=key[1] != "none")
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
        if sensor.kind != "housing":
            clean = values[:, columns[0]]
        elif columns and len(values):
            inputs = self._housing.inputs(one.at)
            clean = housing_acceleration(self._housing, one.at, inputs, values[:, columns], sensor.rate)
        else:
            clean = np.zeros(len(values))
        settings = {"at": one.at, "filter": sensor.filter, "seed": sensor.seed}
        if kind.directed:
            settings["direction"] = sensor.direction
        if sensor.kind == "ring":
            settings |= {"angle": sensor.angle, "window": sensor.window}
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
