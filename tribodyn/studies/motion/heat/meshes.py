"""How much warmer than the oil meshes are, where the temperature of the oil is given."""

import numpy as np

from tribodyn.cases.heat_part import HOUSING, OIL, GearboxHeat
from tribodyn.numerics.shapes import Array, Float
from tribodyn.tribology.bulk_temperature import SHARE


def bulk_in_oil(
    heat: GearboxHeat,
    friction: Float[Array, "mesh point"],
    speed: Float[Array, " point"],
    oil: Float[Array, " point"],
) -> Float[Array, "point mesh"]:
    """Bulk temperature of each mesh, K, by losses to tooth friction, W, at the input's speed, rad/s.

    Gears, shafts and bearings are in balance with oil and housing, both at the oil's temperature, K.
    """
    network = heat.network
    free = [name for name in network.nodes if name not in (OIL, HOUSING)]
    place = {name: number for number, name in enumerate(free)}
    gears = [(place[one], place[two]) for one, two in heat.meshes]
    bulk = np.repeat(oil[:, None], len(gears), axis=1)
    points, group = np.unique(np.stack([speed, oil], axis=1), axis=0, return_inverse=True)
    group = group.ravel()
    for number, (turning, warm) in enumerate(points.tolist()):
        here = np.flatnonzero(group == number)
        matrix, at = np.zeros((len(free), len(free))), np.array([warm])
        for path in network.paths:
            law = path.conductance
            value = float(law(at, at, turning)[0]) if callable(law) else law
            ends = [place[name] for name in (path.one, path.two) if name in place]
            for end in ends:
                matrix[end, end] += value
            if len(ends) == 2:
                matrix[ends[0], ends[1]] -= value
                matrix[ends[1], ends[0]] -= value
        made = np.zeros((len(free), len(here)))
        for (one, two), lost in zip(gears, friction[:, here], strict=True):
            made[one] += SHARE * lost
            made[two] += (1.0 - SHARE) * lost
        rise = np.linalg.solve(matrix, made)
        for mesh, (one, two) in enumerate(gears):
            bulk[here, mesh] += 0.5 * (rise[one] + rise[two])
    return bulk
