"""What clutches and brakes do, recomputed from the states."""

import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.numerics.shapes import Array, Float
from tribodyn.train.clutches import capacity_at, clutch_friction
from tribodyn.train.layout import works_of_clutches


def clutch_outputs(
    cycles: Float[Array, " sample"], y: Float[Array, "state sample"], model: Model
) -> dict[str, Float[Array, "sample clutch"]]:
    """Datasets of the clutches by name, SI, at so many reference cycles since the start; none without any."""
    layout, operation = model.layout, model.operation
    if not layout.clutches:
        return {}
    time = cycles * operation.pitch_angle / operation.nominal_speed + y[layout.lag]
    numbers = range(layout.clutches)
    friction = [clutch_friction(c, time, y, model) for c in numbers]
    slip, torque, _ = (np.stack(values, axis=-1) for values in zip(*friction, strict=True))
    return {
        "clutch_slip": slip,
        "clutch_torque": torque,
        "clutch_capacity": np.stack([capacity_at(c, time, operation.clutches) for c in numbers], axis=-1),
        "clutch_power": slip * torque,
        "clutch_work": y[works_of_clutches(layout)].T,
    }
