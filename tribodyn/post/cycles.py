"""Mesh cycles in a record: phase, whole cycles at the end of the run, key points, curves and spectra.

Samples are uniform in the phase of the mesh, so a spectrum is one of orders: its line at order n has n
periods per mesh cycle whatever the speed does. At constant speed, frequency is order times mesh frequency.
Whole cycles are taken, so harmonics of the mesh fall exactly on lines and no window is needed.
"""

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from tribodyn.record.reader import Record

#: Change of speed or load over a run, as a share of the maximum, by which it is a transient.
CHANGING = 0.05
#: Mesh cycles that are shown at first, and at most where one mesh of a train is slower than the first.
SHOWN, MOST_SHOWN = 2, 24
#: Phases closer than this are one, mesh cycles.
_SAME_PHASE = 1e-9


class Window(NamedTuple):
    """Whole mesh cycles of a record."""

    part: slice  # the samples, both ends of the cycles included
    phase: np.ndarray  # (samples,); phase in mesh cycles, 0 at the first of these cycles
    time: np.ndarray  # (samples,); time, s, as recorded
    samples_per_cycle: int  # samples in one cycle

    @property
    def mesh_frequency(self) -> float:
        """Mean number of mesh cycles per second in the window, Hz."""
        return float((self.phase[-1] - self.phase[0]) / (self.time[-1] - self.time[0]))


class KeyPoint(NamedTuple):
    """A phase at which pairs enter, leave or pass the pitch point, named as Liu & Ni name the points."""

    phase: float  # 0 … 1, mesh cycles
    names: dict[int, str]  # number of the pair -> the point where it then is


def by_time(record: Record) -> bool:
    """Whether samples are even in time, for gears may stand; cycles are then those of nominal speed."""
    return record.scenario.get("solver", {}).get("duration") is not None


def refuse_by_time(record: Record) -> None:
    """Raise InputError for what is made of whole mesh cycles, which a run by time has none of."""
    if by_time(record):
        rule = "is of a run by time, whose samples are not even in the phase of the mesh"
        raise record.refused(rule, "run it over solver.cycles in place of solver.duration")


def abscissa_of(records: Sequence[Record], chosen: str | None, changing: bool) -> str:
    """What curves go over, phase or time: as chosen; time where a run changes, and of those by time alone."""
    over = chosen or ("time" if changing or any(map(by_time, records)) else "phase")
    for record in records if over == "phase" else ():
        refuse_by_time(record)
    return over


def samples_per_cycle(record: Record) -> int:
    """Find the samples in one mesh cycle, of a train its first mesh's; InputError below two samples."""
    if record.samples < 2:
        raise record.refused("holds no samples to draw", "run the scenario again")
    if by_time(record):
        return int(record.scenario["output"]["samples_per_cycle"])
    if "mesh_phase" in record:
        phase = record["mesh_phase"][:, 0]
        return max(1, round((phase.size - 1) / (phase[-1] - phase[0])))
    angle = record["pinion_angle"]
    step = (angle[-1] - angle[0]) / (angle.size - 1)
    return max(1, round(2 * np.pi / record.mesh_cycle["pinion_teeth"] / step))


def mesh_rates(record: Record) -> np.ndarray:
    """Cycles of every mesh per cycle of the first mesh."""
    if "mesh_phase" not in record:
        return np.ones(1)
    phase = record["mesh_phase"]
    turned = phase[-1] - phase[0]
    if by_time(record):  # which may end where it began
        turned = phase[np.argmax(np.abs(phase[:, 0] - phase[0, 0]))] - phase[0]
    return turned / turned[0] if turned[0] else np.ones(len(turned))


def shown_cycles(record: Record) -> int:
    """Whole mesh cycles to show at first: two, in a train of the slowest mesh."""
    if record.samples < 2:
        return SHOWN
    return min(MOST_SHOWN, int(np.ceil(SHOWN / np.min(mesh_rates(record)) - _SAME_PHASE)))


