"""Figures of sweeps of a gear pair's dynamics."""

from tribodyn.post.figures.drawing import SweepDrawing
from tribodyn.post.figures.sweep.campbell import campbell_figure
from tribodyn.post.figures.sweep.response import Panel, response_figure
from tribodyn.post.figures.sweep.section import bifurcation_figure, poincare_figure
from tribodyn.post.figures.sweep.waterfall import waterfall_figure

PANELS = (
    Panel("transmission_error_rms", 1e6, "Transmission error,\nRMS (µm)", True),
    Panel("transmission_error_peak_to_peak", 1e6, "Transmission error,\npeak to peak (µm)", True),
    Panel("dynamic_factor", 1.0, "Dynamic factor (–)"),
    Panel("contact_loss_fraction", 100.0, "Time without\ncontact (%)", True),
    Panel("film_min", 1e6, "Minimum film\nthickness (µm)", True),
    Panel("efficiency", 100.0, "Efficiency (%)"),
)

SWEEP_DRAWINGS: dict[str, SweepDrawing] = {
    "response": SweepDrawing(
        "transmission error, dynamic factor, film and efficiency over the first varied key",
        lambda records, _: response_figure(records, PANELS),
    ),
    "waterfall": SweepDrawing(
        "amplitude spectra of the transmission error over the first varied key",
        waterfall_figure,
    ),
    "campbell": SweepDrawing(
        "natural frequencies and orders of the mesh, with the amplitudes at the crossings",
        campbell_figure,
    ),
    "bifurcation": SweepDrawing(
        "transmission error once per mesh cycle over the first varied key",
        lambda records, _: bifurcation_figure(records),
    ),
    "poincare": SweepDrawing("Poincaré section of one case, chosen by --at", poincare_figure),
}
