"""What is recorded of a gear pair, from the datasets of the train of two bodies that it is."""

import numpy as np

from tribodyn.dynamics.outputs import IN_SPACE_NAMES, evaluated
from tribodyn.dynamics.parameters import Model
from tribodyn.gears.motion.recorded import OF_SLICES, SAMPLES
from tribodyn.gears.motion.sampled import Sampled, sampled
from tribodyn.numerics.shapes import Array, Float, Int

#: Bodies of the pair, and its only mesh.
PINION, GEAR, MESH = 0, 1, 0


def outputs(
    cycles: Float[Array, " sample"],
    states: Float[Array, "sample state"],
    model: Model,
    interval: Int[Array, " sample"] | None = None,
) -> dict[str, np.ndarray]:
    """All datasets of a record at samples (n,), by name: (n,), (n, pairs) or (n, dof), SI.

    Arguments as of `dynamics.outputs.evaluated`.
    """
    return recorded(sampled(evaluated(cycles, states, model, interval)))


def recorded(found: Sampled) -> dict[str, np.ndarray]:
    """Datasets of a record, by name."""
    whole = found.whole

    def dof(x: str, y: str, angle: str) -> np.ndarray:
        columns = [whole[name][:, body] for body in (PINION, GEAR) for name in (x, y)]
        end = "_rate" if x.endswith("_rate") else ""
        further = [whole[name + end].T for name in IN_SPACE_NAMES]
        in_space = [row for rows in zip(*further, strict=True) for row in rows]
        return np.stack([*columns, whole[angle][:, PINION], whole[angle][:, GEAR], *in_space], axis=-1)

    named = {
        "pinion_angle": whole["reference_angle"],
        "displacement": dof("x", "y", "angle"),
        "velocity": dof("x_rate", "y_rate", "speed"),
    }
    known = SAMPLES | (OF_SLICES if "line_load" in found.meshes[MESH] else {})
    every = named | found.meshes[MESH] | {name: v for name, v in whole.items() if v.ndim == 1}
    return {name: values for name, values in every.items() if name in known or name == "time"}
