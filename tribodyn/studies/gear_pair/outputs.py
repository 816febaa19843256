"""What is recorded of a gear pair, from the datasets of the train of two bodies that it is."""

import numpy as np

from tribodyn.dynamics.outputs import evaluated
from tribodyn.dynamics.parameters import Model
from tribodyn.numerics.shapes import Array, Float, Int
from tribodyn.studies.gears.recorded import SAMPLES
from tribodyn.studies.gears.sampled import Sampled, sampled

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
        return np.stack([*columns, whole[angle][:, PINION], whole[angle][:, GEAR]], axis=-1)

    named = {
        "pinion_angle": whole["reference_angle"],
        "displacement": dof("x", "y", "angle"),
        "velocity": dof("x_rate", "y_rate", "speed"),
    }
    every = named | found.meshes[MESH] | {name: v for name, v in whole.items() if v.ndim == 1}
    return {name: values for name, values in every.items() if name in SAMPLES or name == "time"}
