"""What is made of states for a record and its summary: datasets of the whole train, and of every mesh."""

from typing import NamedTuple, Self

import numpy as np

from tribodyn.dynamics.parameters import Model
from tribodyn.dynamics.recorded.extremes import Extremes
from tribodyn.dynamics.recorded.outputs import Evaluated, at_extremes, mesh_outputs, train_outputs
from tribodyn.numerics.shapes import Array, Float


class Sampled(NamedTuple):
    """Datasets by name at samples: of the whole train, (n,) or (n, body), and of each mesh, see `outputs`."""

    cycles: Float[Array, " sample"]  # reference cycles since the start
    whole: dict[str, np.ndarray]
    meshes: list[dict[str, np.ndarray]]

    def part(self, which: slice) -> Self:
        """Some of the samples."""
        meshes = [{name: values[which] for name, values in mesh.items()} for mesh in self.meshes]
        whole = {name: values[which] for name, values in self.whole.items()}
        return self._replace(cycles=self.cycles[which], whole=whole, meshes=meshes)


def sampled(samples: Evaluated, shares: bool = False) -> Sampled:
    """All datasets of states; `shares` as of `mesh_outputs`."""
    meshes = [mesh_outputs(m, samples, shares) for m in range(len(samples.model.meshes))]
    loss = sum((mesh["sliding_loss"] for mesh in meshes), np.zeros(samples.size))
    return Sampled(samples.cycles, train_outputs(samples, loss), meshes)


def sampled_with_extremes(
    cycles: Float[Array, " sample"],
    states: Float[Array, "sample state"],
    extremes: Extremes | None,
    model: Model,
    shares: bool = False,
) -> tuple[Sampled, Sampled]:
    """Datasets at samples, and where the motion between them is extreme."""
    return evaluated_with_extremes(cycles, states, extremes, model, shares)[1:]


def evaluated_with_extremes(
    cycles: Float[Array, " sample"],
    states: Float[Array, "sample state"],
    extremes: Extremes | None,
    model: Model,
    shares: bool = False,
) -> tuple[Evaluated, Sampled, Sampled]:
    """States at samples and where the motion between them is extreme, evaluated; datasets of either."""
    samples, count = at_extremes(cycles, states, extremes, model), len(cycles)
    evaluated = sampled(samples, shares)
    return samples, evaluated.part(slice(count)), evaluated.part(slice(count, None))
