"""The right-hand side as machine code: for Python, and for the methods that evaluate it in several places."""

import numpy as np

from tribodyn.dynamics.contact_forces import QUANTITIES
from tribodyn.dynamics.equations import derivatives
from tribodyn.dynamics.parameters import Model
from tribodyn.kernels.native import kernel
from tribodyn.numerics.shapes import Array, Float


def work_array(model: Model) -> Float[Array, "quantity pair"]:
    """Scratch for the contacts' quantities."""
    pairs = model.table.side.shape[0]
    return np.zeros((QUANTITIES + pairs, pairs))


@kernel
def rhs(phase, cycle, segment, y, model, work, dy):
    """The compiled right-hand side; returns the powers of `derivatives`."""
    return derivatives(phase, cycle, segment, y, model, work, dy)
