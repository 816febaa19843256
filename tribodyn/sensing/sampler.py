"""From motion to signal: what sensors see, housing, passing planets, noise, the converter; its samples.

Velocities and forces are in the axes of the housing, also of bodies whose coordinates turn with a carrier.

A motion arrives in blocks; kept is what the filter still needs.
"""

from collections.abc import Sequence
from zlib import crc32

import numpy as np

from tribodyn.dynamics.loads import joins_in_space, load_on
from tribodyn.dynamics.recorded.outputs import Evaluated, bearing_force
from tribodyn.numerics.shapes import Array, Float
from tribodyn.sensing.data import HousingData, SensorData
from tribodyn.signals.resampling import REACH, at_places
from tribodyn.train.structure import (
    AXIAL,
    TURN,
    place_in_space,
    shift_of,
    slip_of,
    turned,
    turning,
)


def time_of(samples: Evaluated) -> Float[Array, " sample"]:
    """Time since the start, s."""
    operation = samples.model.operation
    nominal = samples.cycles * operation.pitch_angle / operation.nominal_speed
    return nominal + samples.y[samples.model.layout.lag]


def _in_housing(x: np.ndarray, y: np.ndarray, body: int, samples: Evaluated) -> tuple[np.ndarray, np.ndarray]:
    """Turn a vector from the frame of a body's coordinates into the housing's."""
    carried = np.asarray(samples.model.bodies.carried)
    if body >= len(carried) or carried[body] == 0.0:
        return x, y
    angle = carried[body] * samples.cycles * samples.model.operation.pitch_angle
    cosine, sine = np.cos(angle), np.sin(angle)
    return cosine * x - sine * y, sine * x + cosine * y


def velocity(body: int, direction: int, samples: Evaluated) -> Float[Array, " sample"]:
    """Velocity of a body in x, y or z (0, 1, 2), m/s, beside that of the point that carries it along.

    What a sensor on it has is the slope of this over time: unlike accelerations, velocities do not jump where
    the set of pairs in contact changes.
    """
    model, y, layout = samples.model, samples.y, samples.model.layout
    half = layout.half
    if direction == AXIAL:
        return y[half + place_in_space(body, AXIAL, layout)]
    place = shift_of(body)
    along, across = y[half + place], y[half + place + 1]
    carried = np.asarray(model.bodies.carried)
    if body < len(carried) and carried[body] != 0.0:
        turn = carried[body] * (model.operation.nominal_speed + slip_of(y, layout))
        along, across = along - turn * y[place + 1], across + turn * y[place]
    return _in_housing(along, across, body, samples)[direction]


def force_on_bearing(link: int, direction: int, samples: Evaluated) -> Float[Array, " sample"]:
    """Force of the first body of a link on what holds it, in x, y or z (0, 1, 2), N; 0 where it has none."""
    model, y, layout = samples.model, samples.y, samples.model.layout
    body = layout.first[link]
    if direction == AXIAL:
        return (
            bearing_force(link, AXIAL, y, model) if joins_in_space(link, layout) else np.zeros(samples.size)
        )
    forces = [np.broadcast_to(bearing_force(link, row, y, model), samples.size) for row in (0, 1)]
    return _in_housing(forces[0], forces[1], body, samples)[direction]


def torque_of_link(link: int, samples: Evaluated) -> Float[Array, " sample"]:
    """Torque of a shaft that gives way, N m, positive where its first end is ahead."""
    model, y, layout = samples.model, samples.y, samples.model.layout
    first, second = layout.first[link], layout.second[link]
    twist = turned(first, y, layout) - turned(second, y, layout)
    rate = turning(first, y, layout) - turning(second, y, layout)
    laws, links = model.options.links, model.links
    elastic, _, share = laws.act(link, twist, links.stiffness[link, TURN], links.own, laws)
    return elastic + links.damping[link, TURN] * share * rate


def output_torque(samples: Evaluated) -> Float[Array, " sample"]:
    """Torque of the load on the output, against its motion, N m."""
    return load_on(samples.model.layout.output, time_of(samples), samples.y, samples.model)


def housing_acceleration(
    housing: HousingData,
    point: str,
    forces: Sequence[tuple[str, int]],
    values: Float[Array, "sample force"],
    rate: float,
) -> Float[Array, " sample"]:
    """Acceleration of a point, m/s², of a housing that the first sample's forces hold in equilibrium.

    By Fourier transform: exact for forces that have nothing above half the rate. Behind their end the forces
    fade out while the modes forget, so that nothing comes around.

    Parameters
    ----------
    forces : of `HousingData.inputs`
    values, rate : their samples, N, at even times, and how many there are in a second
    """
    values = np.asarray(values, dtype=float)
    count = len(values)
    moved = values - values[:1]
    behind = max(count, int(np.ceil(housing.memory() * rate)))
    size = 2 ** int(np.ceil(np.log2(count + behind)))
    fade = 0.5 + 0.5 * np.cos(np.pi * (np.arange(size - count) + 1.0) / (size - count))
    whole = np.concatenate([moved, moved[-1:] * fade[:, None]])
    lines = np.fft.rfft(whole, axis=0)
    frequency = np.fft.rfftfreq(size, 1.0 / rate)
    total = np.zeros(len(frequency), dtype=complex)
    for column, force in enumerate(forces):
        total += lines[:, column] * housing.transfer(point, force, frequency)
    return np.fft.irfft(total, size)[:count]


