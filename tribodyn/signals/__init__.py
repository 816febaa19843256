"""Figures of vibration signals: functions of arrays, for records and measurements alike; ``td.signals``.

`docs/signals.md` has every definition with its source.
"""

from tribodyn.signals.envelopes import (
    Kurtogram,
    analytic,
    band_passed,
    envelope,
    envelope_spectrum,
    kurtogram,
)
from tribodyn.signals.indicators import (
    crest_factor,
    energy_ratio,
    fm0,
    fm4,
    kurtosis,
    m6a,
    na4,
    of_average,
    of_signal,
    peak,
    peak_to_peak,
    rms,
    sideband_energy_ratio,
    sideband_level_factor,
)
from tribodyn.signals.lines import (
    NamedOrder,
    SetFrequencies,
    SignalLine,
    lines_of_pair,
    named_orders,
    names_at,
    set_frequencies,
)
from tribodyn.signals.resampling import at_places, by_angle, resampled
from tribodyn.signals.sound import Hearable, hearable, read_wav, wav
from tribodyn.signals.spectra import (
    AmplitudeSpectrum,
    Spectrogram,
    order_spectrum,
    spectrogram,
    spectrum,
)
from tribodyn.signals.synchronous import (
    SynchronousAverage,
    difference,
    mesh_harmonics,
    residual,
    synchronous_average,
)

__all__ = [
    "AmplitudeSpectrum",
    "Hearable",
    "Kurtogram",
    "NamedOrder",
    "SetFrequencies",
    "SignalLine",
    "Spectrogram",
    "SynchronousAverage",
    "analytic",
    "at_places",
    "band_passed",
    "by_angle",
    "crest_factor",
    "difference",
    "energy_ratio",
    "envelope",
    "envelope_spectrum",
    "fm0",
    "fm4",
    "hearable",
    "kurtogram",
    "kurtosis",
    "lines_of_pair",
    "m6a",
    "mesh_harmonics",
    "na4",
    "named_orders",
    "names_at",
    "of_average",
    "of_signal",
    "order_spectrum",
    "peak",
    "peak_to_peak",
    "read_wav",
    "resampled",
    "residual",
    "rms",
    "set_frequencies",
    "sideband_energy_ratio",
    "sideband_level_factor",
    "spectrogram",
    "spectrum",
    "synchronous_average",
    "wav",
]