def mesh_phases(record: Record) -> np.ndarray:
    """Cycles (sample, mesh) of every mesh since it began one."""
    if "mesh_phase" in record:
        return record["mesh_phase"]
    if by_time(record):
        return (record["pinion_angle"] * record.mesh_cycle["pinion_teeth"] / (2 * np.pi))[:, None]
    return (np.arange(record.samples) / samples_per_cycle(record))[:, None]


def last_cycles(record: Record, cycles: int | None = 2) -> Window:
    """Take the last `cycles` whole mesh cycles, all of them for None; what there is where there are fewer."""
    per_cycle = samples_per_cycle(record)
    whole = (record.samples - 1) // per_cycle
    stop = whole * per_cycle + 1 if whole else record.samples
    count = whole if cycles is None else min(whole, cycles)
    start = stop - 1 - count * per_cycle if count else 0
    phase = np.arange(stop - start) / per_cycle
    return Window(slice(start, stop), phase, record["time"][start:stop], per_cycle)


def first_shown(record: Record, cycles: int) -> tuple[float, float]:
    """Time at which the last so many mesh cycles of a record begin, and what one of them lasts, s."""
    window = last_cycles(record, cycles)
    cycle = float(np.ptp(window.time) / window.phase[-1])
    return max(float(record["time"][0]), float(record["time"][-1]) - cycles * cycle), cycle


def in_parts(record: Record, window: Window) -> Window:
    """A window as parts of so many cycles that every mesh of a train goes through one; of a pair single ones.

    Their samples are its `samples_per_cycle`; what is left at the end is cut off.
    """
    together = int(np.ceil(1.0 / np.min(mesh_rates(record)) - _SAME_PHASE))
    size = min(together * window.samples_per_cycle, max(1, window.phase.size - 1))
    count = (window.phase.size - 1) // size * size + 1
    part = slice(window.part.start, window.part.start + count)
    return Window(part, window.phase[:count], window.time[:count], size)


def pair_curve(
    record: Record,
    values: np.ndarray,
    pair: int,
    window: Window,
    abscissa: np.ndarray,
    mesh: int = 0,
) -> tuple[np.ndarray, np.ndarray]:
    """Cut out the curve of one pair number, broken where the number passes to the next teeth.

    In the sample that ends a cycle, the teeth that were pair 1 are already pair 0: their last point is taken
    from there, so that each piece reaches its end. Out of contact (transmission error NaN) the curve breaks.
    `values` are a dataset over time and pair of this `mesh`; `abscissa` phase or time of the window.
    """
    numbers = record.pairs
    error = record.over_meshes("transmission_error_normal")[:, mesh]
    values = np.where(np.isnan(error), np.nan, values)[window.part]
    column = values[:, numbers.index(pair)]
    older = values[:, numbers.index(pair - 1)] if pair - 1 in numbers and pair <= 1 else None
    pieces_x, pieces_y = [], []
    phase = mesh_phases(record)[window.part, mesh]
    passed = np.diff(np.floor(phase + _SAME_PHASE), prepend=np.floor(phase[0] + _SAME_PHASE))
    for start, end in pairwise(dict.fromkeys([0, *np.flatnonzero(passed), column.size - 1])):
        after = older if passed[end] > 0.0 else column
        last = after[end] if after is not None else np.nan
        pieces_x += [abscissa[start : end + 1], [np.nan]]
        pieces_y += [column[start:end], [last, np.nan]]
    return np.concatenate(pieces_x), np.concatenate(pieces_y)


