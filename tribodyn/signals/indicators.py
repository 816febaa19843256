"""Numbers that say what a signal is like: RMS, crest factor, kurtosis, and the indicators of gears.

Those of gears are of the time-synchronous average of a shaft, and of what is left of it without what regular
teeth make: its residual and its difference signal. P. D. McFadden, Mechanical Systems and Signal Processing 1
(1987) 83: the average over turns keeps what repeats with the shaft; the rest falls like one over the root of
their number.
"""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from tribodyn.errors import InputError
from tribodyn.numerics.shapes import Array, Float
from tribodyn.signals.resampling import PASSED, by_angle
from tribodyn.signals.spectra import samples_per_turn

#: Orders of the shaft itself that belong to the regular part: unbalance, and a coupling out of line.
SHAFT_ORDERS = 2


class SynchronousAverage(NamedTuple):
    """A turn of a shaft, averaged."""

    turn: Float[Array, " sample"]  # place in the turn, 0 ≤ … < 1
    values: Float[Array, " sample"]  # mean over the turns
    turns: int  # over how many
    each: Float[Array, "turn sample"]  # the turns that it is the mean of


def synchronous_average(
    values: Float[Array, " sample"],
    turns: Float[Array, " sample"],
    per_turn: int | None = None,
    passed: float = PASSED,
) -> SynchronousAverage:
    """Average a signal at even times over the whole turns of a shaft.

    Parameters
    ----------
    turns : revolutions of the shaft at the samples
    per_turn : samples of the average; default: as many as the signal has where the shaft turns slowest
    passed : orders above this share of `per_turn` are left out: there a sampled signal may hold aliases

    Raises InputError below one whole turn.
    """
    turns = np.asarray(turns, dtype=float)
    per_turn = samples_per_turn(turns) if per_turn is None else per_turn
    first = float(np.ceil(turns[0] - 1e-9))
    whole = int(np.floor(turns[-1] + 1.0 / per_turn - first + 1e-9))
    if whole < 1:
        rule = f"the signal has {turns[-1] - turns[0]:.3g} turns of the shaft, and no whole one"
        raise InputError("turns", None, rule, "run longer: solver.cycles, or solver.revolutions")
    _, even = by_angle(values, turns, per_turn, first, whole * per_turn)
    lines = np.fft.rfft(even.reshape(whole, per_turn), axis=1)
    lines[:, int(passed * per_turn) + 1 :] = 0.0
    each = np.fft.irfft(lines, per_turn, axis=1)
    return SynchronousAverage(np.arange(per_turn) / per_turn, np.mean(each, axis=0), whole, each)


