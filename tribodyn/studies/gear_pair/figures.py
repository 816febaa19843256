"""Figures of the dynamics of a gear pair."""

from tribodyn.post.figures import by_revolution, over_face, over_mesh, sensed, spectrum
from tribodyn.post.figures.drawing import Drawing
from tribodyn.studies.gears.batch.sweep_figures import SWEEP_DRAWINGS as SWEEP_DRAWINGS

DRAWINGS: dict[str, Drawing] = {
    **over_mesh.DRAWINGS,
    **over_face.DRAWINGS,
    **by_revolution.DRAWINGS,
    "orders": Drawing(
        "orders of the mesh while the speed changes, such as run-up",
        spectrum.orders_figure,
        spectrum.worth_tracking,
    ),
    **sensed.DRAWINGS,
}
