"""How many slices a helical pair needs: as many as its transmission error in slow rotation takes for 1 %."""

from functools import cache
from typing import NamedTuple

import numpy as np

from tribodyn.geometry.assembly import Assembly
from tribodyn.geometry.drive import MaterialData
from tribodyn.mesh.coupled_slices import tabulate_helical
from tribodyn.mesh.helical import minimum_slices, slice_layout
from tribodyn.mesh.quasi_static import quasi_static
from tribodyn.mesh.table import MeshData
from tribodyn.numerics.shapes import Array, Float

#: Share of its peak to peak by which the transmission error may differ from that with twice the slices.
TOLERANCE = 0.01
#: Where the error is below this share of the deflection, `TOLERANCE` is of this share of the deflection.
SMALL_ERROR = 0.1
#: Minimum and maximum number, unless the overlap asks for more; odd, so that one slice is in the middle.
FEWEST, MOST = 5, 21
_GROWTH = 1.45  # 5, 7, 11, 15, 21
_NODES = 129


class SliceNumber(NamedTuple):
    """Number of slices of a helical pair, and why."""

    slices: int
    remark: str


def slices_needed(
    assembly: Assembly,
    materials: tuple[MaterialData, MaterialData],
    mesh: MeshData,
    gear_torque: float,
) -> SliceNumber:
    """Choose the number of slices of a helical pair of plain numbers at a torque T_g ≠ 0, N m.

    From `FEWEST` on the number grows until the transmission error, its mean apart, changes nowhere by more
    than `TOLERANCE` of its peak to peak when the slices are doubled (K, 2K + 1), or until `MOST`. Without a
    torque `FEWEST` is doubled once.
    """
    first = max(FEWEST, minimum_slices(assembly)) | 1
    if gear_torque == 0.0:
        return SliceNumber(
            2 * first + 1, f"{2 * first + 1} slices along the face, without a torque to judge by."
        )

    @cache
    def error(slices: int) -> tuple[Float[Array, " phase"], float]:
        layout = slice_layout(assembly, mesh, slices)._replace(nodes=_NODES)
        cycle = tabulate_helical(assembly, materials, mesh, layout, gear_torque)
        deflection = quasi_static(cycle, float(cycle.gear_sense) * abs(gear_torque)).deflection[0]
        mean = float(np.mean(deflection))
        return deflection - mean, mean

    slices = first
    while True:
        finer, mean = error(2 * slices + 1)
        size = max(float(np.ptp(finer)), SMALL_ERROR * abs(mean))
        change = float(np.max(np.abs(finer - error(slices)[0]))) / size
        more = int(_GROWTH * slices) | 1
        if change <= TOLERANCE or more > MOST:
            break
        slices = more
    what = "the transmission error" if size > SMALL_ERROR * abs(mean) else "a tenth of the deflection"
    return SliceNumber(
        slices,
        f"{slices} slices along the face: twice as many change the transmission error by {change:.2g} of "
        f"{'its peak to peak' if what == 'the transmission error' else what}.",
    )
