"""Figures of what sensors gave: signals, spectra with named lines, averages over a turn, envelopes."""

from tribodyn.post.figures.drawing import Drawing
from tribodyn.post.figures.sensors.averages import average_figure, envelope_figure, has_turns
from tribodyn.post.figures.sensors.shown_signals import has_signals
from tribodyn.post.figures.sensors.spectra import order_spectrum_figure, signal_figure, spectrogram_figure

#: Pictures of sensors by name, in the order of a page.
DRAWINGS: dict[str, Drawing] = {
    "signals": Drawing("what every sensor gave", signal_figure, has_signals),
    "order-spectrum": Drawing(
        "amplitudes of signals over the orders of a shaft, lines named", order_spectrum_figure, has_signals
    ),
    "spectrogram": Drawing(
        "spectra along the signals, with the orders of the meshes drawn in", spectrogram_figure, has_signals
    ),
    "synchronous-average": Drawing(
        "signals averaged over the turns of a shaft, and what regular teeth leave", average_figure, has_turns
    ),
    "envelope": Drawing(
        "kurtogram of signals, and the spectrum of the envelope of their most impulsive band",
        envelope_figure,
        has_signals,
    ),
}
