"""What is recorded of a gear pair, from the outputs of the train of two bodies that it is."""

import numpy as np

from tribodyn.dynamics.extremes import Extremes
from tribodyn.dynamics.outputs import Evaluated, at_extremes, evaluated, mesh_outputs, train_outputs
from tribodyn.dynamics.parameters import Model
from tribodyn.numerics.shapes import Array, Float, Int

#: Bodies of the pair, and its only mesh.
PINION, GEAR, MESH = 0, 1, 0


def outputs(
    cycles: Float[Array, " sample"],
    states: Float[Array, "sample state"],
    model: Model,
    interval: Int[Array, " sample"] | None = None,
    shares: bool = False,
) -> dict[str, np.ndarray]:
    """All datasets of a record at samples (n,), by name: (n,), (n, pairs) or (n, dof), SI.

    Arguments as of `dynamics.outputs.evaluated` and `mesh_outputs`.
    """
    return _named(evaluated(cycles, states, model, interval), shares)


def outputs_with_extremes(
    cycles: Float[Array, " sample"],
    states: Float[Array, "sample state"],
    extremes: Extremes | None,
    model: Model,
    shares: bool = False,
) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray], np.ndarray]:
    """`outputs` at samples and where a motion is extreme, and the mesh cycles (n,) of the latter."""
    samples, at = at_extremes(cycles, states, extremes, model)
    block, count = _named(samples, shares), len(cycles)
    if not len(at):
        return block, {}, at
    sampled, extreme = (
        {name: values[part] for name, values in block.items()} for part in (slice(count), slice(count, None))
    )
    return sampled, extreme, at


def _named(samples: Evaluated, shares: bool) -> dict[str, np.ndarray]:
    mesh = mesh_outputs(MESH, samples, shares)
    whole = train_outputs(samples, mesh.pop("sliding_loss"))
    del mesh["mesh_power_friction"]

    def dof(x: str, y: str, angle: str) -> np.ndarray:
        columns = [whole[name][:, body] for body in (PINION, GEAR) for name in (x, y)]
        return np.stack([*columns, whole[angle][:, PINION], whole[angle][:, GEAR]], axis=-1)

    kinematics = {"displacement": dof("x", "y", "angle"), "velocity": dof("x_rate", "y_rate", "speed")}
    angle = whole.pop("reference_angle")
    rest = {name: values for name, values in whole.items() if values.ndim == 1}
    return {"pinion_angle": angle, **kinematics, **mesh, **rest}
