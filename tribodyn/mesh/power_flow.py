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
    """What the mesh is given, ≥ 0: the pinion's power where that drives, the gear's where that does.

    Parameters
    ----------
    pinion, gear : float or array of one shape
        Power from the pinion to the mesh and from the mesh to the gear, W, or works, J.
    """
    xp = namespace(pinion, gear)
    return xp.maximum(pinion, 0.0) + xp.maximum(-gear, 0.0)


def efficiency(pinion: Any, gear: Any, loss: Any) -> Any:
    """1 − loss over what the driving gear puts in; NaN where power does not pass from one to the other.

    Parameters
    ----------
    pinion, gear
        As for `power_put_in`.
    loss : power or work lost to tooth friction
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
    the drive's parameters.

    Parameters
    ----------
    cycle : the table; its `side` must not be traced
    normal_load : (S, N, Q), load of each pair at the nodes, N; smooth in every segment
    friction_coefficient : (); μ ≥ 0
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
    """Quasi-static efficiency over a mesh cycle, by energy, with a given friction coefficient.

    Parameters
    ----------
    cycle : the table; may be traced, but for `side`
    gear_torque : N m, ≠ 0; negative where the gear drives, on back flanks that are like the driving ones
    friction_coefficient : (); μ ≥ 0
    normal_load : (S, N, Q), optional; of `equilibrium`, N; default: loads of `quasi_static` without friction:
        the error is of the order of the loss squared
    """
    loads = normal_load
    if loads is None:
        loads = quasi_static(cycle, namespace(gear_torque).abs(gear_torque)).normal_load
    gear = gear_torque * cycle.pinion_pitch_radius / cycle.gear_pitch_radius
    loss = friction_loss(cycle, loads, friction_coefficient)
    return efficiency(gear + loss, gear, loss)
