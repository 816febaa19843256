"""Numbers that say what a signal is like: RMS, crest factor, kurtosis, and the indicators of gears.

Those of gears are of the time-synchronous average, its residual and its difference signal, see `synchronous`.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from tribodyn.numerics.shapes import Array, Float
from tribodyn.signals.synchronous import difference, mesh_harmonics, residual

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
