"""Figures of the dynamics of a gear pair."""

from tribodyn.post.figures import orders, over_mesh
from tribodyn.post.figures.drawing import Drawing

DRAWINGS: dict[str, Drawing] = {
    **over_mesh.DRAWINGS,
    orders.NAME: Drawing(
        "orders of the mesh while the speed changes, such as run-up",
        orders.orders_figure,
        orders.worth_tracking,
    ),
}
