"""Spectra of the transmission errors of a train, each with the orders of its mesh, and the modes."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure

from tribodyn.errors import InputError
from tribodyn.post.cycles import Spectrum
from tribodyn.post.figures.panel import View, record_label, record_title
from tribodyn.post.figures.spectrum import FLOOR, draw_modes, draw_orders, mode_frequencies
from tribodyn.post.style import PALETTE, PANEL_HEIGHT, WIDTH, literal, mark_panel, new_figure
from tribodyn.record.reader import Record


def has_spectra(record: Record) -> bool:
    """Whether means are over whole cycles of a mesh, which have lines at its orders."""
    return any("spectrum_amplitudes" in mesh for mesh in record.mesh_summaries.values())


def spectrum_figure(records: Sequence[Record], view: View) -> Figure:
    """Draw the spectrum of every mesh of every record; the view does not matter.

    They are of the cycles at the end of a run that means are of. Raises InputError where these are no whole
    cycles of any mesh.
    """
    for record in records:
        if not has_spectra(record):
            rule = f"{record.path} has no whole cycles of a mesh in its last {_averaged(record)}"
            remedy = f"run more: solver.cycles = {2 * int(record.summary.get('common_period', 1))}"
            raise InputError("plot", "spectrum", rule, remedy)
    panels = [
        (record, name, mesh)
        for record in records
        for name, mesh in record.mesh_summaries.items()
        if "spectrum_amplitudes" in mesh
    ]
    figure = new_figure(WIDTH, len(panels) * (PANEL_HEIGHT + 0.1) + 0.5)
    rows = figure.subplots(len(panels), 1, squeeze=False, sharex=True, sharey=True)[:, 0]
    highest = width = 0.0
    for number, (axes, (record, name, mesh)) in enumerate(zip(rows, panels, strict=True)):
        frequency = float(mesh["mesh_frequency"])
        orders = np.asarray(mesh["spectrum_frequencies"]) / frequency
        # whole orders are whole but for rounding
        orders = np.where(np.abs(orders - np.round(orders)) < 1e-6, np.round(orders), orders)
        spectrum = Spectrum(orders, np.asarray(mesh["spectrum_amplitudes"]))
        color = PALETTE[number % len(PALETTE)]
        top, right = draw_orders(axes, spectrum, frequency, mode_frequencies(record), color)
        highest, width = max(highest, top), max(width, right)
        named = "" if len(records) == 1 else f"{record_label(record)}, "
        title = f"{named}{literal(name)}: transmission error, mesh frequency $f_m$ = {frequency:.4g} Hz"
        mark_panel(axes, "abcdefgh"[number] if 1 < len(panels) <= 8 else "", title, 2)
        axes.set_ylabel("Amplitude (µm)")
    for axes, (record, _, _) in zip(rows, panels, strict=True):
        draw_modes(axes, mode_frequencies(record), width)
    rows[-1].set_yscale("log")
    if highest > 0:
        rows[-1].set_ylim(FLOOR * highest, 2 * highest)
    rows[-1].set_xlim(0, width)
    rows[-1].set_xlabel("Frequency (kHz); dashed: natural frequencies at the mean mesh stiffness")
    if len(records) == 1:
        figure.suptitle(record_title(records[0]), x=0.01, ha="left", fontsize=9)
    return figure


def _averaged(record: Record) -> str:
    cycles = int(record.summary.get("averaging_cycles", 0))
    return f"{cycles} cycle{'s' if cycles != 1 else ''}"
