"""The table of Modelica's LossyGear, fitted to a map over its loads.

Rows |speed of a|, eta_mf1 (a drives), eta_mf2 (b drives), |tau_bf1|, |tau_bf2|. With a as the input, L the
torque at the output times |ratio| and d the drag, -τ_b = i (η τ_a - τ_bf) and τ_a = L + d give

    d = ((1 - η1) L + τ_bf1) / η1 where L > 0,    d = (1 - η2) |L| + η2 τ_bf2 where L < 0.

So drag that is linear over the load to either side, d = d0 + m1 L and d = d0 + m2 |L|, is held exactly by
η1 = 1/(1 + m1), τ_bf1 = η1 d0, η2 = 1 - m2, τ_bf2 = d0/η2; both branches meet at L = 0.
"""

import numpy as np
from scipy.optimize import nnls

from tribodyn.exchange.maps.chosen import shares
from tribodyn.record.loss_map import LossMap


def fitted_table(losses: LossMap, drag: np.ndarray) -> np.ndarray | None:
    """Rows of the table for a drag (torque, speed) at one oil temperature; it ends with two equal rows.

    The model extrapolates from its last two rows without bound. Speeds of either sign count alike, and where
    the map has loads of one sign only, those of the other lose as much. None where the gearbox locks itself
    when the load drives, which the model cannot hold.
    """
    load = abs(losses.ratio) * losses.torque
    sides = np.stack([np.ones_like(load), np.maximum(load, 0.0), np.maximum(-load, 0.0)], axis=1)
    rows = []
    for speed in np.unique(np.abs(losses.speed)):
        columns = drag[:, np.abs(losses.speed) == speed]
        root = np.tile(np.sqrt(shares(losses.torque)), columns.shape[1])
        matrix = np.tile(sides, (columns.shape[1], 1))
        (still, forward, backward), _ = nnls(matrix * root[:, None], columns.T.ravel() * root)
        if one_sided(losses):
            forward = backward = max(forward, backward)
        eta_1, eta_2 = 1.0 / (1.0 + forward), 1.0 - backward
        if eta_2 <= 0.0:
            return None
        rows.append([speed, eta_1, eta_2, eta_1 * still, still / eta_2])
    rows.append([rows[-1][0] * 1.1 + (rows[-1][0] == 0.0), *rows[-1][1:]])
    return np.array(rows)


def one_sided(losses: LossMap) -> bool:
    """Whether the map has loads of one sign only."""
    return losses.torque[0] >= 0.0 or losses.torque[-1] <= 0.0


def drag_of_table(losses: LossMap, table: np.ndarray) -> np.ndarray:
    """Drag (torque, speed) at the input that the model has with a table, at the points of a map."""
    load = abs(losses.ratio) * losses.torque[:, None]
    eta_1, eta_2, lost_1, lost_2 = (
        np.interp(np.abs(losses.speed), table[:, 0], table[:, column]) for column in range(1, 5)
    )
    return np.where(
        load >= 0.0, ((1.0 - eta_1) * load + lost_1) / eta_1, eta_2 * lost_2 - (1.0 - eta_2) * load
    )