def _regular_lines(count: int, teeth: Sequence[int], sidebands: int, shaft: int) -> np.ndarray:
    lines = np.zeros(count // 2 + 1, dtype=bool)
    lines[: shaft + 1] = True
    for number in teeth:
        for mesh in range(number, len(lines) + sidebands, number):
            lines[max(0, mesh - sidebands) : mesh + sidebands + 1] = True
    return lines


def _without(
    average: Float[Array, "... sample"], teeth: Sequence[int], sidebands: int, shaft: int
) -> Float[Array, "... sample"]:
    values = np.asarray(average, dtype=float)
    lines = np.fft.rfft(values, axis=-1)
    lines[..., _regular_lines(values.shape[-1], teeth, sidebands, shaft)] = 0.0
    return np.fft.irfft(lines, values.shape[-1], axis=-1)


def residual(
    average: Float[Array, "... sample"], teeth: Sequence[int], shaft_orders: int = SHAFT_ORDERS
) -> Float[Array, "... sample"]:
    """Average without its mean, the shaft's first orders and all harmonics of the mesh.

    `teeth` are the numbers of teeth of the gears on the shaft: orders of their meshes. First sidebands stay
    (Zakrajsek, Townsend & Decker, NASA TM 105950, 1993).
    """
    return _without(average, teeth, 0, shaft_orders)


def difference(
    average: Float[Array, "... sample"],
    teeth: Sequence[int],
    sidebands: int = 1,
    shaft_orders: int = SHAFT_ORDERS,
) -> Float[Array, "... sample"]:
    """The residual without so many sidebands of every harmonic of the mesh on either side (Stewart 1977)."""
    return _without(average, teeth, sidebands, shaft_orders)


def mesh_harmonics(
    average: Float[Array, " sample"], teeth: int, sidebands: int = 0
) -> Iterator[tuple[float, list[float]]]:
    """Amplitudes of every harmonic of a mesh, and of its sidebands −n … −1, 1 … n, up to half the samples."""
    amplitudes = 2.0 * np.abs(np.fft.rfft(average)) / len(average)
    for mesh in range(teeth, len(amplitudes) - sidebands, teeth):
        sideband = [float(amplitudes[mesh + n]) for n in range(-sidebands, sidebands + 1) if n]
        yield float(amplitudes[mesh]), sideband


#: What resampling leaves of an average, as a share of it: less is no signal.
FLOOR = 1e-4


def _about_mean(values: Any) -> np.ndarray:
    values = np.asarray(values, dtype=float)
    return values - np.mean(values, axis=-1, keepdims=True)


def _over(above: Any, below: Any) -> float:
    return float(above / below) if below > 0.0 else float("nan")


def rms(values: Float[Array, " sample"]) -> float:
    """Root mean square about the mean, as ISO 13373-2 takes it of vibration."""
    return float(np.sqrt(np.mean(_about_mean(values) ** 2)))


def peak(values: Float[Array, " sample"]) -> float:
    """Largest magnitude about the mean."""
    return float(np.max(np.abs(_about_mean(values))))


def peak_to_peak(values: Float[Array, " sample"]) -> float:
    """Maximum less minimum."""
    return float(np.ptp(values))


def crest_factor(values: Float[Array, " sample"]) -> float:
    """`peak` over `rms`: √2 of a sine (ISO 13373-2)."""
    return _over(peak(values), rms(values))


def kurtosis(values: Float[Array, " sample"]) -> float:
    """Fourth moment about the mean over the square of the second: 1.5 of a sine, 3 of Gaussian noise."""
    return _moment(values, 4)


def _moment(values: Any, power: int) -> float:
    about = _about_mean(values)
    return _over(np.mean(about**power), np.mean(about**2) ** (power // 2))


def fm0(average: Float[Array, " sample"], teeth: Sequence[int]) -> float:
    """Peak to peak of the average over the sum of the amplitudes of its mesh harmonics.

    Rises with faults that the whole mesh shows, or a peak (R. M. Stewart, Some useful analysis techniques
    for gearbox diagnostics, ISVR Southampton, 1977).
    """
    return _over(peak_to_peak(average), sum(a for z in teeth for a, _ in mesh_harmonics(average, z)))


def fm4(difference_signal: Float[Array, " sample"]) -> float:
    """Kurtosis of the difference signal: rises where one or two teeth differ (Stewart 1977)."""
    return _moment(difference_signal, 4)


def m6a(difference_signal: Float[Array, " sample"]) -> float:
    """Sixth moment of the difference signal over the cube of the second: 15 of Gaussian noise.

    More than `fm4` of single peaks (H. R. Martin, Statistical moment analysis as a means of surface damage
    detection, 7th International Modal Analysis Conference, 1989).
    """
    return _moment(difference_signal, 6)


def na4(residuals: Float[Array, "record sample"]) -> float:
    """Fourth moment of the last residual over the square of the mean second one of all of them.

    Unlike `fm4` it goes on rising as damage spreads (Zakrajsek, Townsend & Decker, NASA TM 105950, 1993).
    `residuals` are those of records in the order of time, the last of them the one that is judged.
    """
    about = _about_mean(np.atleast_2d(residuals))
    return _over(np.mean(about[-1] ** 4), np.mean(about**2) ** 2)


def energy_ratio(average: Float[Array, " sample"], teeth: Sequence[int]) -> float:
    """RMS of the difference signal over that of the regular part, which it is not (Swansson 1980)."""
    rest = difference(average, teeth)
    return _over(rms(rest), rms(np.asarray(average, dtype=float) - rest))


def sideband_level_factor(average: Float[Array, " sample"], teeth: int) -> float:
    """Amplitudes of the first sidebands of the mesh frequency, both, over the RMS of the average.

    One per shaft, by the average of its own turn: it rises where the gear runs out or its shaft is bent
    (Večeř, Kreidl & Šmíd, Acta Polytechnica 45 (2005) 35).
    """
    _, amplitudes = next(mesh_harmonics(average, teeth, 1), (0.0, [0.0]))
    return _over(sum(amplitudes), rms(average))


def sideband_energy_ratio(average: Float[Array, " sample"], teeth: int, sidebands: int = 6) -> float:
    """Amplitudes of the sidebands of the mesh frequency, so many on either side, over that of the mesh.

    Near 0 of a gear without run-out; above 1 teeth differ (Hanna, Hatch, Kalb & others, Detection of wind
    turbine gear tooth defects using sideband energy ratio, China Wind Power 2011).
    """
    mesh, amplitudes = next(mesh_harmonics(average, teeth, min(sidebands, teeth - 1)), (0.0, [0.0]))
    return _over(sum(amplitudes), mesh)


def of_signal(values: Float[Array, " sample"]) -> dict[str, float]:
    """Numbers of any signal, by name."""
    return {
        "rms": rms(values),
        "peak_to_peak": peak_to_peak(values),
        "crest_factor": crest_factor(values),
        "kurtosis": kurtosis(values),
    }


def of_average(average: Float[Array, " sample"], teeth: Sequence[int]) -> dict[str, float]:
    """Indicators of a shaft with gears of so many teeth, by name.

    Where less than `FLOOR` of the average is left, its moments say nothing: NaN.
    """
    remainder, rest = residual(average, teeth), difference(average, teeth)
    undefined, least = float("nan"), FLOOR * rms(average)
    return {
        "fm0": fm0(average, teeth),
        "fm4": fm4(rest) if rms(rest) > least else undefined,
        "m6a": m6a(rest) if rms(rest) > least else undefined,
        "na4": na4(remainder) if rms(remainder) > least else undefined,
        "energy_ratio": energy_ratio(average, teeth),
        "sideband_level_factor": max(sideband_level_factor(average, z) for z in teeth),
        "sideband_energy_ratio": max(sideband_energy_ratio(average, z) for z in teeth),
    }