def key_points(record: Record) -> list[KeyPoint]:
    """Key points of one mesh cycle, by phase; C_p and C_g only where one and two pairs alternate.

    Of helical gears a pair enters with the first edge of its face and leaves with the last; it passes the
    pitch point in the middle.
    """
    table = record.mesh_cycle
    pitch = 2 * np.pi / table["pinion_teeth"]
    limits = (table["roll_start"], table["roll_end"]) if "face_position" in table else path_limits(record)
    begin, end = ((roll - table["roll_start"]) / pitch for roll in limits)
    # pitches of a pair from where pair 1 stands at the start of a mesh cycle
    places = {"B_g": begin, "B_p": end, "P": -table["roll_start"] / pitch}
    if not begin <= places["P"] <= end:  # of some internal pairs, which slide one way only
        del places["P"]
    if 1.0 < end - begin <= 2.0:
        places |= {"C_g": begin + 1.0, "C_p": end - 1.0}
    points: dict[float, dict[int, str]] = {}
    for name, place in places.items():
        passed = int(np.floor(place + _SAME_PHASE))
        phase = max(float(place) - passed, 0.0)
        nearest = next((other for other in points if abs(other - phase) < _SAME_PHASE), phase)
        points.setdefault(nearest, {})[1 - passed] = name
    return [KeyPoint(phase, names) for phase, names in sorted(points.items())]


def transient(record: Record) -> bool:
    """Whether the mean speed or the load of a mesh cycle changes by more than `CHANGING` during a run.

    One by time is for that.
    """
    if by_time(record):
        return record.samples > 1
    moving = "dof" in record or "speed" in record
    if not moving or "power_out" not in record or record.samples < 2:
        return False
    window = last_cycles(record, None)
    count = round(window.phase[-1])
    if count < 3:
        return False
    size = window.samples_per_cycle
    # all bodies have the speed of the first but for their ratios
    speed = record.over_bodies("speed")[window.part][:-1, 0].reshape(count, size)
    power = record["power_out"][window.part][:-1].reshape(count, size)
    with np.errstate(divide="ignore", invalid="ignore"):
        torque = np.mean(power / speed, axis=1)
    return any(
        float(np.ptp(values)) > CHANGING * float(np.max(np.abs(values)))
        for values in (np.mean(speed, axis=1), torque)
        if np.all(np.isfinite(values))
    )


def stretches(chosen: np.ndarray) -> np.ndarray:
    """First sample and the one behind the last (stretch, 2) of each stretch in which a mask is true."""
    return np.flatnonzero(np.diff(np.concatenate([[False], chosen, [False]]))).reshape(-1, 2)


