"""Temperatures of a gearbox at points of operation, by the scenario's [temperature]."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from tribodyn.gears.prepare import temperatures_of
from tribodyn.gears.tabulated import Tabulated
from tribodyn.numerics.shapes import Array, Float
from tribodyn.studies.motion.case import Gearbox
from tribodyn.tribology.bulk_temperature import SHARE, Heat


class Warmth(NamedTuple):
    """Temperatures, K."""

    bulk: Float[Array, "point mesh"]  # of the teeth of every mesh
    oil: Float[Array, " point"]  # around the gears


def warmth(
    case: Gearbox,
    tables: Sequence[Tabulated],
    friction: Sequence[Float[Array, " point"]],
    in_oil: Float[Array, " point"],
    in_housing: Float[Array, " point"],
    supplied: Float[Array, " point"],
) -> Warmth:
    """Temperatures that losses give, W: of friction by mesh, of what churns, of bearings; oil as supplied, K.

    As `gears.prepare.thermal_state` of one mesh, and `thermal_iteration` of several, which heat one oil.
    """
    bulk, oil = [], supplied
    for mesh, tabulated, lost in zip(case.meshes, tables, friction, strict=True):
        wanted = mesh.pair.temperature
        if wanted is None:
            bulk.append(supplied)
            continue
        others, housing = np.sum(friction, axis=0) - lost + in_oil, in_housing
        if wanted.housing_ambient == 0.0:
            others, housing = others + in_housing, 0.0 * in_housing
        heat = Heat(SHARE * lost, (1.0 - SHARE) * lost, others, housing)
        found, _ = temperatures_of(mesh.pair, tabulated.assembly, wanted, heat, lost, supplied)
        bulk.append(np.broadcast_to(found.bulk, supplied.shape))
        oil = np.broadcast_to(found.oil, supplied.shape)
    return Warmth(np.stack(bulk, axis=1), oil)
