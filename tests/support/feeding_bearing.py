"""A pair of gears whose motion grows without bound."""

import numpy as np

from tests.support.states import altered
from tribodyn.dynamics.parameters import Model
from tribodyn.train.structure import Y

#: Number of the gear's bearing among the links of a pair.
_OF_GEAR = 1


def fed_by_a_bearing(model: Model) -> Model:
    """The model with a bearing of the gear that feeds whatever moves in it across."""
    damping = np.array(model.links.damping)
    damping[_OF_GEAR, Y] = -2e5
    return altered(model, links={"damping": damping})