def as_measured(values: Float[Array, " sample"], sensor: SensorData) -> Float[Array, " sample"]:
    """The signal with the sensor's noise, which is white and Gaussian, clipped and in steps."""
    level = sensor.noise
    if sensor.snr is not None and len(values):
        level = float(np.std(values)) * 10.0 ** (-sensor.snr / 20.0)
    if level > 0.0:
        # sensors of one seed have different noise, and a sensor the same whatever others there are
        random = np.random.default_rng([sensor.seed, crc32(sensor.name.encode())])
        values = values + level * random.standard_normal(len(values))
    if sensor.full_scale is not None:
        values = np.clip(values, -sensor.full_scale, sensor.full_scale)
        if sensor.bits is not None:
            step = sensor.full_scale / 2.0 ** (sensor.bits - 1)
            values = np.clip(
                np.round(values / step), -(2.0 ** (sensor.bits - 1)), 2.0 ** (sensor.bits - 1) - 1
            )
            values = values * step
    return values


def heard(away: Float[Array, "sample planet"], window: str, planets: int) -> Float[Array, "sample planet"]:
    """Weights 0 … 1 of planets by their angles from the sensor, rad.

    The window "hann" is as wide as the planets are apart, so that one after the other is heard (Inalpolat &
    Kahraman, J. Sound Vib. 323 (2009) 677); "hamming" goes over the whole turn, with 0.08 on the far side
    (Liang, Zuo & Hoseini, Eng. Fail. Anal. 48 (2015) 245, without their factor for the width).
    """
    near = (np.asarray(away, dtype=float) + np.pi) % (2.0 * np.pi) - np.pi
    if window == "hamming":
        return 0.54 + 0.46 * np.cos(near)
    half = np.pi / planets
    return np.where(np.abs(near) < half, 0.5 + 0.5 * np.cos(np.pi * near / half), 0.0)


class Sampler:
    """Takes blocks of a motion at smoothly uneven times and gives it at k/`rate`, see `signals.resampled`.

    Of channels with `slopes` it gives the slope over time.
    """

    def __init__(self, rate: float, slopes: Sequence[bool] = (), filtered: bool = True) -> None:
        self.rate, self._filtered = rate, filtered
        self._slopes = np.flatnonzero(np.asarray(slopes, dtype=bool))
        self._time, self._angle, self._values = np.empty(0), np.empty(0), np.empty((0, 0))
        self._next: int | None = None
        self._found: list[tuple[np.ndarray, np.ndarray, np.ndarray]] = []

    def add(
        self,
        time: Float[Array, " sample"],
        angle: Float[Array, " sample"],
        values: Float[Array, "sample channel"],
    ) -> None:
        """Take in a block: times (s), rotation of the reference (rad), channels."""
        if self._next is None:
            self._next = int(np.ceil(time[0] * self.rate - 1e-9))
            self._values = np.empty((0, values.shape[1]))
        self._time = np.concatenate([self._time, time])
        self._angle = np.concatenate([self._angle, angle])
        self._values = np.concatenate([self._values, values])
        if len(self._time) > 2:
            self._take()

    def _take(self) -> None:
        time, first = self._time, self._next or 0
        number = np.arange(first, int(np.floor(time[-1] * self.rate + 1e-9)) + 1)
        if not len(number):
            return
        at = number / self.rate
        places = np.interp(at, time, np.arange(len(time)))
        if self._filtered:
            cutoff = np.minimum(0.5 * self.rate * np.interp(at, time, np.gradient(time)), 0.5)
            half = REACH / cutoff
            inside = (places - half >= 0.0) & (places + half <= len(time) - 1)
        else:
            cutoff, half, inside = np.empty(0), np.zeros(len(at)), np.ones(len(at), dtype=bool)
        ready = np.flatnonzero(inside)
        if not len(ready):
            return
        part = slice(int(ready[0]), int(ready[-1]) + 1)
        if self._filtered:
            values = at_places(self._values, places[part], cutoff[part])
            steep = at_places(self._values[:, self._slopes], places[part], cutoff[part], slope=True)
            interval = np.interp(at[part], time, np.gradient(time))
            values[:, self._slopes] = steep / interval[:, None]
        else:
            raw = self._values.copy()
            raw[:, self._slopes] = np.gradient(raw[:, self._slopes], time, axis=0)
            values = np.stack([np.interp(at[part], time, column) for column in raw.T], axis=1)
        self._found.append((at[part], np.interp(at[part], time, self._angle), values))
        self._next = int(number[part][-1]) + 1
        last = part.stop - 1
        kept = max(0, int(places[last] - 1.5 * half[last]) - 4)
        self._time, self._angle, self._values = time[kept:], self._angle[kept:], self._values[kept:]

    def sampled(
        self,
    ) -> tuple[Float[Array, " sample"], Float[Array, " sample"], Float[Array, "sample channel"]]:
        """Times, rotations of the reference and channels so far."""
        if not self._found:
            return np.empty(0), np.empty(0), np.empty((0, self._values.shape[1]))
        times, angles, values = zip(*self._found, strict=True)
        return np.concatenate(times), np.concatenate(angles), np.concatenate(values)