def in_the_middle(values: np.ndarray) -> np.ndarray:
    """An array of a mesh cycle over phase and pair; of helical gears, in the middle of the face."""
    return values if values.ndim < 3 else values[:, :, values.shape[2] // 2]


def pair_history(record: Record, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Find roll angles (0 at the pitch point, increasing, rad) of a driving pair and a quantity over them.

    Of helical gears in the middle of the face.
    """
    table = record.mesh_cycle
    pitch = 2 * np.pi / table["pinion_teeth"]
    fronts = int(np.sum(table["side"] > 0))
    rolls, values = [], []
    for slot in range(fronts):
        values_of = in_the_middle(table[name])[:, slot]
        present = in_the_middle(table["share" if "share" in table else "in_contact"])[:, slot]
        touching = present > 0
        rolls.append(table["roll_start"] + (table["phase"][touching] + fronts - 1 - slot) * pitch)
        values.append(values_of[touching])
    roll = np.concatenate(rolls)
    order = np.argsort(roll, kind="stable")
    return roll[order], np.concatenate(values)[order]


def limits_of(table: Mapping[str, Any]) -> tuple[float, float] | None:
    """Roll angles at which the path of contact of a table begins and ends, rad.

    None of spur teeth by finite elements, whose table reaches beyond both.
    """
    limits = float(table["roll_start"]), float(table["roll_end"])
    reach = (limits[1] - limits[0]) * table["pinion_teeth"] / (2 * np.pi)
    if reach <= table["contact_ratio"] * (1 + 1e-9):
        return limits
    if "face_position" in table:  # the table begins and ends with the edges of the face
        overlap = (limits[1] - limits[0]) * (1.0 - table["contact_ratio"] / reach)
        return limits[0] + overlap / 2.0, limits[1] - overlap / 2.0
    return None


def path_limits(record: Record) -> tuple[float, float]:
    """Find the roll angles at which the path of contact begins and ends, rad.

    A table by finite elements reaches beyond both, where the tips' corners touch.
    """
    table = record.mesh_cycle
    if (limits := limits_of(table)) is not None:
        return limits
    roll, distance = pair_history(record, "signed_distance")
    first, last = (np.hypot(*record.geometry["path_of_contact"][end]) for end in (0, -1))
    return float(np.interp(-first, distance, roll)), float(np.interp(last, distance, roll))


def outside_of(shape: Mapping[str, Any]) -> tuple[float, float]:
    """Outer radii of pinion and gear where they are internal, m, else 0, of a record's geometry."""
    pinion, gear = (max(-float(shape.get(f"{side}_bore_radius", 0.0)), 0.0) for side in ("pinion", "gear"))
    return pinion, gear


def along_path(path: np.ndarray, pitch_radius: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Signed distance, pressure angle and the pinion's roll angle along a path of contact (points, 2).

    A path may pass through the pitch point.
    """
    x, y = path.T
    backward = x < 0.0
    distance = np.where(backward, -1.0, 1.0) * np.hypot(x, y)
    at_pitch_point = distance == 0.0
    angle = np.arctan2(np.where(backward, -y, y), np.abs(x))
    if at_pitch_point.any():
        order = np.argsort(distance[~at_pitch_point])
        ordered = distance[~at_pitch_point][order], angle[~at_pitch_point][order]
        angle[at_pitch_point] = np.interp(0.0, *ordered)
    order = np.argsort(distance)
    distance, angle = distance[order], angle[order]
    per_roll = 1.0 / (pitch_radius * np.cos(angle))
    travelled = np.concatenate([[0.0], np.cumsum(0.5 * (per_roll[1:] + per_roll[:-1]) * np.diff(distance))])
    return distance, angle, travelled - np.interp(0.0, distance, travelled)


class Spectrum(NamedTuple):
    """One-sided amplitude spectrum."""

    orders: np.ndarray  # (lines,); mesh orders: 1 is the mesh frequency
    #: (lines,); amplitude of the cosine at each order, in the unit of the signal; at order 0 the mean, with
    #: sign
    amplitudes: np.ndarray

    def harmonics(self, count: int) -> np.ndarray:
        """Amplitudes at the mesh orders 1 … count, 0 beyond the last line."""
        amplitudes = np.zeros(count)
        whole = (self.orders >= 0.5) & (np.abs(self.orders - np.round(self.orders)) < 1e-9)
        harmonics = self.amplitudes[whole][:count]
        amplitudes[: harmonics.size] = harmonics
        return amplitudes


def amplitude_spectrum(signal: np.ndarray, samples_per_cycle: int) -> Spectrum:
    """Spectrum of the last whole cycles of a signal sampled uniformly in phase, k / samples_per_cycle.

    Any stretch of whole cycles serves, so it does not matter whether the signal includes the sample that
    closes the last cycle and is the first of the next one. Raises ValueError if it does not hold a whole
    cycle, or holds NaN.
    """
    signal = np.asarray(signal, dtype=float)
    cycles = signal.size // samples_per_cycle
    if cycles < 1:
        raise ValueError(f"{signal.size} samples hold no whole cycle of {samples_per_cycle}")
    if not np.isfinite(signal).all():
        raise ValueError("the signal is not finite")
    count = cycles * samples_per_cycle
    lines = np.fft.rfft(signal[-count:]) / count
    amplitudes = 2 * np.abs(lines)
    amplitudes[0] = lines[0].real
    if count % 2 == 0:
        amplitudes[-1] /= 2  # the line at half the sampling rate has no mirror image
    return Spectrum(np.arange(lines.size) / cycles, amplitudes)
