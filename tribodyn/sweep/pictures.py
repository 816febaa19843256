"""The figures that can be drawn from sweeps, by name."""

from collections.abc import Mapping, Sequence
from difflib import get_close_matches

from matplotlib.figure import Figure

from tribodyn.errors import InputError
from tribodyn.post.figures.sweep.campbell import campbell_figure
from tribodyn.post.figures.sweep.response import response_figure
from tribodyn.post.figures.sweep.section import bifurcation_figure, poincare_figure
from tribodyn.post.figures.sweep.waterfall import waterfall_figure
from tribodyn.post.style import house_style
from tribodyn.record.sweep_reader import SweepRecord

#: Name -> what it shows.
SWEEP_NAMES = {
    "response": "transmission error, dynamic factor, film and efficiency over the first varied key",
    "waterfall": "amplitude spectra of the transmission error over the first varied key",
    "campbell": "natural frequencies and orders of the mesh, with the amplitudes at the crossings",
    "bifurcation": "transmission error once a mesh cycle over the first varied key",
    "poincare": "Poincaré section of one case, chosen by --at",
}


def sweep_figure(
    name: str, records: Sequence[SweepRecord], at: Mapping[str, float | str] | None = None
) -> Figure:
    """Draw one figure of sweeps.

    Parameters
    ----------
    name : str
        One of `SWEEP_NAMES`, or "overview", which is the response.
    records : sequence of SweepRecord
        Several are compared where the figure has curves; waterfall and campbell show the first.
    at : mapping, optional
        Parameter's name to value in SI, for the section of one case.

    Raises
    ------
    InputError
        For an unknown name or a sweep that the figure cannot show.
    """
    if name not in ("overview", *SWEEP_NAMES):
        near = get_close_matches(name, SWEEP_NAMES, n=1)
        hint = f"did you mean {near[0]}? " if near else ""
        raise InputError(
            "plot", name, "no such figure of a sweep", f"{hint}There are: {', '.join(SWEEP_NAMES)}"
        )
    with house_style():
        if name == "waterfall":
            return waterfall_figure(records)
        if name == "campbell":
            return campbell_figure(records)
        if name == "bifurcation":
            return bifurcation_figure(records)
        if name == "poincare":
            return poincare_figure(records, at or {})
        return response_figure(records)
