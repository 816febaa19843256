"""Which gear drives, what it puts into the mesh, and the efficiency: one definition for all studies.

Powers (W) or works (J) keep the signs of a record: the pinion's is positive where it gives to the mesh, the
gear's where it takes from the mesh. Power therefore flows from the pinion to the gear where both are
positive and from the gear to the pinion where both are negative. Where their signs differ nothing passes
through: both give, and friction and damping take it all (an unloaded mesh, or one that locks).
"""

from typing import Any

import numpy as np

from tribodyn.mesh.cycle import MeshCycle
from tribodyn.mesh.quasi_static import cycle_integral, cycle_mean, quasi_static
from tribodyn.numerics.elementary import namespace
from tribodyn.numerics.shapes import Array, Float


def power_put_in(pinion: Any, gear: Any) -> Any:
    """What the mesh is given, ≥ 0: the pinion's power where that drives, the gear's where that does."""
    xp = namespace(pinion, gear)
    return xp.maximum(pinion, 0.0) + xp.maximum(-gear, 0.0)


def efficiency(pinion: Any, gear: Any, loss: Any) -> Any:
    """1 − loss over what the driving gear puts in; NaN where power does not pass from one to the other.

    The loss is the power or work lost to tooth friction.
    """
    xp = namespace(pinion, gear, loss)
    through = pinion * gear > 0.0
    put_in = xp.where(through, power_put_in(pinion, gear), 1.0)
    return xp.where(through, 1.0 - loss / put_in, np.nan)


def driving_gear(pinion: float, gear: float) -> str:
    """Say which of the two drives: "pinion", "gear" or "neither"."""
    if pinion * gear <= 0.0:
        return "neither"
    return "pinion" if pinion > 0.0 else "gear"


def friction_loss(
    cycle: MeshCycle,
    normal_load: Float[Array, "segment node slot"],
    friction_coefficient: Float[Array, "*#table"],
) -> Any:
    """Mean friction power over a mesh cycle per pinion speed, N m: Σ μ F |v_s|/ω_p.

    Sliding changes sign at the pitch point; the integral is split there, exactly, so that it is smooth in
    the drive's parameters. The table's `side` must not be traced; the loads (N) are smooth in every segment.
    """
    xp = namespace(*cycle, normal_load, friction_coefficient)
    pairs = cycle.front_pairs
    sliding = (cycle.pinion_speed - cycle.gear_speed)[..., :pairs]
    power = (friction_coefficient * cycle.in_contact[:, None, :] * normal_load)[..., :pairs] * sliding
    pitch_point = cycle.pitch_point_phase - xp.arange(pairs - 1.0, -1.0, -1.0)
    return (cycle_mean(cycle, power) - 2.0 * cycle_integral(cycle, power, pitch_point[None, :])).sum()


def mean_efficiency(
    cycle: MeshCycle,
    gear_torque: Any,
    friction_coefficient: Float[Array, "*#table"],
    normal_load: Float[Array, "segment node pair"] | None = None,
) -> Any:
    """Quasi-static efficiency over a mesh cycle, by energy, with a given friction coefficient μ ≥ 0.

    The table may be traced, but for `side`. The torque (N m) is negative where the gear drives, on back
    flanks that are like the driving ones. Without loads of `equilibrium` (N) those of `quasi_static` without
    friction count: the error is of the order of the loss squared.
    """
    loads = normal_load
    if loads is None:
        loads = quasi_static(cycle, namespace(gear_torque).abs(gear_torque)).normal_load
    gear = gear_torque * cycle.pinion_pitch_radius / cycle.gear_pitch_radius
    loss = friction_loss(cycle, loads, friction_coefficient)
    return efficiency(gear + loss, gear, loss)
