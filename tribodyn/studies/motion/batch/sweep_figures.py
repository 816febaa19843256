"""Pictures of sweeps of motions: responses, spectra, sections."""

from tribodyn.post.figures.drawing import SweepDrawing
from tribodyn.post.figures.sweep_response import ResponsePanel, response_figure
from tribodyn.post.figures.sweep_section import bifurcation_figure, poincare_figure
from tribodyn.post.figures.sweep_spectra import campbell_figure, waterfall_figure
from tribodyn.quantities.catalogue import QUANTITIES

PANELS = (
    ResponsePanel(QUANTITIES["transmission_error_rms"], from_zero=True),
    ResponsePanel(QUANTITIES["transmission_error_peak_to_peak"], from_zero=True),
    ResponsePanel(QUANTITIES["dynamic_factor"]),
    ResponsePanel(QUANTITIES["contact_loss_fraction"], from_zero=True),
    ResponsePanel(QUANTITIES["film_min"], from_zero=True),
    ResponsePanel(QUANTITIES["efficiency"]),
)

SWEEP_DRAWINGS: dict[str, SweepDrawing] = {
    "response": SweepDrawing(
        "transmission error, dynamic factor, film and efficiency over the first varied key",
        lambda records, _: response_figure(records, PANELS),
        curves=True,
    ),
    "waterfall": SweepDrawing(
        "amplitude spectra of the transmission error over the first varied key", waterfall_figure
    ),
    "campbell": SweepDrawing(
        "natural frequencies and orders of the mesh, with the amplitudes at the crossings", campbell_figure
    ),
    "bifurcation": SweepDrawing(
        "transmission error once per mesh cycle over the first varied key",
        lambda records, _: bifurcation_figure(records),
    ),
    "poincare": SweepDrawing("Poincaré section of one case, chosen by --at", poincare_figure),
}
